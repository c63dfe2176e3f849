// Protects: a study that was stopped goes on with what it has and comes to the same runs; its CSV reads back,
// and whatever else is refused.
#include <gtest/gtest.h>

#include "bn/error.h"
#include "bn_study/anneal.h"
#include "retarget/reference.h"

namespace bn {
namespace {

AnnealStudyOptions small_study() {
  AnnealStudyOptions options;
  options.retarget.step = {5, 3};
  options.schedules = {"greedy", "exponential"};
  options.budgets = {10'000, 20'000};
  options.radii = {2, 3};
  options.seeds = 2;
  return options;
}

/// Without times.
std::vector<std::tuple<std::string, int, std::int64_t, std::uint64_t, std::int64_t>> energies(
    const std::vector<AnnealStudyRun>& runs) {
  std::vector<std::tuple<std::string, int, std::int64_t, std::uint64_t, std::int64_t>> all;
  for (const auto& r : runs) all.emplace_back(r.schedule, r.radius, r.proposals, r.seed, r.energy);
  return all;
}

TEST(AnnealStudy, GoesOnWhereItWasStopped) {
  const auto levels = random_levels({16, 16}, 1, 256);
  AnnealStudyOptions options = small_study();
  const AnnealStudy whole = study_anneal(levels, options);
  ASSERT_EQ(whole.runs.size(), 16u);
  ASSERT_EQ(whole.exact.size(), 2u);
  for (const auto& run : whole.runs) EXPECT_GE(run.energy, whole.exact[run.radius - 2].energy);

  std::stop_source stop;
  std::vector<AnnealStudyRun> saved;
  options.save = [&](const std::vector<AnnealStudyRun>& runs) {
    saved = runs;
    if (runs.size() == 6) stop.request_stop();
  };
  EXPECT_THROW(study_anneal(levels, options, {.stop = stop.get_token()}), Error);
  ASSERT_EQ(saved.size(), 6u);

  options.known = runs_from_csv(runs_csv(saved));
  // Only what is known can say so: known runs are taken as they are.
  options.known[0].energy = 7;
  options.save = {};
  const AnnealStudy resumed = study_anneal(levels, options);
  auto expected = energies(whole.runs);
  std::get<4>(expected[0]) = 7;
  EXPECT_EQ(energies(resumed.runs), expected);
}

TEST(AnnealStudy, CsvReadsBackAndNothingElse) {
  const std::vector<AnnealStudyRun> runs{
      {"hajek", 6, 10'000'000'000, 18'446'744'073'709'551'615u, 0.25, 3638}, {"greedy", 1, 1, 0, 0.0, 0}};
  const std::string csv = runs_csv(runs);
  EXPECT_EQ(runs_csv(runs_from_csv(csv)), csv);
  EXPECT_TRUE(runs_from_csv(runs_csv({})).empty());
  const std::string names = runs_csv({});
  const std::string good = "hajek,6,10,1,0.1,5\n";
  EXPECT_EQ(runs_from_csv(names + good).size(), 1u);
  for (const std::string& bad :
       {std::string(), std::string("schedule\n"), good, names + "hajek,6,10,1,0.1\n",
        names + "hajek,6,10,1,0.1,5", names + "hajek,6,10,1,0.1,5,6\n", names + "hajek,six,10,1,0.1,5\n",
        names + "\n", names + "hajek,6,99999999999999999999,1,0.1,5\n"}) {
    try {
      runs_from_csv(bad);
      ADD_FAILURE() << "accepted: " << bad;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_input);
      EXPECT_NE(std::string(error.what()).find("line "), std::string::npos) << error.what();
    }
  }
}

/// Two schedules, two budgets, three seeds, one radius; a second radius without a solution.
AnnealStudy made_up_study() {
  AnnealStudy study;
  study.exact = {{.radius = 6, .cpu_seconds = 0.5, .start_energy = 1000, .energy = 100}};
  for (const std::int64_t energy : {130, 110, 120}) {
    study.runs.push_back({"exponential", 6, 1'000'000, 1, 0.25, energy});
    study.runs.push_back({"exponential", 6, 3'162'278, 1, 0.75, energy - 9});
    study.runs.push_back({"linear", 6, 1'000'000, 1, 0.25, energy + 50});
    study.runs.push_back({"linear", 8, 1'000'000, 1, 0.25, 1});
  }
  return study;
}

TEST(AnnealStudy, TablesNameTheirSchedules) {
  const AnnealStudy study = made_up_study();
  const auto summaries = summarise(study, {"exponential", "linear"});
  ASSERT_EQ(summaries.size(), 3u) << "a radius without an optimum is left out";
  EXPECT_EQ(summaries[0].median, 120.0);
  EXPECT_EQ(summaries[0].excess_high, 30.0);
  const std::string results = results_md(study, summaries);
  EXPECT_NE(results.find("| bn, exponential, 1e6 proposals | 120 | 12.000 % | 20.0 % | 0.25 s |"),
            std::string::npos)
      << results;
  EXPECT_NE(results.find("| bn, exponential, 3.16e6 proposals |"), std::string::npos) << results;
  EXPECT_EQ(results.find("linear"), std::string::npos) << results;
  EXPECT_EQ(results.find("published"), std::string::npos) << "of another instance";
  EXPECT_NE(results_md(study, summarise(study, {"linear"})).find("| bn, linear, 1e6 proposals | 170 |"),
            std::string::npos);
  // The largest budget first, of each the best schedule first.
  const std::string medians = medians_md(summaries);
  const auto last = medians.find("| 6 | 3.16e6 | exponential | 1.0 % | 11.0 % | 21.0 % | 0.75 s |");
  const auto best = medians.find("| 6 | 1e6 | exponential |"), worse = medians.find("| 6 | 1e6 | linear |");
  EXPECT_LT(last, best);
  EXPECT_LT(best, worse);
  EXPECT_LT(worse, medians.size());
}

}  // namespace
}  // namespace bn
