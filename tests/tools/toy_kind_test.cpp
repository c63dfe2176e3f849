// Protects: a kind of texture is one file. The toy below declares its options once; recipes, mistakes in
// them, the bake, what is up to date, metadata, verification, the command with its help and JSON, and the
// manual's tables all follow.
#include <gtest/gtest.h>

#include "bn/bake.h"
#include "bn/error.h"
#include "process.h"
#include "tools/entry_arguments.h"
#include "tools/help_text.h"
#include "tools/kind_verb.h"
#include "tools/recipe_tables.h"

namespace bn {
namespace {

// --- the toy, as libbn/bake/kinds/stripes.cpp would hold it ------------------------------------------

struct StripesOutput {
  std::string path;
  int line = 0;
};

const Kind& stripes_kind();

class StripesEntry : public EntryOf<StripesEntry, StripesOutput> {
 public:
  Extent extent{8, 8};
  int period_px = 4;
  int level = 255;

  const Kind& kind() const override { return stripes_kind(); }
  Options options() override {
    Options options;
    options.size("size", extent, 1, 64, "Width and height.").in("pixels").must_be_given();
    options.integer("period", period_px, 1, 16, "From one stripe to the next.")
        .in("pixels")
        .formerly("pitch");
    options.integer("level", level, 0, 255, "Of a stripe.").from_edition(2);
    return options;
  }
  void check(const Complain& complain) const override {
    if (period_px > extent.width) complain("period", "is wider than the picture", "at most the width", "");
  }
  Options output_options(std::size_t) override { return {}; }
  SampleType output_type(std::size_t) const override { return SampleType::u8; }
  int output_channels(std::size_t) const override { return 1; }
  std::optional<Shape> shape() const override { return extent; }
  Cost cost(const std::vector<Shape>&, const Execution&) const override { return {1e-6, 4096}; }
  Made make(const std::vector<Input>&, const Execution&) const override {
    return {.picture = [this](std::size_t) {
      Image image{.size = extent, .channels = 1, .type = SampleType::u8, .samples = {}};
      for (int i = 0; i < extent.area(); ++i)
        image.samples.push_back(static_cast<std::byte>(i % extent.width % period_px == 0 ? level : 0));
      return Picture{.image = image};
    }};
  }
  Metadata metadata(std::size_t, const std::vector<Input>&, const std::filesystem::path&) const override {
    Metadata metadata;
    metadata.algorithm = "stripes";
    metadata.algorithm_version = 1;
    metadata.kind = "stripes";
    metadata.facts.add("period", period_px);
    return metadata;
  }
  std::vector<std::string> file_kinds() const override { return {"stripes"}; }
};

const Kind& stripes_kind() {
  static const Kind kind{.table = "stripes",
                         .title = "Stripes",
                         .verb = "noise stripes",
                         .summary = "Make stripes.",
                         .details = "A toy.",
                         .examples = {{"bn noise stripes -o s.png", "stripes"}},
                         .make = [] { return std::make_shared<StripesEntry>(); }};
  return kind;
}

// --- what follows from it --------------------------------------------------------------------------

class ToyKind : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!find_kind("stripes")) register_kind(stripes_kind());
  }
  tools::ScratchFolder scratch_;
  const std::string text_ =
      "version = 1\ncontact_sheet = ''\n[[stripes]]\nname = 's'\nsize = [8, 4]\npitch = 2\noutputs = "
      "['s.png']\n";
};

TEST_F(ToyKind, IsRegisteredOnce) {
  EXPECT_THROW(register_kind(stripes_kind()), Error);
  EXPECT_EQ(kinds().back(), &stripes_kind());
}

TEST_F(ToyKind, HasTablesInRecipes) {
  const Recipe recipe = parse_recipe(text_, "r", "");
  const std::string written = recipe_text(recipe);
  EXPECT_NE(written.find("[[stripes]]\nname = \"s\"\nsize = [8, 4]\nperiod = 2\noutputs = ["),
            std::string::npos)
      << "the former key is read, the key of a later edition is left out: " << written;
  EXPECT_EQ(recipe_text(parse_recipe(written, "again", "")), written);
  const auto mistake = [&](const std::string& from, const std::string& to) {
    std::string wrong = text_;
    wrong.replace(wrong.find(from), from.size(), to);
    try {
      parse_recipe(wrong, "r", "");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(mistake("pitch = 2", "period = 17").find("r:6: stripes 's': period is 17 (allowed: 1..16)"),
            std::string::npos);
  EXPECT_NE(mistake("pitch = 2", "perod = 2").find("did you mean 'period'?"), std::string::npos);
  EXPECT_NE(mistake("size = [8, 4]\n", "").find("size is missing"), std::string::npos);
  EXPECT_NE(mistake("pitch = 2", "period = 9").find("wider than the picture"), std::string::npos);
}

TEST_F(ToyKind, IsBakedKeptAndVerified) {
  const auto out = scratch_ / "out";
  EXPECT_FALSE(bake(parse_recipe(text_, "r", ""), {.out_dir = out}).jobs.at(0).skipped);
  EXPECT_EQ(read_image(out / "s.png").metadata->facts.get<int>("period"), 2);
  EXPECT_TRUE(bake(parse_recipe(text_ + "# a remark\n", "r", ""), {.out_dir = out}).jobs.at(0).skipped);
  EXPECT_FALSE(bake(parse_recipe(text_ + "level = 9\n", "r", ""), {.out_dir = out}).jobs.at(0).skipped);
  for (const VerifyItem& item : verify_path(out)) EXPECT_TRUE(item.pass) << item.check << " " << item.detail;
  FileContent content = read_image(out / "s.png");
  content.image.samples[5] ^= std::byte{1};
  write_image(out / "s.png", content.image, *content.metadata);
  std::string failed;
  for (const VerifyItem& item : verify_path(out / "s.png")) failed += item.pass ? "" : item.check + " ";
  EXPECT_EQ(failed, "pixels ");
  const BakedEntry baked = bake_entry(*parse_recipe(text_, "r", "").entries[0]);
  EXPECT_EQ(baked.files.at(0).image.samples.size(), 32u);
  EXPECT_EQ(baked.files.at(0).metadata.pixel_hash, pixel_hash(baked.files.at(0).image));
}

TEST_F(ToyKind, IsMadeManyTimesByCount) {
  std::string many = text_ + "count = 3\n";
  many.replace(many.find("s.png"), 5, "s%02d.png");
  const Recipe recipe = parse_recipe(many, "r", "");
  ASSERT_EQ(recipe.entries.size(), 3u);
  EXPECT_EQ(recipe.entries[2]->path_of(0), "s02.png");
  EXPECT_THROW(parse_recipe(text_ + "count = 3\n", "r", ""), Error) << "no place for the number";
}

TEST_F(ToyKind, HasACommandAndTablesInTheManual) {
  const tools::Verb verb = tools::kind_verb(stripes_kind());
  const std::string help = tools::verb_help(verb, {});
  EXPECT_NE(help.find("--period N"), std::string::npos) << help;
  EXPECT_NE(help.find("1..16"), std::string::npos) << help;
  tools::EntryArguments arguments(stripes_kind());
  tools::Arguments list;
  arguments.declare(list);
  EXPECT_THROW(arguments.assign("period", "17", "--period"), Error);
  arguments.assign("period", "3", "--period");
  arguments.finish("s.png");
  EXPECT_EQ(arguments.to_json().dump(), R"({"size":[8,8],"period":3,"level":255})");
  EXPECT_NE(tools::recipe_tables().find(
                "| `period` | 1..16 pixels | 4 | From one stripe to the next. Formerly `pitch`. |"),
            std::string::npos);
}

}  // namespace
}  // namespace bn
