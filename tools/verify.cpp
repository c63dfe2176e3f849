// bn verify: every figure that files claim, recomputed; and retarget tiles of other programs measured.

#include <fmt/format.h>

#include <algorithm>

#include "bn/error.h"
#include "tools/entry_arguments.h"
#include "tools/records.h"
#include "tools/verb.h"

namespace bn::tools {
namespace {

struct Settings {
  std::vector<std::filesystem::path> paths;
  ForeignTile foreign;
  EntryArguments retarget{*find_kind("retarget")};  ///< of the tile of another program
  std::optional<Offset> step, motion;
  std::vector<std::string> foreign_flags;  ///< those of them that were given
  bool json = false;
};

/// "plus128": what was added to a move before it was stored.
ValueKind<int> encoding() {
  const std::string allowed = "plus0..plus65535";
  return {.placeholder = "plusN",
          .allowed = allowed,
          .parse =
              [=](std::string_view text, std::string_view where) {
                constexpr std::string_view kPlus = "plus";
                if (!text.starts_with(kPlus) || text == kPlus) {
                  throw Error({.code = ErrorCode::usage,
                               .what = fmt::format("'{}' is no encoding of moves", text),
                               .where = std::string(where),
                               .limit = allowed,
                               .remedy = "write plus6 where a move of -6 is stored as 0"});
                }
                return integer_in(0, 65535).parse(text.substr(kPlus.size()), where);
              },
          .show = [](const int& value) { return fmt::format("plus{}", value); }};
}

std::vector<VerifyItem> items_of(Settings& settings, Session& session) {
  if (settings.foreign.mask.empty()) {
    if (!settings.foreign_flags.empty()) {
      throw Error({.code = ErrorCode::usage,
                   .what = "does not apply",
                   .where = settings.foreign_flags.front(),
                   .limit = "only with --mask",
                   .remedy = "name the mask of a tile that another program made"});
    }
    std::vector<VerifyItem> items;
    for (const auto& path : settings.paths) {
      const auto found = verify_path(path, session.execution_showing("verify"));
      items.insert(items.end(), found.begin(), found.end());
    }
    return items;
  }
  const std::filesystem::path& tile = settings.paths.front();
  if (settings.paths.size() > 1) {
    throw Error({.code = ErrorCode::usage,
                 .what = fmt::format("given with {} files", settings.paths.size()),
                 .where = "--mask",
                 .limit = "one retarget tile",
                 .remedy = "measure them one by one"});
  }
  const auto& like = static_cast<const RetargetEntry&>(settings.retarget.with_output(tile.string()));
  settings.foreign.tile = tile;
  settings.foreign.to = like.to;
  settings.foreign.channel = like.channel;
  settings.foreign.form = like.outputs.front().form;
  settings.foreign.metric = like.problem.metric;
  settings.foreign.reach = like.problem.reach;
  if (!settings.step && settings.foreign.to.empty()) {
    throw Error({.code = ErrorCode::usage,
                 .what = "is missing",
                 .where = "--step",
                 .limit = "two whole numbers",
                 .remedy = "say how far the mask moves from frame to frame, as 48,36"});
  }
  settings.foreign.step = settings.step.value_or(Offset{});
  settings.foreign.motion = settings.motion.value_or(Offset{});
  return verify_tile(settings.foreign, session.execution_showing("verify"));
}

void print(const std::vector<VerifyItem>& items, std::int64_t failed, const Settings& settings,
           Session& session) {
  if (settings.json) {
    Json result{{"path", settings.paths.front().string()},
                {"pass", failed == 0},
                {"checked", items.size()},
                {"failed", failed},
                {"items", Json::array()}};
    if (settings.paths.size() > 1) {
      result.erase("path");
      for (const auto& path : settings.paths) result["paths"].push_back(path.string());
    }
    for (const auto& item : items) result["items"].push_back(to_json(item));
    return session.output.write_result(result, true);
  }
  std::string text;
  for (const auto& item : items) {
    if (session.quiet && item.pass) continue;
    text += fmt::format("{}  {}: {}{}{}\n", item.pass ? "pass" : "FAIL", item.file.string(), item.check,
                        item.detail.empty() ? "" : ": ", item.detail);
  }
  if (session.quiet) return session.output.write(text);
  session.output.tell(text + fmt::format("{} of {} checks passed\n",
                                         static_cast<std::int64_t>(items.size()) - failed, items.size()));
}

/// Files of others are a question that this verb does not answer, which is no failed verification.
void throw_if_failed(const std::vector<VerifyItem>& items, std::int64_t failed, const Settings& settings) {
  if (failed == 0) return;
  const std::string where = settings.paths.size() == 1 ? settings.paths.front().string()
                                                       : fmt::format("{} paths", settings.paths.size());
  const auto count = [&](auto property) { return std::count_if(items.begin(), items.end(), property); };
  const auto foreign = count([](const auto& item) { return item.check == "foreign"; });
  if (foreign == static_cast<std::int64_t>(items.size())) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = "nothing here was written by bn, so it claims nothing to verify",
                 .where = where,
                 .limit = "",
                 .remedy =
                     "bn spectrum --check judges masks of others, bn verify TILE --mask MASK --step X,Y "
                     "their retarget tiles"});
  }
  const auto sources = count([](const auto& item) { return item.check == "source" && !item.pass; });
  throw Error({.code = ErrorCode::verification_failed,
               .what = fmt::format("{} of {} checks failed", failed, items.size()),
               .where = where,
               .limit = "",
               .remedy = !settings.foreign.mask.empty() ? ""
                         : foreign == failed            ? "take the files of others out of the folder"
                         : sources == failed ? "put the mask where the tile names it, or bake the tile again"
                                             : "bake what failed again"});
}

constexpr const char* kHeading = "For a retarget tile of another program";

void declare_foreign_options(Arguments& arguments, Settings& settings) {
  ForeignTile& tile = settings.foreign;
  const auto group = [&] { arguments.in_group(kHeading); };
  arguments.option("--mask", tile.mask, file_path(),
                   "The mask that the tile is for: measure the tile on it.");
  group();
  settings.retarget.declare_some(arguments, {"to", "channel"}, kHeading);
  arguments.option("--step", settings.step, offset(), "How far the mask moves from frame to frame.");
  group();
  arguments.option("--motion", settings.motion, offset(), "The motion that the tile is for.");
  group();
  arguments.option("--encoding", tile.zero_level, encoding(),
                   "What was added to a move before it was stored.");
  group();
  settings.retarget.declare_some(arguments, {"form", "metric", "reach"}, kHeading);
  arguments.option("--radius", tile.radius, integer_in(0, 32),
                   "What no move may pass; 0: the farthest move that the tile has.");
  group();
}

/// Declares them so that those which are given without a mask are named.
void declare_foreign(Arguments& arguments, Settings& settings) {
  Arguments foreign;
  declare_foreign_options(foreign, settings);
  for (Argument argument : foreign.list()) {
    if (argument.name != "--mask") {
      argument.assign = [&settings, name = argument.name, assign = argument.assign](std::string_view text) {
        settings.foreign_flags.push_back(name);
        assign(text);
      };
    }
    arguments.add(std::move(argument));
  }
}

}  // namespace

Verb verify_verb() {
  const auto settings = std::make_shared<Settings>();
  Verb verb;
  verb.name = "verify";
  verb.summary = "Recompute every figure that files and folders of files claim.";
  verb.examples = {{"bn verify out", "every texture of a bake, and its manifest"},
                   {"bn verify tile.png", "one file: bijection, radius, energy, bound, hash"},
                   {"bn verify out --json", "the verdicts for a program"},
                   {"bn verify theirs.png --mask mask.png --step 48,36 --encoding plus6",
                    "a retarget tile of another program: its energy and the optimum"}};
  verb.details =
      "Bakes each mask and solves each retarget tile again, from the recipe and the source that the file "
      "names, and "
      "compares pixels, bijection, radius, energy, proven bound and hash. One line an item, pass or FAIL; "
      "with -q "
      "only what fails. Takes about as long as the bake. Exit code 5 if an item fails, 3 if nothing there "
      "was "
      "written by bn.\n\n"
      "With --mask the file is a retarget tile that another program made: whether it is a bijection, how far "
      "it "
      "moves, its energy, and how far that is above the proven optimum.";
  verb.arguments.positional_list("PATH", settings->paths, file_path(),
                                 "Files, and folders with everything below them.");
  verb.arguments.flag("--json", settings->json, true, "Print the verdicts as JSON.");
  declare_foreign(verb.arguments, *settings);
  verb.run = [settings](Session& session) {
    const auto items = items_of(*settings, session);
    session.progress.finish();
    const auto failed =
        std::count_if(items.begin(), items.end(), [](const auto& item) { return !item.pass; });
    print(items, failed, *settings, session);
    throw_if_failed(items, failed, *settings);
  };
  return verb;
}

}  // namespace bn::tools
