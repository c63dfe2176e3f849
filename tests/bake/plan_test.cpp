// Protects: a plan names every job and file without writing anything, and finds what would fail
// later: formats, folders, permissions, source images, memory; with the recipe's line.
#include <unistd.h>

#include "bn/error.h"
#include "fixtures.h"

namespace bn {
namespace {

TEST(Plan, NamesJobsInTheOrderTheyDependOnEachOther) {
  const TemporaryFolder out;
  const BakePlan plan = plan_bake(small_recipe(), {.out_dir = out / "new/folder"});
  ASSERT_EQ(plan.jobs.size(), 5u);
  EXPECT_EQ(plan.jobs[0].name, "small");
  EXPECT_EQ(plan.jobs[1].name, "odd");
  EXPECT_EQ(plan.jobs[2].name, "set");
  EXPECT_EQ(plan.jobs[2].files,
            (std::vector<std::string>{"set/tile.png", "set/atlas.png", "set/gather.png", "set/right.bin"}));
  EXPECT_EQ(plan.jobs[4].kind, "contact-sheet");
  for (const PlannedJob& job : plan.jobs) EXPECT_FALSE(job.up_to_date);
  EXPECT_GT(plan.estimated_seconds, 0.0);
  EXPECT_GT(plan.memory_bytes, 0u);
  EXPECT_TRUE(fs::is_empty(out)) << "a plan writes nothing";
}

void expect_error(const std::string& recipe, const BakeOptions& options, ErrorCode code,
                  const std::vector<std::string>& says, const Execution& execution = {}) {
  try {
    plan_bake(parse_recipe(recipe, "a.toml", options.out_dir), options, execution);
    FAIL() << recipe;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    for (const std::string& part : says) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << part << " in: " << error.what();
    }
  }
}

TEST(Plan, NamesTheLineOfAFormatThatCannotHoldTheSamples) {
  const TemporaryFolder out;
  expect_error(
      "version = 1\n[[mask]]\nname = 'm'\nsize = [8, 8]\noutputs = [\n  { path = 'm.png', type = 'float' },\n"
      "  { path = 'm.exr', type = '8bit' },\n]\n",
      {.out_dir = out}, ErrorCode::invalid_input,
      {"2 mistakes", "a.toml:6: mask 'm': output 'm.png'", ".tif", "a.toml:7: mask 'm': output 'm.exr'"});
}

TEST(Plan, NamesWhatIsWrongWithASourceImage) {
  const TemporaryFolder out;
  const auto recipe = [](const std::string& more) {
    return "version = 1\n[[retarget]]\nname = 'r'\nimage = 'x.png'\noutputs = ['r.png']\n" + more;
  };
  expect_error(recipe(""), {.out_dir = out}, ErrorCode::io, {"x.png"});
  write_bytes(out / "x.png", "not a picture");
  expect_error(recipe(""), {.out_dir = out}, ErrorCode::invalid_input,
               {"a.toml:2: retarget 'r': image 'x.png'"});
  Image image{.size = {6, 5}, .channels = 1, .type = SampleType::u8, .samples = std::vector<std::byte>(30)};
  write_image(out / "x.png", image, {});
  expect_error(recipe("channel = 1\n"), {.out_dir = out}, ErrorCode::invalid_input,
               {"a.toml:2: ", "channel"});
  expect_error(recipe("motion = 3\n"), {.out_dir = out}, ErrorCode::invalid_input,
               {"a.toml:2: ", "motion 3 is larger than the tile of 6x5", "allowed: 0..2"});
}

TEST(Plan, NeverReplacesASourceImage) {
  const TemporaryFolder out;
  Image image{.size = {8, 8}, .channels = 1, .type = SampleType::u8, .samples = std::vector<std::byte>(64)};
  write_image(out / "x.png", image, {});
  const std::string before = bytes_of(out / "x.png");
  expect_error("version = 1\n[[retarget]]\nname = 'r'\nradius = 2\nimage = 'x.png'\noutputs = ['./x.png']\n",
               {.out_dir = out}, ErrorCode::invalid_input, {"a.toml:2: ", "would be replaced by the output"});
  RetargetEntry entry = a_set("r", out / "x.png");
  entry.outputs = {{.path = entry.image}};
  EXPECT_THROW(make_entry(entry), Error);
  EXPECT_EQ(bytes_of(out / "x.png"), before);
}

TEST(Plan, RefusesWhatDoesNotFitIntoMemory) {
  const TemporaryFolder out;
  expect_error("version = 1\n[[mask]]\nname = 'm'\nsize = [4096, 4096]\noutputs = ['m.png']\n",
               {.out_dir = out}, ErrorCode::over_limit,
               {"a.toml:2: mask 'm'", "at most 64 MiB", "--max-memory"}, {.memory_limit_bytes = 64 << 20});
}

TEST(Plan, RefusesAFolderThatCannotBeWritten) {
  const TemporaryFolder out;
  write_bytes(out / "file", "");
  expect_error(kSmallRecipe, {.out_dir = out / "file"}, ErrorCode::io, {"is a file, no folder", "--out"});
  fs::create_directory(out / "closed");
  fs::permissions(out / "closed", fs::perms{0555});
  // Root may write anywhere: be nobody for a while.
  const bool root = ::geteuid() == 0;
  constexpr uid_t kNobody = 65534;
  fs::permissions(out, fs::perms{0755});
  if (root) {
    ASSERT_EQ(::setresuid(kNobody, kNobody, 0), 0);
  }
  expect_error(kSmallRecipe, {.out_dir = out / "closed"}, ErrorCode::io, {"no permission", "--out"});
  if (root) {
    ASSERT_EQ(::setresuid(0, 0, 0), 0);
  }
  EXPECT_TRUE(fs::is_empty(out / "closed"));
}

}  // namespace
}  // namespace bn
