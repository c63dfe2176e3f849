// Protects: verification believes nothing that a file says of itself. Each claim is broken in turn,
// and the item of that claim must fail with a detail that tells what differs.
#include <fstream>
#include <iterator>
#include <tuple>

#include "bake/inputs.h"
#include "bake/kinds/retarget_source.h"
#include "bn/error.h"
#include "fixtures.h"

namespace bn {
using namespace baking;

namespace {

class Verify : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    baked_ = new TemporaryFolder;
    bake(small_recipe(), {.out_dir = *baked_});
  }
  static void TearDownTestSuite() { delete baked_; }

  Verify() { fs::copy(*baked_, folder_, fs::copy_options::recursive); }

  /// Reads a file, lets `change` tamper with it, and writes it back with a true pixel hash.
  template <class Change>
  void tamper(const std::string& file, Change change) {
    FileContent content = read_image(folder_ / file);
    change(content.image, *content.metadata);
    write_image(folder_ / file, content.image, *content.metadata);
  }

  /// The failed checks of a file, as "check ", and the detail of the first.
  std::string failed(const std::string& file) {
    std::string checks;
    detail_.clear();
    for (const VerifyItem& item : verify_path(folder_ / file)) {
      if (item.pass) continue;
      checks += item.check + " ";
      if (detail_.empty()) detail_ = item.detail;
    }
    return checks;
  }

  /// The image with the moves of its pixels a and b exchanged, or replaced.
  static void set_move(Image& image, std::size_t pixel, Offset move) {
    image.samples[3 * pixel] = static_cast<std::byte>(move.x + 128);
    image.samples[3 * pixel + 1] = static_cast<std::byte>(move.y + 128);
  }

  static TemporaryFolder* baked_;
  TemporaryFolder folder_;
  std::string detail_;
};
TemporaryFolder* Verify::baked_ = nullptr;

TEST_F(Verify, SaysWhatIsWrongWithBrokenMetadata) {
  // A C header keeps its metadata as text, so damage to it is easily made.
  const FileContent content = read_image(folder_ / "masks/small.png");
  write_image(folder_ / "mask.h", content.image, *content.metadata);
  std::ifstream in(folder_ / "mask.h");
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::size_t at = text.find("\"kind\":");
  ASSERT_NE(at, std::string::npos);
  write_text_file(folder_ / "mask.h", text.replace(at, 7, "\"kint\":"));
  EXPECT_EQ(failed("mask.h"), "metadata ");
  EXPECT_TRUE(detail_.starts_with("broken: ")) << detail_;
}

TEST(VerifyRetarget, TilesOfEveryTypeThatAFormatHolds) {
  const TemporaryFolder folder;
  std::string text =
      "version = 1\n[[mask]]\nname = 'm'\nsize = [12, 12]\noutputs = ['m.png']\n"
      "[[retarget]]\nname = 'r'\nmask = 'm'\nradius = 2\nmotion = 1\noutputs = [\n";
  std::map<std::string, SampleType> expected;
  for (const auto& [word, type, extensions] :
       std::vector<std::tuple<std::string, SampleType, std::vector<std::string>>>{
           {"8bit", SampleType::u8, {"png", "tif", "bin", "h", "ktx2", "dds"}},
           {"half", SampleType::f16, {"exr", "bin", "ktx2", "dds"}},
           {"float", SampleType::f32, {"exr", "tif", "bin", "h", "ktx2", "dds"}}}) {
    for (const std::string& extension : extensions) {
      const std::string path = word + "." + extension;
      text += "  { path = '" + path + "', type = '" + word + "' },\n";
      expected[path] = type;
    }
  }
  bake(parse_recipe(text + "]\n", "types.toml", ""), {.out_dir = folder});
  for (const auto& [path, type] : expected) EXPECT_EQ(read_image(folder / path).image.type, type) << path;
  EXPECT_EQ(failures(verify_path(folder)), "");
}

TEST_F(Verify, PassesEveryCheckOfABake) {
  EXPECT_EQ(failures(verify_path(folder_)), "");
  std::map<std::string, int> checks;
  for (const VerifyItem& item : verify_path(folder_)) ++checks[item.check];
  const std::map<std::string, int> expected = {
      {"metadata", 13}, {"hash", 13},  {"recipe", 13}, {"pixels", 7}, {"bijection", 5},
      {"radius", 5},    {"source", 5}, {"energy", 5},  {"bound", 5},  {"manifest", 13}};
  EXPECT_EQ(checks, expected);
}

TEST_F(Verify, AChangedPixelBreaksTheHash) {
  std::string bytes = bytes_of(folder_ / "set/right.bin");
  bytes.back() ^= 1;
  write_bytes(folder_ / "set/right.bin", bytes);
  EXPECT_EQ(failed("set/right.bin").find("hash "), 0u);
  EXPECT_NE(detail_.find("recorded is xxh3-128:"), std::string::npos) << detail_;
}

TEST_F(Verify, AChangedMaskWithATrueHashIsNotWhatItsRecipeMakes) {
  tamper("masks/small.png", [](Image& image, Metadata&) { std::swap(image.samples[0], image.samples[17]); });
  EXPECT_EQ(failed("masks/small.png"), "pixels ");
  EXPECT_NE(detail_.find("first at pixel (0, 0)"), std::string::npos) << detail_;
}

TEST_F(Verify, TwoSeedsOnOnePixelAreNoBijection) {
  tamper("set/tile.png", [](Image& image, Metadata&) {
    set_move(image, 0, {0, 0});
    set_move(image, 1, {-1, 0});
  });
  EXPECT_EQ(failed("set/tile.png"), "bijection ");
}

TEST_F(Verify, AMoveBeyondTheRadiusIsFound) {
  // Two seeds change places that lie further apart than the radius of 3.
  tamper("set/tile.png", [](Image& image, Metadata& metadata) {
    for (std::size_t pixel = 0; pixel < 256; ++pixel) set_move(image, pixel, {0, 0});
    set_move(image, 0, {4, 0});
    set_move(image, 4, {-4, 0});
    metadata.tiles[0].energy = metadata.tiles[0].start_energy;
  });
  EXPECT_EQ(failed("set/tile.png").find("radius "), 0u);
  EXPECT_NE(detail_.find("(4, 0)"), std::string::npos) << detail_;
}

TEST_F(Verify, AFalseEnergyIsFound) {
  tamper("set/atlas.png", [](Image&, Metadata& metadata) { metadata.tiles[5].energy -= 1; });
  EXPECT_EQ(failed("set/atlas.png").find("energy "), 0u);
  EXPECT_NE(detail_.find("motion (1, 0)"), std::string::npos) << detail_;
}

TEST_F(Verify, AFalseStartEnergyIsFound) {
  tamper("set/tile.png", [](Image&, Metadata& metadata) { metadata.tiles[0].start_energy += 1; });
  EXPECT_EQ(failed("set/tile.png"), "energy ");
}

TEST_F(Verify, ABoundAboveTheOptimumIsFound) {
  // A worse permutation that claims to be optimal: everything fits but the bound.
  tamper("set/tile.png", [&](Image& image, Metadata& metadata) {
    for (std::size_t pixel = 0; pixel < 256; ++pixel) set_move(image, pixel, {0, 0});
    metadata.tiles[0].energy = metadata.tiles[0].lower_bound = metadata.tiles[0].start_energy;
  });
  EXPECT_EQ(failed("set/tile.png"), "bound ");
  EXPECT_NE(detail_.find("exists"), std::string::npos) << detail_;
}

TEST_F(Verify, ABoundTooFarBelowTheEnergyIsNotWhatTheRecipeAskedFor) {
  tamper("set/tile.png", [](Image&, Metadata& metadata) { metadata.tiles[0].lower_bound -= 1; });
  EXPECT_EQ(failed("set/tile.png"), "bound ");
}

TEST_F(Verify, AMissingOrChangedSourceIsFound) {
  tamper("masks/small.png", [](Image& image, Metadata&) { std::swap(image.samples[0], image.samples[17]); });
  EXPECT_EQ(failed("set/tile.png"), "source ");
  EXPECT_NE(detail_.find("../masks/small.png"), std::string::npos) << detail_;
  fs::remove(folder_ / "masks/small.png");
  EXPECT_EQ(failed("set/tile.png"), "source ");
}

TEST_F(Verify, AnEditedRecipeIsFound) {
  const auto replace = [](std::string& text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, from.size(), to);
  };
  tamper("set/tile.png",
         [&](Image&, Metadata& metadata) { replace(metadata.recipe, "radius = 3", "radius = 4"); });
  EXPECT_EQ(failed("set/tile.png"), "recipe ");
  EXPECT_NE(detail_.find("radius is 4 in the recipe, 3 in the record"), std::string::npos) << detail_;
  tamper("masks/small.png",
         [&](Image&, Metadata& metadata) { replace(metadata.recipe, "sigma = 1.9", "sigma = 1.5"); });
  EXPECT_EQ(failed("masks/small.png"), "pixels ");
  tamper("odd.png", [&](Image&, Metadata& metadata) { metadata.recipe = "not = toml = at all"; });
  EXPECT_EQ(failed("odd.png"), "recipe ");
}

Facts without(const Facts& facts, std::string_view key) {
  Facts rest;
  for (const auto& [name, value] : facts) {
    if (name != key) rest.add(name, value);
  }
  return rest;
}

TEST_F(Verify, MetadataThatContradictTheImageFailWithoutACrash) {
  const std::vector<std::function<void(Image&, Metadata&)>> changes = {
      [](Image&, Metadata& m) { m.tiles.clear(); },
      [](Image&, Metadata& m) { m.tiles.pop_back(); },
      [](Image&, Metadata& m) { m.facts = without(m.facts, "step"); },
      [](Image&, Metadata& m) { m.facts = without(m.facts, "radius"); },
      [](Image&, Metadata& m) { m.facts = without(m.facts, "form"); },
      [](Image&, Metadata& m) { m.facts = without(m.facts, "source"); },
      [](Image&, Metadata& m) { m.facts = without(m.facts, "source"), m.facts.add("source", "/dev/null"); },
      [](Image&, Metadata& m) {
        m.facts = without(m.facts, "source_channel"), m.facts.add("source_channel", 9);
      },
      [](Image&, Metadata& m) { m.facts.add("colour", 7); },
      [](Image&, Metadata& m) { m.kind = "mask"; },
      [](Image&, Metadata& m) { m.kind = "something"; },
      [](Image&, Metadata& m) {
        m.tiles[3].motion = {100, 100};
      },
      [](Image& i, Metadata&) {
        i = {.size = {2, 1}, .channels = 1, .type = SampleType::u16, .samples = std::vector<std::byte>(4)};
      },
      [](Image& i, Metadata&) {
        i = {.size = {3, 3}, .channels = 1, .type = SampleType::u16, .samples = std::vector<std::byte>(18)};
      },
  };
  const std::string original = bytes_of(folder_ / "set/atlas.png");
  for (std::size_t i = 0; i < changes.size(); ++i) {
    write_bytes(folder_ / "set/atlas.png", original);
    tamper("set/atlas.png", changes[i]);
    EXPECT_NE(failed("set/atlas.png"), "") << "change " << i;
  }
}

TEST_F(Verify, FilesOfOthersAndRubbishAreFailedItems) {
  write_bytes(folder_ / "rubbish.png", "this is no picture");
  EXPECT_EQ(failed("rubbish.png"), "metadata ");
  write_bytes(folder_ / "empty.exr", "");
  EXPECT_EQ(failed("empty.exr"), "metadata ");
  const std::string whole = bytes_of(folder_ / "masks/small.png");
  write_bytes(folder_ / "cut.png", whole.substr(0, whole.size() / 2));
  EXPECT_EQ(failed("cut.png").find("metadata "), 0u);
  EXPECT_THROW(verify_path(folder_ / "nothing-here"), Error);
  fs::create_directory(folder_ / "empty");
  EXPECT_EQ(failed("empty"), "foreign ");
  write_bytes(folder_ / "README.md", "no texture");
  EXPECT_EQ(failed("README.md"), "foreign ");
  Image plain{.size = {4, 4}, .channels = 1, .type = SampleType::u8, .samples = std::vector<std::byte>(16)};
  const auto png = encode_png(plain);
  write_bytes(folder_ / "plain.png", std::string(png.begin(), png.end()));
  EXPECT_EQ(failed("plain.png"), "foreign ");
}

TEST_F(Verify, TheManifestMustMatchTheFiles) {
  // An older result of another seed, sound in itself, in place of the listed one.
  make_entry(a_mask("odd", {.size = {12, 9}, .seed = 8}, folder_ / "odd.png"));
  std::string checks;
  for (const VerifyItem& item : verify_path(folder_)) {
    if (!item.pass) checks += item.file.filename().string() + " " + item.check + ", ";
  }
  EXPECT_EQ(checks, "euclidean.png source, odd.png manifest, ");
  fs::remove(folder_ / "odd.png");
  EXPECT_NE(failures(verify_path(folder_)).find("odd.png: manifest: "), std::string::npos);
  write_bytes(folder_ / "manifest.json", "{}");
  EXPECT_NE(failures(verify_path(folder_)).find("manifest.json: manifest: "), std::string::npos);
}

}  // namespace
}  // namespace bn
