// bn verify: every figure that files claim, recomputed.

#include <fmt/format.h>

#include <algorithm>

#include "bn/error.h"
#include "tools/records.h"
#include "tools/verb.h"

namespace bn::tools {

Verb verify_verb() {
  struct Settings {
    std::filesystem::path path;
    bool json = false;
  };
  const auto settings = std::make_shared<Settings>();
  Verb verb;
  verb.name = "verify";
  verb.summary = "Recompute every figure a file or a folder of files claims.";
  verb.examples = {{"bn verify out", "every texture of a bake, and its manifest"},
                   {"bn verify tile.png", "one file: bijection, radius, energy, bound, hash"},
                   {"bn verify out --json", "the verdicts for a program"}};
  verb.details =
      "Bakes each mask and solves each retarget tile again, from the recipe and the source that the file "
      "names, and "
      "compares pixels, bijection, radius, energy, proven bound and hash. One line an item, pass or FAIL. "
      "Takes "
      "about as long as the bake. Exit code 5 if an item fails.";
  verb.arguments.positional("PATH", settings->path,
                            {.placeholder = "",
                             .allowed = "",
                             .parse = file_path().parse,
                             .show = {},
                             .completion = Completion::file},
                            "A file, or a folder with everything below it.");
  verb.arguments.flag("--json", settings->json, true, "Print the verdicts as JSON.");
  verb.run = [settings](Session& session) {
    const auto items = verify_path(settings->path, session.execution_showing("verify"));
    session.progress.finish();
    const auto failed =
        std::count_if(items.begin(), items.end(), [](const auto& item) { return !item.pass; });
    if (settings->json) {
      Json result{{"path", settings->path.string()},
                  {"pass", failed == 0},
                  {"checked", items.size()},
                  {"failed", failed},
                  {"items", Json::array()}};
      for (const auto& item : items) result["items"].push_back(to_json(item));
      session.output.write_result(result, true);
    } else {
      std::string text;
      for (const auto& item : items) {
        text += fmt::format("{}  {}: {}{}{}\n", item.pass ? "pass" : "FAIL", item.file.string(), item.check,
                            item.detail.empty() ? "" : ": ", item.detail);
      }
      text += fmt::format("{} of {} checks passed\n", items.size() - failed, items.size());
      session.output.write(text);
    }
    if (failed > 0) {
      throw Error({.code = ErrorCode::verification_failed,
                   .what = fmt::format("{} of {} checks failed", failed, items.size()),
                   .where = settings->path.string(),
                   .limit = "",
                   .remedy = "bake the file again"});
    }
  };
  return verb;
}

}  // namespace bn::tools
