// bn study search: error against time, void-and-cluster beside a search by swaps.

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "bn_study/search.h"
#include "tools/verb.h"

namespace bn::tools {
namespace {

using Json = nlohmann::ordered_json;

struct Settings {
  Extent size{64, 64};
  int slices = 32;
  std::vector<int> tries{1, 4, 16};
  std::uint64_t seed = 1;
  bool json = false;
};

void run(const Settings& settings, Session& session) {
  std::vector<std::int64_t> tries(settings.tries.begin(), settings.tries.end());
  std::sort(tries.begin(), tries.end());
  const auto results = study_search({settings.size.width, settings.size.height, settings.slices}, tries,
                                    settings.seed, session.execution_showing("search"));
  session.progress.finish();
  Json json = Json::array();
  std::string text = fmt::format("| {}x{}x{} | seconds | error, 1 frame | {} frames |\n|---|---|---|---|\n",
                                 settings.size.width, settings.size.height, settings.slices, settings.slices);
  for (const SearchResult& r : results) {
    text +=
        fmt::format("| {} | {:.2g} | {:.4f} | {:.4f} |\n", r.method, r.seconds, r.first_error, r.late_error);
    json.push_back({{"method", r.method},
                    {"seconds", r.seconds},
                    {"first_error", r.first_error},
                    {"late_error", r.late_error}});
  }
  if (settings.json) return session.output.write_result(json, true);
  session.output.tell(text);
}

}  // namespace

Verb study_search_verb() {
  const auto settings = std::make_shared<Settings>();
  Verb verb;
  verb.name = "study search";
  verb.summary = "Measure error against time of void-and-cluster and of a search by swaps.";
  verb.examples = {{"bn study search --tries 1,4,16,64", "the table of docs/spatiotemporal.md, ten minutes"}};
  verb.details =
      "Published spatiotemporal masks come from searches: from white noise, two pixels of a slice exchange "
      "their values where that lowers an energy. Makes the presets of bn noise spatiotemporal, then such a "
      "search on the filter's own energy with rising numbers of tries a voxel, and the same search from the "
      "preset filtered, which tells what swaps could still improve there. One thread; times are processor "
      "time. Errors are those of bn study convergence, filtered.";
  verb.arguments.option("--size", settings->size, extent_in(8, 128), "Width and height of the masks.");
  verb.arguments.option("--slices", settings->slices, integer_in(2, 64), "Slices of the masks.");
  verb.arguments.option("--tries", settings->tries, integer_list(1, 10000, 16), "Tries a voxel.");
  verb.arguments.option("--seed", settings->seed, seed_value(), "Another seed gives other masks.");
  verb.arguments.flag("--json", settings->json, true, "Print JSON.");
  verb.run = [settings](Session& session) { run(*settings, session); };
  return verb;
}

}  // namespace bn::tools
