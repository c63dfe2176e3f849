// The recipe language: TOML to Recipe. Everything that can be wrong with the text alone is found
// here, with its line; what needs other files is found by the plan.

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>

#include "bake/job.h"
#include "bake/recipe_anneal.h"
#include "bake/recipe_reader.h"
#include "bake/toml_check.h"
#include "bn/bake.h"
#include "bn/error.h"

namespace bn {
namespace {

constexpr int kMaxStep = 1 << 24;  // far above any tile's side; keeps every product within 64 bits
constexpr std::size_t kMaxNameLength = 64;
constexpr std::size_t kMaxPathLength = 1024;

const std::vector<std::string> kSampleTypes = {"8bit", "16bit", "float"};
const std::vector<std::string> kForms = {"scatter", "gather"};
const std::vector<std::string> kReaches = {"chebyshev", "euclidean"};
const std::vector<std::string> kMetrics = {"l1", "l2"};
const std::vector<std::string> kKinds = {"tile", "atlas"};

std::string lower_case_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return extension;
}

/// What a path may not be, or nothing. Output files stay inside the output folder.
std::string path_problem(const std::string& text) {
  if (text.empty()) return "is empty";
  if (text.size() > kMaxPathLength) return "is too long";
  if (std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; })) {
    return "has control characters";
  }
  const std::filesystem::path path(text);
  if (path.is_absolute()) return "is absolute";
  if (std::any_of(path.begin(), path.end(), [](const auto& part) { return part == ".."; })) {
    return "leaves the output folder";
  }
  if (!path.has_filename() || path.filename() == ".") return "names no file";
  return "";
}

class RecipeParser {
 public:
  RecipeParser(const toml::table& root, Recipe& recipe)
      : mistakes_(recipe.name), root_(root, "recipe", mistakes_), recipe_(recipe) {}

  void parse() {
    if (!root_.has("version")) {
      mistakes_.add(1, "recipe: version is missing", fmt::format("{}", kRecipeVersion),
                    fmt::format("begin with version = {}", kRecipeVersion));
    }
    root_.integer("version", kRecipeVersion, kRecipeVersion, kRecipeVersion);
    recipe_.contact_sheet = root_.text("contact_sheet", recipe_.contact_sheet, "a path, or \"\" for none");
    if (!recipe_.contact_sheet.empty()) {
      claim_path(root_, "contact_sheet", recipe_.contact_sheet, root_.line("contact_sheet"));
      if (lower_case_extension(recipe_.contact_sheet) != ".png") {
        root_.mistake("contact_sheet", fmt::format("is '{}'", recipe_.contact_sheet),
                      "a .png file, or \"\" for none");
      }
    }
    for_each_table("mask", [this](TableReader& table) { parse_mask(table); });
    for_each_table("retarget", [this](TableReader& table) { parse_retarget(table); });
    if (!root_.has("mask") && !root_.has("retarget")) {
      mistakes_.add(1, "recipe: nothing to bake", "", "add a [[mask]] or a [[retarget]]");
    }
    root_.finish();
    check_references();
    mistakes_.throw_if_any();
  }

 private:
  template <class Each>
  void for_each_table(const char* key, Each each) {
    const std::string limit = fmt::format("tables, each begun by [[{}]]", key);
    const toml::array* entries = root_.array(key, limit);
    if (!entries) return;
    if (entries->size() > kMaxRecipeEntries) {
      root_.mistake(key, fmt::format("has {} entries", entries->size()),
                    fmt::format("0..{}", kMaxRecipeEntries), "split the recipe");
      return;
    }
    for (const toml::node& node : *entries) {
      const toml::table* table = node.as_table();
      if (!table) {
        root_.mistake(key, "is no array of tables", limit);
        return;
      }
      TableReader reader(*table, key, mistakes_);
      each(reader);
      reader.finish();
    }
  }

  /// A name that no entry of this recipe has yet.
  std::string parse_name(TableReader& table, const char* kind) {
    const std::string name = table.text("name", "");
    const bool sound =
        !name.empty() && name.size() <= kMaxNameLength && std::all_of(name.begin(), name.end(), [](char c) {
          return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
                 c == '-' || c == '.';
        });
    if (!sound) {
      table.mistake("name", table.has("name") ? "is not acceptable" : "is missing",
                    fmt::format("1..{} letters, digits, '_', '-', '.'", kMaxNameLength));
      return "";
    }
    table.name_it(fmt::format("{} '{}'", kind, name));
    const auto [earlier, is_new] = lines_of_names_.emplace(name, table.line("name"));
    if (!is_new) {
      table.mistake("name",
                    earlier->second == 0 ? "is taken by the bake itself"
                                         : fmt::format("is used already, in line {}", earlier->second),
                    "", "give every entry a name of its own");
    }
    return name;
  }

  void claim_path(TableReader& table, const char* key, const std::string& path, int line) {
    const std::string problem = path_problem(path);
    if (!problem.empty()) {
      table.mistake(key, problem, "a relative path inside the output folder");
      return;
    }
    const std::string normal = std::filesystem::path(path).lexically_normal().string();
    const auto [earlier, is_new] = lines_of_paths_.emplace(normal, line);
    if (is_new) return;
    table.mistake(
        key,
        fmt::format("'{}' is {}", path,
                    earlier->second == 0 ? "taken by the bake itself"
                                         : fmt::format("written already, by line {}", earlier->second)),
        "", "give every file a path of its own");
  }

  /// Reads `outputs`; each element is a path, or a table with `path` and what `each` reads.
  template <class Output, class Each>
  void parse_outputs(TableReader& entry, const std::string& what, std::vector<Output>& outputs, Each each) {
    const std::string limit = "an array of paths, or of tables { path = \"...\" }";
    const toml::array* list = entry.array("outputs", limit);
    if (!entry.has("outputs")) entry.mistake("outputs", "is missing", limit);
    if (!list) return;
    if (list->empty() || list->size() > kMaxOutputs) {
      entry.mistake("outputs", fmt::format("has {} elements", list->size()),
                    fmt::format("1..{}", kMaxOutputs));
      return;
    }
    for (const toml::node& node : *list) {
      // A plain path is short for a table that holds nothing else.
      toml::table short_form;
      const toml::table* table = node.as_table();
      if (const auto* path = node.as_string()) {
        short_form.insert("path", path->get());
        table = &short_form;
      }
      if (!table) {
        mistakes_.add(line_of(node), fmt::format("{}: an output is no path", what), limit);
        continue;
      }
      TableReader reader(*table, what + " output", mistakes_);
      reader.place_at(line_of(node));
      Output output;
      output.line = line_of(node);
      if (!reader.has("path"))
        reader.mistake("path", "is missing", "a relative path inside the output folder");
      output.path = reader.text("path", "");
      if (!output.path.empty() || reader.has("path")) claim_path(reader, "path", output.path, output.line);
      each(reader, output);
      reader.finish();
      outputs.push_back(std::move(output));
    }
  }

  void parse_mask(TableReader& table) {
    MaskEntry mask;
    mask.line = table.line();
    mask.name = parse_name(table, "mask");
    table.choice("method", 0, {"void-and-cluster"});
    if (const auto size = table.pair("size", 1, 16384)) {
      mask.options.size = {size->x, size->y};
    } else if (!table.has("size")) {
      table.mistake("size", "is missing", "[width, height], each 1..16384");
    }
    mask.options.sigma_px = table.number("sigma", mask.options.sigma_px, 0.3, 16.0);
    mask.options.initial_density = table.number("initial_density", mask.options.initial_density, 0.0, 0.5);
    mask.options.seed = static_cast<std::uint64_t>(table.integer(
        "seed", static_cast<std::int64_t>(mask.options.seed), 0, std::numeric_limits<std::int64_t>::max()));
    mask.options.cutoff_px = static_cast<int>(table.integer("cutoff", mask.options.cutoff_px, 0, 64));
    parse_outputs(table, fmt::format("mask '{}'", mask.name), mask.outputs,
                  [](TableReader& reader, MaskOutput& output) {
                    const int natural = lower_case_extension(output.path) == ".exr" ? 2 : 0;
                    output.type = static_cast<SampleType>(reader.choice("type", natural, kSampleTypes));
                  });
    recipe_.masks.push_back(std::move(mask));
  }

  void parse_retarget(TableReader& table) {
    RetargetEntry set;
    set.line = table.line();
    set.name = parse_name(table, "retarget");
    set.mask = table.text("mask", "", "the name of a [[mask]]");
    set.image = table.text("image", "", "a path relative to the recipe");
    if (set.mask.empty() == set.image.empty()) {
      table.mistake(set.image.empty() ? "mask" : "image",
                    set.image.empty() ? "is missing" : "stands beside a mask",
                    "either mask = \"name\" or image = \"path\"");
    }
    const bool from_image = !set.image.empty();
    if (table.has("channel") && !from_image)
      table.mistake("channel", "needs an image", "only with image = \"path\"");
    if (table.has("levels") && from_image) {
      table.mistake("levels", "needs a mask", "only with mask = \"name\"",
                    "an image is read as it is; leave it out");
    }
    set.channel = static_cast<int>(table.integer("channel", 0, 0, 63));
    set.levels = static_cast<SampleType>(table.choice("levels", 0, kSampleTypes));
    const toml::node* step = table.find("step");
    const auto* word = step ? step->as_string() : nullptr;
    if (!word || word->get() != "auto") set.step = table.pair("step", -kMaxStep, kMaxStep, "\"auto\", or ");
    set.options.radius = static_cast<int>(table.integer("radius", set.options.radius, 1, 32));
    set.options.reach = static_cast<Reach>(table.choice("reach", 0, kReaches));
    set.options.metric = static_cast<Metric>(table.choice("metric", 0, kMetrics));
    set.options.wrap = table.boolean("wrap", true);
    set.motion = static_cast<int>(table.integer("motion", 0, 0, 8));
    set.options.gap = parse_gap(table);
    set.anneal = parse_anneal(table, set);
    parse_outputs(table, fmt::format("retarget '{}'", set.name), set.outputs,
                  [&](TableReader& reader, RetargetOutput& output) {
                    const int natural = set.motion > 0 ? 1 : 0;
                    output.kind = static_cast<RetargetOutput::Kind>(reader.choice("kind", natural, kKinds));
                    output.form = static_cast<MoveForm>(reader.choice("form", 0, kForms));
                    const bool moves = reader.has("motion");
                    if (moves && output.kind == RetargetOutput::Kind::atlas) {
                      reader.mistake("motion", "needs a tile", "only with kind = \"tile\"",
                                     "an atlas holds every motion; leave it out");
                    }
                    if (const auto motion = reader.pair("motion", -set.motion, set.motion))
                      output.motion = *motion;
                  });
    recipe_.retargets.push_back(std::move(set));
  }

  /// A share: 0.005 or "0.5%".
  double parse_gap(TableReader& table) {
    const toml::node* node = table.find("gap");
    const auto* percent = node ? node->as_string() : nullptr;
    if (!percent) return table.number("gap", 0.0, 0.0, 1.0);
    const std::string& text = percent->get();
    double value = -1.0;
    // from_chars knows no locale, so a recipe means the same everywhere.
    const char* const end = text.data() + text.size();
    const auto [rest, failed] = std::from_chars(text.data(), end, value);
    value = failed == std::errc() && rest + 1 == end && *rest == '%' ? value / 100.0 : -1.0;
    if (value >= 0.0 && value <= 1.0) return value;
    table.mistake("gap", "is no share", "0..1, or \"0%\"..\"100%\"");
    return 0.0;
  }

  void check_references() {
    std::vector<std::string> names;
    for (const MaskEntry& mask : recipe_.masks) names.push_back(mask.name);
    for (const RetargetEntry& set : recipe_.retargets) {
      if (set.mask.empty()) continue;
      const auto found = std::find(names.begin(), names.end(), set.mask);
      if (found == names.end()) {
        const std::string nearest = nearest_word(set.mask, names);
        mistakes_.add(
            set.line, fmt::format("retarget '{}': there is no mask '{}'", set.name, set.mask),
            names.empty() ? "" : fmt::format("{}", fmt::join(names, ", ")),
            nearest.empty() ? "add a [[mask]] of that name" : fmt::format("did you mean '{}'?", nearest));
        continue;
      }
      // The tiles name the mask's file as their source, so there must be one with those very samples.
      const MaskEntry& mask = recipe_.masks[static_cast<std::size_t>(found - names.begin())];
      const bool has_file = std::any_of(mask.outputs.begin(), mask.outputs.end(),
                                        [&](const MaskOutput& output) { return output.type == set.levels; });
      if (!has_file) {
        mistakes_.add(
            set.line,
            fmt::format("retarget '{}': mask '{}' has no {} output for the tiles to refer to", set.name,
                        set.mask, name_of(set.levels)),
            "", fmt::format("add {{ path = \"...\", type = \"{}\" }} to its outputs", name_of(set.levels)));
      }
      const Extent size = mask.options.size;
      if (set.motion > largest_motion(size)) {
        mistakes_.add(set.line,
                      fmt::format("retarget '{}': motion {} is larger than the tile of {}x{}", set.name,
                                  set.motion, size.width, size.height),
                      fmt::format("0..{}", largest_motion(size)));
      }
    }
  }

  Mistakes mistakes_;
  TableReader root_;
  Recipe& recipe_;
  std::map<std::string, int> lines_of_names_ = {{"contact_sheet", 0}};
  std::map<std::string, int> lines_of_paths_ = {{"manifest.json", 0}};
};

}  // namespace

Recipe parse_recipe(std::string_view text, const std::string& name, const std::filesystem::path& folder) {
  if (text.size() > kMaxRecipeBytes) {
    throw Error({.code = ErrorCode::over_limit,
                 .what = fmt::format("a recipe of {} bytes", text.size()),
                 .where = name,
                 .limit = fmt::format("at most {} bytes", kMaxRecipeBytes),
                 .remedy = "split the recipe"});
  }
  Mistakes mistakes(name);
  check_toml(text, mistakes);
  mistakes.throw_if_any();
  toml::table root;
  try {
    root = toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = std::string(error.description()),
                 .where = fmt::format("{}:{}", name, error.source().begin.line),
                 .limit = "TOML 1.0",
                 .remedy = ""});
  } catch (const BrokenToml&) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = "cannot be read as TOML",
                 .where = name,
                 .limit = "TOML 1.0",
                 .remedy = "look for a bracket, a comma or a value too many or too few"});
  }
  Recipe recipe;
  recipe.name = name;
  recipe.folder = folder;
  recipe.text = text;
  RecipeParser(root, recipe).parse();
  return recipe;
}

Recipe read_recipe(const std::filesystem::path& path) {
  const auto io_error = [&](const std::string& what) {
    return Error({.code = ErrorCode::io,
                  .what = what,
                  .where = path.string(),
                  .limit = "",
                  .remedy = "name a recipe file (.toml)"});
  };
  std::error_code failed;
  if (std::filesystem::is_directory(path, failed)) throw io_error("is a folder");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw io_error(fmt::format("cannot be opened: {}", std::strerror(errno)));
  std::string text(kMaxRecipeBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) throw io_error("cannot be read");
  text.resize(static_cast<std::size_t>(file.gcount()));
  return parse_recipe(text, path.string(), path.parent_path());
}

}  // namespace bn
