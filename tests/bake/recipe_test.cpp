// Protects: a recipe is read as written, and every mistake in one is named with file, line, allowed
// range and remedy, all mistakes at once; no text crashes the parser.
#include "fixtures.h"

#include "bn/error.h"

namespace bn {
namespace {

TEST(Recipe, IsReadAsWritten) {
  const Recipe recipe = small_recipe();
  ASSERT_EQ(recipe.entries.size(), 4u);
  const MaskEntry& small = mask_of(recipe, 0);
  EXPECT_EQ(small.void_and_cluster.size, (Extent{16, 16}));
  EXPECT_EQ(small.void_and_cluster.sigma_px, 1.9);
  EXPECT_EQ(small.outputs.size(), 6u);
  EXPECT_EQ(small.outputs[1].type, SampleType::f32) << "the only type that EXR holds";
  EXPECT_EQ(small.outputs[2].type, SampleType::u16);
  EXPECT_EQ(mask_of(recipe, 1).void_and_cluster.seed, 7u);
  const RetargetEntry& set = set_of(recipe, 0);
  EXPECT_FALSE(set.step.has_value());
  EXPECT_EQ(set.motion, 1);
  EXPECT_EQ(set.outputs[0].kind, RetargetOutput::Kind::tile);
  EXPECT_EQ(set.outputs[1].kind, RetargetOutput::Kind::atlas) << "what a set of motions makes by default";
  EXPECT_EQ(set.outputs[2].form, MoveForm::gather);
  EXPECT_EQ(set.outputs[3].motion, (Offset{1, 0}));
  const RetargetEntry& euclidean = set_of(recipe, 1);
  EXPECT_EQ(*euclidean.step, (Offset{4, 3}));
  EXPECT_EQ(euclidean.problem.reach, Reach::euclidean);
  EXPECT_EQ(euclidean.problem.metric, Metric::l2);
  EXPECT_EQ(euclidean.outputs[0].kind, RetargetOutput::Kind::tile) << "what a single motion makes by default";
}

TEST(Recipe, WrittenOutReadsBackTheSame) {
  const std::string text = recipe_text(small_recipe());
  EXPECT_EQ(recipe_text(parse_recipe(text, "again", "")), text);
}

// What fuzzing starts from must be accepted, or it finds refusals only.
TEST(Recipe, TheFuzzersOwnAreSound) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(BN_SOURCE_DIR) / "tests/fuzz/recipes")) {
    ++count;
    const std::string text = recipe_text(read_recipe(entry.path()));
    EXPECT_EQ(recipe_text(parse_recipe(text, "again", "")), text) << entry.path();
  }
  EXPECT_GE(count, 3);
}

constexpr const char* kAnnealed = R"(version = 1
[[retarget]]
name = "a"
image = "rgb.png"
method = "anneal"
metric = "l2"
channels = [2, 0]
weights = [3, 1]
residual_sigma = 1.5
schedule = "kirkpatrick"
factor = 0.9
stages = 50
accepted_per_stage = 12
tried_per_stage = 10000000000
frozen_stages = 4
proposals = 10000000000
seed = 9
initial_acceptance = 1
end_temperature = 0.25
chains = 8
coupling = "independent"
swap_distance = 7
stop_after = 5000000000
outputs = ["a.png"]
)";

TEST(Recipe, AnnealingIsReadAsWritten) {
  const Recipe recipe = parse_recipe(kAnnealed, "a.toml", "");
  const AnnealMethod& anneal = set_of(recipe, 0).anneal;
  EXPECT_EQ(anneal.channels, (std::vector<int>{2, 0}));
  EXPECT_EQ(anneal.weights, (std::vector<int>{3, 1}));
  EXPECT_EQ(anneal.residual_sigma_px, 1.5);
  EXPECT_EQ(anneal.options.schedule, "kirkpatrick");
  EXPECT_EQ(anneal.options.parameters.factor, 0.9);
  EXPECT_EQ(anneal.options.parameters.stages, 50);
  EXPECT_EQ(anneal.options.parameters.accepted_per_stage, 12);
  EXPECT_EQ(anneal.options.parameters.tried_per_stage, 10'000'000'000);
  EXPECT_EQ(anneal.options.parameters.frozen_stages, 4);
  EXPECT_FALSE(anneal.options.parameters.slope.has_value());
  EXPECT_EQ(anneal.options.proposals, 10'000'000'000);
  EXPECT_EQ(anneal.options.start.rule, StartTemperature::Rule::everything);
  EXPECT_EQ(anneal.options.end_temperature, 0.25);
  EXPECT_EQ(anneal.options.chains.count, 8);
  EXPECT_EQ(anneal.options.swap_distance_px, 7);
  EXPECT_EQ(anneal.options.stop_after, 5'000'000'000);
  const std::string text = recipe_text(recipe);
  EXPECT_EQ(recipe_text(parse_recipe(text, "again", "")), text);
}

TEST(Recipe, WhatAnnealingRefusesIsNamed) {
  const auto message = [](const std::string& line, const std::string& more) {
    std::string text = kAnnealed;
    const std::size_t at = text.find(line);
    EXPECT_NE(at, std::string::npos) << line;
    text.replace(at, line.size(), more);
    try {
      parse_recipe(text, "a.toml", "");
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_input);
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const auto says = [&](const std::string& line, const std::string& more,
                        const std::vector<const char*>& parts) {
    const std::string what = message(line, more);
    for (const char* part : parts) EXPECT_NE(what.find(part), std::string::npos) << part << " in: " << what;
  };
  says("factor = 0.9", "factor = 1.5", {"a.toml:11", "factor", "1.5", "above 0, at most 1"});
  says("factor = 0.9", "factor = 0", {"a.toml:11", "factor", "above 0, at most 1"});
  says("factor = 0.9", "factor = 1", {"a.toml:11", "factor", "below 1"});
  says("factor = 0.9", "slope = 1", {"slope", "only with linear"});
  says("schedule = \"kirkpatrick\"", "schedule = \"boil\"", {"schedule is 'boil'", "\"hajek\""});
  says("stages = 50", "stages = 0", {"stages", "1..1000000"});
  says("tried_per_stage = 10000000000", "tried_per_stage = -1", {"tried_per_stage is -1", "1 or above"});
  says("proposals = 10000000000", "proposals = 0", {"proposals is 0", "1..2^62"});
  says("initial_acceptance = 1", "start_temperature = 0.1", {"end_temperature is 0.25", "at most 0.1"});
  says("chains = 8", "chains = 0", {"chains is 0", "1..256"});
  says("chains = 8\ncoupling = \"independent\"", "coupling = \"tempering\"", {"chains", "2..256"});
  says("swap_distance = 7", "swap_distance = 13", {"swap_distance is 13", "0..12"});
  says("stop_after = 5000000000", "stop_after = 20000000000", {"stop_after", "0..10000000000"});
  says("weights = [3, 1]", "weights = [3]", {"weights has 1 elements", "one for each channel"});
  says("weights = [3, 1]", "weights = [3, 0]", {"weights is [3, 0]", "1..1000"});
  says("channels = [2, 0]", "channels = []", {"channels has 0 elements", "1..16 integers"});
  says("channels = [2, 0]", "channels = [0, 1]\nchannel = 2", {"channels stands beside channel"});
  says("metric = \"l2\"", "", {"residual_sigma", "l2"});
  says("residual_sigma = 1.5", "residual_sigma = 0.1", {"residual_sigma is 0.1", "0.3..8"});
  says("method = \"anneal\"", "",
       {"coupling does not apply", "channels does not apply", "only with method = \"anneal\""});
}

TEST(Recipe, GapIsAShareOrPercent) {
  const auto gap = [](const std::string& value) {
    const Recipe recipe = parse_recipe(
        "version = 1\n[[retarget]]\nname = 'a'\nimage = 'x.png'\noutputs = ['a.png']\ngap = " + value, "r",
        "");
    return set_of(recipe, 0).problem.gap;
  };
  EXPECT_EQ(gap("0.005"), 0.005);
  EXPECT_EQ(gap("\"0.5%\""), 0.005);
  EXPECT_EQ(gap("0"), 0.0);
}

// --- mistakes ------------------------------------------------------------------------------------

// A sound recipe of numbered lines; each case replaces one line.
const std::vector<std::string> kSound = {
    /* 1 */ "version = 1",
    /* 2 */ "[[mask]]",
    /* 3 */ "name = 'm'",
    /* 4 */ "size = [16, 16]",
    /* 5 */ "outputs = ['m.png']",
    /* 6 */ "[[retarget]]",
    /* 7 */ "name = 'r'",
    /* 8 */ "mask = 'm'",
    /* 9 */ "motion = 1",
    /* 10 */ "outputs = ['r.png']",
};

struct Mistake {
  int line;  ///< replaced, and where the message must point unless `points` says otherwise
  const char* text;
  std::vector<const char*> says;  ///< parts of the message
  int points = 0;
};

class RecipeMistake : public testing::TestWithParam<Mistake> {};

TEST_P(RecipeMistake, IsNamedWithLineAndRange) {
  const Mistake& mistake = GetParam();
  std::string text;
  for (std::size_t i = 0; i < kSound.size(); ++i) {
    text += (static_cast<int>(i) + 1 == mistake.line ? mistake.text : kSound[i]) + "\n";
  }
  try {
    parse_recipe(text, "a.toml", "");
    FAIL() << "accepted: " << mistake.text;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::invalid_input);
    const std::string what = error.what();
    const int line = mistake.points ? mistake.points : mistake.line;
    EXPECT_NE(what.find("a.toml:" + std::to_string(line) + ": "), std::string::npos) << what;
    for (const char* part : mistake.says)
      EXPECT_NE(what.find(part), std::string::npos) << part << " in: " << what;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, RecipeMistake,
    testing::Values(
        Mistake{1, "version = 2", {"version is 2", "allowed: 1..1"}},
        Mistake{1, "# none", {"version is missing", "begin with version = 1"}},
        Mistake{1, "version = 1\nversion = 1", {"allowed: TOML 1.0"}, 2},
        Mistake{1, "version = ", {"allowed: TOML 1.0"}},
        Mistake{1,
                "version = 1\ncolour = 3",
                {"unknown key 'colour'", "contact_sheet, mask, retarget, spatiotemporal, vector, version"},
                2},
        Mistake{1, "version = 1\ncontact_sheet = 'a.jpg'", {"contact_sheet is 'a.jpg'", ".png"}, 2},
        Mistake{1, "version = 1\ncontact_sheet = 'm.png'", {"written already, by line 2"}, 6},
        Mistake{2, "[.mask]", {"a table header without a key"}},  // once undefined behaviour
        Mistake{2, "\t[[ ]]", {"a table header without a key"}},
        Mistake{
            4, "size \u00e4\u0620= [16, 16]", {"a character beyond ASCII outside a string"}},  // once, too
        Mistake{3, "name = \"\"\"m\"\"\"", {"a string of several lines"}},
        Mistake{5, "outputs = [ }", {"a bracket that closes none"}},  // once, too
        Mistake{3, "name = 'm", {"a string without its end"}},
        Mistake{2, "[mask]", {"mask is a table", "[[mask]]"}, 2},
        Mistake{3, "", {"name is missing", "1..64"}, 2},
        Mistake{3, "name = 'a b'", {"name is not acceptable", "letters"}},
        Mistake{3, "name = 5", {"name is an integer", "a string"}},
        Mistake{3, "name = 'contact_sheet'", {"taken by the bake"}},
        Mistake{4, "", {"mask 'm': size is missing", "each 1..16384"}, 2},
        Mistake{4, "size = [0, 16]", {"size is [0, 16]", "each 1..16384"}},
        Mistake{4, "size = [16, 16385]", {"size is [16, 16385]", "each 1..16384"}},
        Mistake{4, "size = 16", {"size is an integer", "[width, height]"}},
        Mistake{4, "size = [16, 16.0]", {"size is no such list"}},
        Mistake{4, "size = [16, 16]\nsigma = 0.2", {"sigma is 0.2", "0.3..16"}, 5},
        Mistake{4, "size = [16, 16]\nsigma = nan", {"sigma is nan", "0.3..16"}, 5},
        Mistake{4, "size = [16, 16]\nsigma = inf", {"sigma is inf", "0.3..16"}, 5},
        Mistake{4, "size = [16, 16]\nsigma = 'big'", {"sigma is a string", "a number 0.3..16"}, 5},
        Mistake{4, "size = [16, 16]\nsigam = 1.5", {"unknown key 'sigam'", "did you mean 'sigma'?"}, 5},
        Mistake{4, "size = [16, 16]\ninitial_density = 0.6", {"initial_density is 0.6", "0..0.5"}, 5},
        Mistake{4, "size = [16, 16]\nseed = -1", {"seed is -1", "0..2^63-1"}, 5},
        Mistake{4, "size = [16, 16]\ncutoff = 65", {"cutoff is 65", "0..64"}, 5},
        Mistake{4, "size = [16, 16]\nmethod = 'void-and-clutser'", {"did you mean \"void-and-cluster\"?"}, 5},
        Mistake{5, "", {"outputs is missing"}, 2},
        Mistake{5, "outputs = []", {"outputs has 0 elements", "1..64"}},
        Mistake{5, "outputs = 'm.png'", {"outputs is a string", "an array of paths"}},
        Mistake{5, "outputs = ['/m.png']", {"path is absolute", "inside the output folder"}},
        Mistake{5, "outputs = ['a/../../m.png']", {"path leaves the output folder"}},
        Mistake{5, "outputs = ['manifest.json']", {"taken by the bake"}},
        Mistake{5, "outputs = ['m.png', './m.png']", {"written already, by line 5"}},
        Mistake{5, "outputs = ['folder/']", {"path names no file"}},
        Mistake{5, "outputs = ['']", {"path is empty"}},
        Mistake{5, "outputs = [\"a\\u0007.png\"]", {"path has control characters"}},
        Mistake{5, "outputs = [7]", {"an output is no path"}},
        Mistake{5, "outputs = [{ type = '8bit' }]", {"path is missing"}},
        Mistake{5,
                "outputs = [{ path = 'm.png', type = '8' }]",
                {"type is '8'", "\"8bit\", \"16bit\", \"half\", \"float\""}},
        Mistake{
            5, "outputs = [{ path = 'm.png', typ = '8bit' }]", {"unknown key 'typ'", "did you mean 'type'?"}},
        Mistake{5,
                "outputs = [{ path = 'm.png', type = '16bit' }]",
                {"has no 8bit output", "type = \"8bit\""},
                6},
        Mistake{7, "name = 'm'", {"name is used already, in line 3"}},
        Mistake{8, "", {"mask is missing", "either mask = \"name\" or image"}, 6},
        Mistake{8, "mask = 'm'\nimage = 'x.png'", {"image stands beside a mask"}, 9},
        Mistake{8, "mask = 'n'", {"there is no mask or spatiotemporal 'n'", "allowed: m", "did you mean 'm'?"}, 6},
        Mistake{8, "mask = 'm'\nchannel = 1", {"channel does not apply", "only with image = \"path\""}, 9},
        Mistake{8, "image = 'x.png'\nchannel = 64", {"channel is 64", "0..63"}, 9},
        Mistake{
            8, "image = 'x.png'\nlevels = '8bit'", {"levels does not apply", "only with mask = \"name\""}, 9},
        Mistake{8, "mask = 'm'\nstep = 'autos'", {"step is 'autos'", "\"auto\", or [x, y]"}, 9},
        Mistake{8, "mask = 'm'\nstep = [1, 2, 3]", {"step is no such list"}, 9},
        Mistake{8, "mask = 'm'\nradius = 0", {"radius is 0", "1..32"}, 9},
        Mistake{8, "mask = 'm'\nradius = 33", {"radius is 33", "1..32"}, 9},
        Mistake{8, "mask = 'm'\nradius = 6.0", {"radius is a float", "an integer 1..32"}, 9},
        Mistake{8, "mask = 'm'\nreach = 'euklidean'", {"did you mean \"euclidean\"?"}, 9},
        Mistake{8, "mask = 'm'\nmetric = 'l3'", {"metric is 'l3'", "\"l1\", \"l2\""}, 9},
        Mistake{8, "mask = 'm'\nwrap = 1", {"wrap is an integer", "true or false"}, 9},
        Mistake{8, "mask = 'm'\ngap = -0.1", {"gap is -0.1", "0..1"}, 9},
        Mistake{8, "mask = 'm'\ngap = '5'", {"gap is '5'", "\"0%\"..\"100%\""}, 9},
        Mistake{9, "motion = 9", {"motion is 9", "0..8"}},
        Mistake{9, "motion = 8", {"motion 8 is larger than the tile of 16x16", "0..7"}, 6},
        Mistake{10,
                "outputs = [{ path = 'r.png', kind = 'tile', motion = [2, 0] }]",
                {"motion is [2, 0]", "each -1..1"}},
        Mistake{10,
                "outputs = [{ path = 'r.png', motion = [1, 0] }]",
                {"motion does not apply", "only with kind = \"tile\""}},
        Mistake{10, "outputs = [{ path = 'r.png', form = 'gathr' }]", {"did you mean \"gather\"?"}}));

TEST(RecipeMistakes, AreAllNamedInTheOrderOfTheLines) {
  try {
    parse_recipe(
        "version = 1\n[[mask]]\nname = 'm'\nsize = [0, 1]\nsigma = 99\noutputs = ['../m.png', 'm.jpg']\n",
        "a.toml", "");
    FAIL();
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("4 mistakes"), std::string::npos) << what;
    const auto size = what.find("a.toml:4: "), sigma = what.find("a.toml:5: "),
               path = what.find("a.toml:6: ");
    EXPECT_LT(size, sigma);
    EXPECT_LT(sigma, path);
    EXPECT_NE(path, std::string::npos) << what;
  }
}

TEST(RecipeMistakes, HostileRecipesAreRefused) {
  EXPECT_THROW(parse_recipe("", "a", ""), Error);
  EXPECT_THROW(parse_recipe(std::string("version = 1\0", 12), "a", ""), Error);
  EXPECT_THROW(parse_recipe("\xff\xfe", "a", ""), Error);
  EXPECT_THROW(parse_recipe("a = " + std::string(100000, '['), "a", ""), Error);
  std::string many = "version = 1\n";
  for (int i = 0; i <= kMaxRecipeEntries; ++i) many += "[[mask]]\n";
  EXPECT_THROW(parse_recipe(many, "a", ""), Error);
  try {
    parse_recipe(std::string(kMaxRecipeBytes + 1, '#'), "a", "");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::over_limit);
  }
}

TEST(RecipeMistakes, AFileThatIsNoneIsAnIoError) {
  const TemporaryFolder folder;
  for (const fs::path& path : {folder / "none.toml", fs::path(folder)}) {
    try {
      read_recipe(path);
      FAIL() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::io);
      EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace bn
