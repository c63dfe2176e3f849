// Protects: every kind of bad input that a user or an attacker can bring ends in the right exit code and one
// message that says what, where, limit and remedy; the old output stays as it was; nothing is left behind.
#include <gtest/gtest.h>

#include "process.h"
#include "textures.h"

namespace bn::tools {
namespace {

class BadInput : public testing::Test {
 protected:
  /// Runs `bn` in the scratch folder and expects one message with all of `parts`, and no output.
  void expect_failure(int exit_code, const std::vector<std::string>& arguments,
                      const std::vector<std::string>& parts, ProcessSetup setup = {}) {
    setup.folder = scratch_.path();
    const auto result = run_bn(arguments, setup);
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(result.err.starts_with("bn: ")) << result.err;
    EXPECT_TRUE(result.err.ends_with("\n")) << result.err;
    for (const auto& part : parts)
      EXPECT_NE(result.err.find(part), std::string::npos) << part << "\nin " << result.err;
  }

  void expect_names(const std::vector<std::string>& names) { EXPECT_EQ(names_in(scratch_.path()), names); }

  void write(const std::string& name, const Image& image) { write_image(scratch_ / name, image, {}); }

  /// The first half of a file, and the whole with its middle overwritten.
  void damage(const std::string& name, const std::string& truncated, const std::string& corrupt) {
    std::string bytes = read_bytes(scratch_ / name);
    write_bytes(scratch_ / truncated, bytes.substr(0, bytes.size() / 2));
    const auto middle = bytes.size() / 2;
    for (std::size_t i = middle; i < std::min(bytes.size(), middle + 64); ++i)
      bytes[i] = static_cast<char>(~bytes[i]);
    write_bytes(scratch_ / corrupt, bytes);
  }

  ScratchFolder scratch_;
};

TEST_F(BadInput, TruncatedAndCorruptImages) {
  for (const std::string extension : {"png", "exr", "tif"}) {
    write("whole." + extension, simple_mask(64, extension == "exr" ? SampleType::f32 : SampleType::u8));
    damage("whole." + extension, "half." + extension, "corrupt." + extension);
    expect_failure(3, {"retarget", "half." + extension}, {"half." + extension});
    // TIFF has no checksum: damage shows as pixels that are not those recorded.
    if (extension == "tif") continue;
    expect_failure(3, {"info", "corrupt." + extension}, {"corrupt." + extension});
  }
}

TEST_F(BadInput, AbsurdHeaders) {
  write("mask.png", simple_mask(64));
  std::string bytes = read_bytes(scratch_ / "mask.png");
  // IHDR: width and height in bytes 16..23. The checksum is wrong too; either complaint will do.
  for (std::size_t i = 16; i < 24; ++i) bytes[i] = static_cast<char>(i % 4 == 0 ? 0x7f : 0xff);
  write_bytes(scratch_ / "huge.png", bytes);
  expect_failure(3, {"info", "huge.png"}, {"huge.png"});
  write_bytes(scratch_ / "empty.png", "");
  expect_failure(3, {"info", "empty.png"}, {"empty.png"});
}

TEST_F(BadInput, PixelsThatAreNoNumbers) {
  write("nan.exr", nan_image(16));
  expect_failure(3, {"retarget", "nan.exr", "-o", "tile.png"},
                 {"nan.exr", "1 of 256 pixels", "x 3, y 2", "finite"});
  expect_names({"nan.exr"});
}

TEST_F(BadInput, ChannelsThatAreNotThere) {
  write("mask.png", simple_mask(16));
  expect_failure(3, {"retarget", "mask.png", "--channel", "3"}, {"channel", "allowed: 0"});
}

TEST_F(BadInput, OutOfRangeOptions) {
  write("mask.png", simple_mask(16));
  expect_failure(1, {"retarget", "mask.png", "--radius", "33"}, {"--radius: '33'", "allowed: 1..32"});
  expect_failure(1, {"retarget", "mask.png", "--motion", "9"}, {"--motion: '9'", "allowed: 0..8"});
  expect_failure(3, {"retarget", "mask.png", "--motion", "8"}, {"motion 8", "16x16", "allowed: 0..7"});
  expect_failure(1, {"retarget", "mask.png", "--gap", "0.5"}, {"--gap: '0.5' has no % sign", "write 0.5%"});
  expect_failure(1, {"noise", "void-and-cluster", "--size", "16385x1", "-o", "x.png"},
                 {"--size", "1..16384"});
}

TEST_F(BadInput, ListsAreExplainedAsACommandLineWritesThem) {
  expect_failure(1, {"noise", "void-and-cluster", "--size", "64x", "-o", "x.png"},
                 {"'64x' cannot be read (allowed: WIDTHxHEIGHT, each 1..16384 pixels; one number is a square); write it like"});
  expect_failure(1, {"retarget", "x.png", "--step", "5"},
                 {"(allowed: X,Y|auto, two whole numbers, or auto)"});
  expect_failure(1, {"retarget", "x.png", "--weights", "0"},
                 {"(allowed: N,N..., 1..16 whole numbers, each 1..1000"});
}

TEST_F(BadInput, MisspeltWords) {
  expect_failure(1, {"retarget", "mask.png", "--raduis", "6"}, {"--raduis", "did you mean --radius?"});
  expect_failure(1, {"nosie", "void-and-cluster"}, {"nosie", "did you mean bn noise?"});
  expect_failure(1, {"noise", "void-and-clusters"}, {"did you mean bn noise void-and-cluster?"});
  expect_failure(1, {"info", ""}, {"FILE", "names no file"});
}

TEST_F(BadInput, MissingFilesAndFoldersWhereFilesAreWanted) {
  expect_failure(2, {"info", "missing.png"}, {"missing.png"});
  expect_failure(2, {"bake", "missing.toml"}, {"missing.toml"});
  expect_failure(2, {"verify", "missing"}, {"missing"});
  std::filesystem::create_directory(scratch_ / "folder.png");
  // A folder may hold the slices of a volume; this one holds nothing.
  expect_failure(3, {"info", "folder.png"}, {"folder.png", "no image in this folder"});
  expect_failure(2, {"bake", "folder.png"}, {"folder.png"});
  expect_failure(2, {"noise", "void-and-cluster", "--size", "16x16", "-o", "folder.png"}, {"folder.png"});
}

TEST_F(BadInput, StandardStreamsAreNoFiles) {
  write("mask.png", simple_mask(16));
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"info", "-"},
                                             {"spectrum", "-"},
                                             {"spectrum", "mask.png", "--csv", "-"},
                                             {"verify", "-"},
                                             {"retarget", "-"},
                                             {"retarget", "mask.png", "--to", "-"},
                                             {"retarget", "mask.png", "-o", "-"},
                                             {"noise", "void-and-cluster", "--size", "8x8", "-o", "-"},
                                             {"bake", "-"},
                                             {"pack", "-", "-o", "p.png"},
                                             {"report", "mask.png", "-o", "-"},
                                             {"report", "-", "-o", "r.html"},
                                             {"validate", "-"}})
    expect_failure(1, arguments, {"reads and writes files only", "name a file"});
  std::filesystem::create_symlink("/dev/stdout", scratch_ / "link.png");
  expect_failure(2, {"noise", "void-and-cluster", "--size", "8x8", "-o", "link.png"},
                 {"link.png", "pipes and devices are not written to", "write to a file"});
  expect_failure(2, {"info", "link.png"},
                 {"link.png", "pipes and devices are not read", "write a file first"});
}

TEST_F(BadInput, NamesThatAreNoText) {
  const std::string latin = "m\xe9.png";
  write("mask.png", simple_mask(16));
  write(latin, simple_mask(16));
  expect_failure(3, {"noise", "void-and-cluster", "--size", "8x8", "-o", "x" + latin},
                 {"x" + latin, "not UTF-8"});
  expect_failure(3, {"retarget", latin, "-o", "tile.png"}, {latin, "not UTF-8", "another name"});
  expect_failure(3, {"retarget", "mask.png", "-o", "x" + latin}, {"x" + latin, "not UTF-8"});
  write_bytes(scratch_ / "r.toml", "[[mask]]\nname = 'a'\nsize = [8, 8]\noutputs = ['" + latin + "']\n");
  expect_failure(3, {"bake", "r.toml"}, {"r.toml:4", "not UTF-8", "names of files too"});
  // What is only read may be called anything.
  for (const char* verb : {"info", "spectrum"}) {
    const auto result = run_bn({verb, latin, "--json"}, {.folder = scratch_.path()});
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
}

TEST_F(BadInput, OutputsThatCannotBeWrittenFailBeforeTheWork) {
  // The size would take minutes; the answer comes at once.
  const std::vector<std::string> noise{
      "noise", "void-and-cluster", "--size", "16384x16384", "--max-memory", "64G", "-o"};
  const auto to = [&](const std::string& path) {
    auto arguments = noise;
    arguments.push_back(path);
    return arguments;
  };
  expect_failure(2, to("missing/x.png"), {"missing", "create the folder"});
  expect_failure(2, to("/dev/null/x.png"), {"/dev/null"});
  expect_failure(1, to("x.jpg"), {"x.jpg", ".png"});
  expect_failure(1, to("x"), {"no extension", ".png"});
  expect_names({});
}

TEST_F(BadInput, AFullDiskLeavesTheOldFileAndNoLitter) {
  write_bytes(scratch_ / "mask.png", "old");
  // 8 blocks of 512 bytes: less than the mask.
  expect_failure(2, {"noise", "void-and-cluster", "--size", "128x128", "-o", "mask.png"},
                 {"mask.png", "File too large"}, {.shell_prefix = "ulimit -f 8"});
  EXPECT_EQ(read_bytes(scratch_ / "mask.png"), "old");
  expect_names({"mask.png"});
}

TEST_F(BadInput, AnOutputThatIsItsOwnSource) {
  write("mask.png", simple_mask(16));
  const std::string before = read_bytes(scratch_ / "mask.png");
  expect_failure(3, {"retarget", "mask.png", "-o", "./mask.png"},
                 {"mask.png", "replace the image that it is made for", "another file"});
  EXPECT_EQ(read_bytes(scratch_ / "mask.png"), before);
}

TEST_F(BadInput, NoVerbReplacesWhatItReads) {
  write("mask.png", simple_mask(16));
  const std::string before = read_bytes(scratch_ / "mask.png");
  expect_failure(3, {"spectrum", "mask.png", "--png", "mask.png"}, {"--png", "would replace mask.png"});
  expect_failure(3, {"pack", "mask.png", "-o", "./mask.png"}, {"--out", "would replace mask.png"});
  // Text over a picture is a slip, whether it is read or not.
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"spectrum", "mask.png", "--csv", "mask.png"},
           {"report", "mask.png", "-o", "mask.png"},
           {"retarget", "mask.png", "--method", "anneal", "--trace", "mask.png"}})
    expect_failure(1, arguments, {"names a texture, and text is written there"});
  EXPECT_EQ(read_bytes(scratch_ / "mask.png"), before);
  expect_names({"mask.png"});
}

TEST_F(BadInput, RequestsAboveTheMemoryLimit) {
  expect_failure(4, {"noise", "void-and-cluster", "--size", "1024x1024", "--max-memory", "2M", "-o", "x.png"},
                 {"MiB", "at most 2 MiB", "--max-memory"});
  // Allowed by the flag, refused by the system.
  expect_failure(4,
                 {"noise", "void-and-cluster", "--size", "16384x16384", "--max-memory", "64G", "-o", "x.png"},
                 {"out of memory", "ask for less"}, {.shell_prefix = "ulimit -v 2000000"});
  write("mask.png", simple_mask(256));
  expect_failure(4, {"retarget", "mask.png", "--max-memory", "1M"}, {"at most 1 MiB", "--max-memory"});
  expect_names({"mask.png"});
}

TEST_F(BadInput, RecipesWithMistakesNameEachLine) {
  write_bytes(scratch_ / "r.toml", "version = 1\n[[mask]]\nname = \"m\"\nsize = [0, 64]\nsigmaa = 1.9\n");
  expect_failure(3, {"bake", "r.toml", "--out", "out"}, {"r.toml:4", "r.toml:5", "sigmaa", "1..16384"});
  expect_names({"r.toml"});
}

TEST_F(BadInput, AFileWhoseFiguresLieFailsVerification) {
  ASSERT_EQ(run_bn({"noise", "void-and-cluster", "--size", "16x16", "-o", (scratch_ / "mask.png").string()})
                .exit_code,
            0);
  auto content = read_image(scratch_ / "mask.png");
  std::swap(content.image.samples[0], content.image.samples[1]);
  write_image(scratch_ / "mask.png", content.image, *content.metadata);
  const auto result = run_bn({"verify", "mask.png"}, {.folder = scratch_.path()});
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_NE(result.out.find("FAIL  mask.png: pixels"), std::string::npos) << result.out;
  EXPECT_NE(result.err.find("bn: mask.png: 1 of"), std::string::npos) << result.err;
}

TEST_F(BadInput, OddButLegalSourcesComeWithANote) {
  const auto expect_note = [&](const std::vector<std::string>& arguments, const std::string& note) {
    const auto result = run_bn(arguments, {.folder = scratch_.path()});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find("energy "), std::string::npos) << result.out;
    EXPECT_NE(result.err.find(note), std::string::npos) << result.err;
  };
  write("constant.png", constant_image(8));
  expect_note({"retarget", "constant.png", "--radius", "2"}, "constant");
  write("small.png", simple_mask(8));
  expect_note({"retarget", "small.png", "--radius", "6"}, "radius 6 reaches around the tile of 8x8");
  expect_note({"retarget", "small.png", "--radius", "2", "--step", "0,0"}, "step is 0");
}

}  // namespace
}  // namespace bn::tools
