// Protects: a bake stopped in the middle of a motion set that it anneals goes on with what its variants had
// done and ends with the bytes of an uninterrupted one; a variant that was finished is not made again.
#include "anneal/checkpoint.h"
#include "bn/error.h"
#include "fixtures.h"
#include "retarget/anneal_engine.h"

namespace bn {
using namespace retarget;
namespace {

constexpr const char* kRecipe = R"(version = 1
[[mask]]
name = "m"
size = [32, 32]
outputs = ["m.png"]
[[retarget]]
name = "set"
mask = "m"
step = [11, 7]
motion = 1
method = "anneal"
proposals = 2000000
outputs = ["atlas.png", { path = "tile.png", kind = "tile", motion = [1, 0], form = "gather" }]
)";
constexpr std::size_t kVariants = 9;

class AnnealedSet : public ::testing::Test {
 protected:
  BakeResult bake_into(const fs::path& folder, const Execution& execution = {},
                       const BakeEvents& events = {}) {
    return bake(parse_recipe(kRecipe, "recipe", folder), {.out_dir = folder}, execution, events);
  }

  /// Stops when the set has told its progress so many times, which it does after each variant.
  void bake_stopped_after(const fs::path& folder, int variants, int threads) {
    std::stop_source stop;
    bool in_set = false;
    int told = 0;
    const auto watch = [&](const BakeEvent& event) {
      if (const auto* started = std::get_if<JobStarted>(&event)) in_set = started->job.kind == "retarget";
      if (std::holds_alternative<BakeProgress>(event) && in_set && ++told == variants) stop.request_stop();
    };
    try {
      bake_into(folder, {.threads = threads, .stop = stop.get_token()}, watch);
      ADD_FAILURE() << "not stopped";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::cancelled) << error.what();
    }
    EXPECT_TRUE(fs::exists(folder / "atlas.png.checkpoint"));
    EXPECT_FALSE(fs::exists(folder / "atlas.png"));
  }

  /// Of a checkpoint, or a set's.
  static std::uint64_t fingerprint_in(const std::string& bytes) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < 8; ++i)
      value |= std::uint64_t{static_cast<unsigned char>(bytes[16 + i])} << (8 * i);
    return value;
  }
};

TEST_F(AnnealedSet, GoesOnFromWhereverItWasStopped) {
  const TemporaryFolder whole;
  bake_into(whole);
  for (const int threads : {1, 2}) {
    for (const int variants : {1, 5, 8}) {
      const TemporaryFolder out;
      bake_stopped_after(out, variants, threads);
      bake_into(out, {.threads = 3 - threads});
      EXPECT_EQ(contents_of(out), contents_of(whole)) << threads << " threads, stopped after " << variants;
    }
  }
}

TEST_F(AnnealedSet, DoesNotMakeAFinishedVariantAgain) {
  const TemporaryFolder out;
  bake_stopped_after(out, 5, 1);
  // The first variant's result becomes another one, which only a checkpoint can know: its start.
  const fs::path file = out / "atlas.png.checkpoint";
  const std::string set = bytes_of(file);
  auto variants = anneal::decode_set_checkpoint(set, fingerprint_in(set), kVariants);
  ASSERT_FALSE(variants.front().empty());
  EXPECT_TRUE(variants.back().empty()) << "the last one had not begun";
  AnnealProblem problem;
  problem.channels = {{levels_of_channel(read_image(out / "m.png").image, 0).value}};
  problem.retarget.step = {11, 7};
  problem.retarget.motion = {-1, -1};
  const AnnealInstance instance(problem, 0);
  const std::uint64_t fingerprint = fingerprint_in(variants.front());
  anneal::RunRecord record = anneal::decode_checkpoint(variants.front(), fingerprint, 1,
                                                       placement_bytes(instance.identity()).size());
  const std::int64_t start = anneal_energy(problem, Grid<Offset>({32, 32}, problem.retarget.motion));
  EXPECT_LT(record.chains.at(0).best_energy, start);
  record.chains[0].now = record.chains[0].best = placement_bytes(instance.identity());
  record.chains[0].best_energy = start;
  variants.front() = anneal::encode_checkpoint(fingerprint, record);
  write_bytes(file, anneal::encode_set_checkpoint(fingerprint_in(set), record.proposals, variants));

  const auto resumed = bake_into(out).jobs;
  const auto set_of = [](const std::vector<JobRecord>& jobs) {
    return std::find_if(jobs.begin(), jobs.end(), [](auto& job) { return job.kind == "retarget"; })->tiles;
  };
  const TemporaryFolder whole;
  auto expected = set_of(bake_into(whole).jobs);
  ASSERT_EQ(expected.size(), kVariants);
  expected.front().energy = start;
  EXPECT_EQ(set_of(resumed), expected);
  EXPECT_FALSE(fs::exists(file));
}

}  // namespace
}  // namespace bn
