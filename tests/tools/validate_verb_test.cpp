// Protects: what `bn validate` says and leaves when it cannot work: no Vulkan loader, no driver, a device
// that lacks something, too little memory, scenes and textures that are wrong. Each is named, has its exit
// code, and writes nothing.
#include <gtest/gtest.h>

#include <array>

#include "process.h"
#include "textures.h"

namespace bn::tools {
namespace {

class ValidateVerb : public testing::Test {
 protected:
  /// Runs `bn validate arguments -o out` and expects one message with all of `parts`, and no folder `out`.
  void expect_failure(int exit_code, std::vector<std::string> arguments,
                      const std::vector<std::string>& parts, const std::string& shell_prefix = "") {
    arguments.insert(arguments.begin(), "validate");
    arguments.insert(arguments.end(), {"-o", "out"});
    const auto result = run_bn(arguments, {.folder = scratch_.path(), .shell_prefix = shell_prefix});
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_EQ(result.out, "");
    for (const auto& part : parts)
      EXPECT_NE(result.err.find(part), std::string::npos) << part << "\nin " << result.err;
    EXPECT_FALSE(std::filesystem::exists(scratch_ / "out")) << result.err;
  }

  ScratchFolder scratch_;
};

TEST_F(ValidateVerb, WithoutALoader) {
  // The first of its name on the search path is no library.
  std::filesystem::create_directory(scratch_ / "lib");
  for (const char* name : {"libvulkan.so", "libvulkan.so.1"}) write_bytes(scratch_ / "lib" / name, "");
  expect_failure(2, {"wall", "--quick"}, {"no Vulkan loader", "libvulkan.so.1", "--device cpu"},
                 "export LD_LIBRARY_PATH=" + (scratch_ / "lib").string());
}

TEST_F(ValidateVerb, WithoutADriver) {
  const std::string none = "export VK_DRIVER_FILES=/nonexistent.json VK_ICD_FILENAMES=/nonexistent.json";
  expect_failure(2, {"wall", "--quick"}, {"no Vulkan device 'lavapipe'", "no driver found", "lvp_icd"}, none);
}

TEST_F(ValidateVerb, WithoutTheDevice) {
  expect_failure(2, {"wall", "--quick", "--device", "no such device"}, {"no such device", "llvmpipe"});
}

TEST_F(ValidateVerb, WithoutMemory) {
  // A buffer above what lavapipe allows, and a process that may not grow.
  expect_failure(4, {"wall", "--size", "4096x4096"}, {"bytes", "render a smaller screen"});
#if !defined(__SANITIZE_ADDRESS__)  // which reserves terabytes
  expect_failure(4, {"wall", "--size", "4000x4000", "--device", "cpu"}, {"memory"}, "ulimit -v 500000");
#endif
}

TEST_F(ValidateVerb, WrongSizesAndCounts) {
  expect_failure(1, {"wall", "--size", "0x64"}, {"--size", "0x64"});
  expect_failure(1, {"wall", "--frames", "0"}, {"--frames"});
  expect_failure(3, {"wall", "--quick", "--block", "5"}, {"5", "2, 4, 8 or 16"});
  expect_failure(1, {"wall", "--method", "retraget"}, {"retraget", "retarget"});
}

TEST_F(ValidateVerb, WrongScenes) {
  const std::string start =
      "name = 'x'\ncamera = [{eye = [0, 0, 4], at = [0, 0, 0]}]\n"
      "material = [{name = 'm'}]\n";
  write_bytes(scratch_ / "key.toml", start + "colour = 3\n");
  expect_failure(3, {"key.toml"}, {"key.toml:4", "unknown key 'colour'"});
  write_bytes(scratch_ / "nan.toml",
              start + "sphere = [{centre = [0, 0, 0], radius = nan, material = 'm'}]\n");
  expect_failure(3, {"nan.toml"}, {"nan.toml:4", "'radius' is no finite number"});
  write_bytes(scratch_ / "inf.toml",
              start + "sphere = [{centre = [inf, 0, 0], radius = 1, material = 'm'}]\n");
  expect_failure(3, {"inf.toml"}, {"inf.toml:4", "'centre' is no finite number"});
  expect_failure(2, {"nowhere.toml"}, {"nowhere.toml", "wall, room"});
}

/// What every PNG chunk ends with (PNG specification, annex D).
std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = ~0u;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1u ? 0xEDB88320u : 0u);
  }
  return ~crc;
}

/// Another pixel hash in a PNG that is sound otherwise.
void forge_hash(const std::filesystem::path& path) {
  std::string bytes = read_bytes(path);
  const auto at = bytes.find("\"pixel_hash\":\"xxh3-128:");
  ASSERT_NE(at, std::string::npos);
  char& digit = bytes[at + 23];
  digit = digit == '0' ? '1' : '0';
  const auto number = [&](std::size_t i) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<unsigned char>(bytes[i + k]);
    return value;
  };
  for (std::size_t chunk = 8; chunk + 12 <= bytes.size(); chunk += number(chunk) + 12) {
    const std::size_t length = number(chunk);
    if (at < chunk || at > chunk + 8 + length) continue;
    const std::uint32_t crc = crc32(std::string_view(bytes).substr(chunk + 4, length + 4));
    for (std::size_t k = 0; k < 4; ++k)
      bytes[chunk + 8 + length + k] = static_cast<char>(crc >> (24 - 8 * k));
  }
  write_bytes(path, bytes);
}

std::string slice_name(int slice) { return "slice_" + std::to_string(slice) + ".png"; }

class ValidateTextures : public ValidateVerb {
 protected:
  ValidateTextures() {
    std::filesystem::create_directory(scratch_ / "tex");
    make({"noise", "void-and-cluster", "--size", "16x16", "-o", "tex/mask.png"});
    make({"retarget", "tex/mask.png", "--step", "5,3", "--motion", "1", "-o", "tex/retarget_atlas.png"});
  }
  void make(const std::vector<std::string>& arguments) {
    const auto result = run_bn(arguments, {.folder = scratch_.path()});
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  std::vector<std::string> with_textures(std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"wall", "--device", "cpu", "--size", "16x16", "--frames", "1", "--method",
                               "retarget", "--reference", "2", "--textures", "tex"});
    return more;
  }
};

TEST_F(ValidateTextures, AWrongStepIsRefusedFromTheMetadata) {
  expect_failure(3, with_textures({"--step", "4,2"}),
                 {"retarget_atlas.png", "step (4, 2)", "(5, 3)", "--unsafe"});
  // No step but a whole number is a step at all.
  expect_failure(1, with_textures({"--step", "5.3,3.2"}), {"--step", "5.3,3.2"});
}

TEST_F(ValidateTextures, UnsafeShowsWhatAWrongStepCosts) {
  auto arguments = with_textures({"--step", "4,2", "--unsafe", "-o", "out"});
  arguments.insert(arguments.begin(), "validate");
  const auto result = run_bn(arguments, {.folder = scratch_.path()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(scratch_ / "out" / "report.html"));
}

TEST_F(ValidateTextures, SlicesAreAMethod) {
  std::filesystem::create_directory(scratch_ / "stack");
  for (const int i : {1, 2}) write_image(scratch_ / "stack" / slice_name(i), simple_mask(16), {});
  const auto result =
      run_bn({"validate", "wall", "--device", "cpu", "--size", "16x16", "--frames", "1", "--reference", "2",
              "--slices", "stack", "--method", "slices,sort", "-o", "out"},
             {.folder = scratch_.path()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(read_bytes(scratch_ / "out" / "summary.csv").find("wall,slices,picture"), std::string::npos);
  std::filesystem::remove_all(scratch_ / "out");
  expect_failure(2, {"wall", "--device", "cpu", "--slices", "nowhere"}, {"nowhere"});
  expect_failure(1, {"wall", "--device", "cpu", "--method", "retarget-slices"},
                 {"retarget-slices", "--slices"});
}

TEST_F(ValidateTextures, TheTilesOfAStackAreThoseOfThatStack) {
  make({"noise", "spatiotemporal", "--size", "16x16x3", "-o", "stack/slice_%d.png"});
  make({"retarget", "stack/slice_%d.png", "--radius", "3", "-o", "stack/tile_%d.png"});
  make({"noise", "spatiotemporal", "--size", "16x16x3", "--seed", "2", "-o", "other/slice_%d.png"});
  make({"noise", "spatiotemporal", "--size", "16x16x2", "-o", "short/slice_%d.png"});
  const auto with = [](const std::string& slices) {
    return std::vector<std::string>{
        "wall",           "--device", "cpu",      "--size", "16x16",         "--frames",          "1",
        "--reference",    "64",       "--slices", slices,   "--slice-tiles", "stack/tile_%d.png", "--method",
        "retarget-slices"};
  };
  expect_failure(3, with("other/slice_%d.png"), {"tile_%d.png", "another mask", "other/slice_%d.png"});
  expect_failure(3, with("short/slice_%d.png"), {"tile_%d.png", "another mask"});
  expect_failure(1, {"wall", "--device", "cpu", "--slice-tiles", "stack/tile_%d.png"},
                 {"--slice-tiles", "--slices"});
  auto arguments = with("stack/slice_%d.png");
  arguments.insert(arguments.begin(), "validate");
  arguments.insert(arguments.end(), {"-o", "out"});
  const auto result = run_bn(arguments, {.folder = scratch_.path()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(read_bytes(scratch_ / "out" / "summary.csv").find("wall,retarget-slices,picture"),
            std::string::npos);
}

TEST_F(ValidateTextures, PresetsAreMethodsInTablesAndPage) {
  const auto result = run_bn({"validate", "wall", "--device", "cpu", "--size", "32x32", "--frames", "1",
                              "--reference", "256", "--textures", "tex", "-o", "out"},
                             {.folder = scratch_.path()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string page = read_bytes(scratch_ / "out" / "report.html");
  EXPECT_NE(page.find("RMSE, averaged and blurred"), std::string::npos);
  for (const std::string name :
       {"stbn", "filtered", "both", "retarget-stbn", "retarget-filtered", "retarget-both"}) {
    for (const char* table : {"summary.csv", "errors.csv"}) {
      EXPECT_NE(read_bytes(scratch_ / "out" / table).find("wall," + name + ","), std::string::npos)
          << name << " in " << table;
    }
    EXPECT_NE(read_bytes(scratch_ / "out" / "report.md").find("| " + name + " |"), std::string::npos) << name;
    EXPECT_NE(page.find("<th scope=\"row\">" + name + "</th>"), std::string::npos) << name;
  }
  EXPECT_EQ(page.find("retarget-slices"), std::string::npos) << "no stack was given";
}

TEST_F(ValidateTextures, OtherPixelsThanRecordedAreRefused) {
  forge_hash(scratch_ / "tex" / "retarget_atlas.png");
  expect_failure(5, with_textures(), {"retarget_atlas.png", "not those that were baked"});
}

TEST_F(ValidateTextures, AnotherMaskIsRefused) {
  make({"noise", "void-and-cluster", "--size", "16x16", "--seed", "9", "-o", "tex/mask.png"});
  expect_failure(3, with_textures(), {"retarget_atlas.png", "another mask"});
  make({"noise", "void-and-cluster", "--size", "32x16", "-o", "tex/mask.png"});
  expect_failure(3, with_textures(), {"retarget_atlas.png"});
}

TEST_F(ValidateTextures, MissingAndForeignFilesAreRefused) {
  std::filesystem::remove(scratch_ / "tex" / "retarget_atlas.png");
  expect_failure(2, with_textures(), {"retarget.png"});
  write_image(scratch_ / "tex" / "retarget.png", simple_mask(16), {});
  expect_failure(3, with_textures(), {"retarget.png"});
}

// Scenes go through the same door to TOML as recipes. The parser of these texts once ended the program with
// an abort.
TEST(ValidateScenes, ThatAreNoTomlEndWithAMessage) {
  const ScratchFolder scratch;
  for (const char* text :
       {"a = [ }\n", "[.a]\n", "key \xc3\xa4 = 1\n", "a = \"", "[[quad]]\ncorner = [0, 0\n"}) {
    write_bytes(scratch / "a.toml", text);
    const auto result = run_bn({"validate", "a.toml", "-o", "out"}, {.folder = scratch.path()});
    EXPECT_EQ(result.exit_code, 3) << text << result.err;
    EXPECT_NE(result.err.find("a.toml"), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
  }
}

}  // namespace
}  // namespace bn::tools
