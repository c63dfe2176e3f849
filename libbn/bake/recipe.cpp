// The recipe language: TOML to Recipe. What a table may hold is declared by its kind. Everything that can be
// wrong with the text alone is found here, with its line; what needs other files is found by the plan.

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <set>

#include "bake/inputs.h"
#include "bake/paths.h"
#include "bn/bake.h"
#include "bn/error.h"
#include "bn/volume.h"
#include "core/table_reader.h"

namespace bn {

using namespace baking;
using document::TableReader;

namespace {

constexpr std::size_t kMaxNameLength = 64;
constexpr int kMaxCount = 1024;

/// The options that a table sets, by their present keys: whether to something else than the default.
using GivenOptions = std::map<std::string, bool>;

class RecipeParser {
 public:
  RecipeParser(const toml::table& root, Recipe& recipe)
      : diagnostics_(recipe.name), root_(root, "recipe", diagnostics_), recipe_(recipe) {}

  void parse() {
    if (!root_.has("version")) {
      diagnostics_.add(1, "recipe: version is missing", fmt::format("{}", kRecipeVersion),
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
    bool any = false;
    for (const Kind* kind : kinds()) {
      any = root_.has(kind->table) || any;
      parse_tables(*kind);
    }
    if (!any) diagnostics_.add(1, "recipe: nothing to bake", "", "add a [[mask]] or a [[retarget]]");
    root_.finish();
    check_references();
    diagnostics_.throw_if_any();
  }

 private:
  void parse_tables(const Kind& kind) {
    const std::string limit = fmt::format("tables, each begun by [[{}]]", kind.table);
    const toml::array* entries = root_.array(kind.table, limit);
    if (!entries) return;
    if (entries->size() > kMaxRecipeEntries) {
      root_.mistake(kind.table, fmt::format("has {} entries", entries->size()),
                    fmt::format("0..{}", kMaxRecipeEntries), "split the recipe");
      return;
    }
    for (const toml::node& node : *entries) {
      const toml::table* table = node.as_table();
      if (!table) {
        root_.mistake(kind.table, "is no array of tables", limit);
        return;
      }
      TableReader reader(*table, kind.table, diagnostics_);
      parse_entry(kind, reader);
      reader.finish();
    }
  }

  void parse_entry(const Kind& kind, TableReader& table) {
    const std::shared_ptr<Entry> entry = kind.make();
    entry->line = table.line();
    entry->name = parse_name(table, kind.table);
    Options options = entry->options();
    read_options(table, options);
    entry->check([&](std::string_view key, std::string problem, std::string limit, std::string remedy) {
      table.mistake(key, problem, std::move(limit), std::move(remedy));
    });
    const auto count = static_cast<int>(table.integer("count", 1, 1, kMaxCount));
    parse_outputs(table, *entry, count);
    if (count == 1) {
      recipe_.entries.push_back(entry);
    } else {
      expand(table, *entry, count);
    }
  }

  /// Sets what the table gives, and notes what it leaves out or gives in vain.
  void read_options(TableReader& table, Options& options) {
    GivenOptions given;
    for (const Option& option : options.list()) {
      const Value initial = option.get();
      const std::string key = table.read(option);
      if (!key.empty()) given[option.key] = option.get() != initial;
      if (key.empty() && option.required) table.mistake(option.key, "is missing", allowed_text(option));
    }
    for (const Option& option : options.list()) {
      const auto found = given.find(option.key);
      if (found == given.end()) continue;
      if (!option.applies())
        table.mistake(option.key, "does not apply", fmt::format("only with {}", option.needs));
      for (const std::string& other : option.not_beside) {
        const auto beside = given.find(other);
        if (beside != given.end() && beside->second && found->second) {
          table.mistake(option.key, fmt::format("stands beside {}", other), "one of the two");
        }
      }
    }
  }

  /// A name that no entry of this recipe has yet.
  std::string parse_name(TableReader& table, const std::string& kind) {
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

  /// Reads `outputs`; each element is a path, or a table with `path` and the options of the kind's outputs.
  void parse_outputs(TableReader& table, Entry& entry, int count) {
    const std::string limit = "an array of paths, or of tables { path = \"...\" }";
    const toml::array* list = table.array("outputs", limit);
    if (!table.has("outputs")) table.mistake("outputs", "is missing", limit);
    if (!list) return;
    if (list->empty() || list->size() > kMaxOutputs) {
      table.mistake("outputs", fmt::format("has {} elements", list->size()),
                    fmt::format("1..{}", kMaxOutputs));
      return;
    }
    const std::string what = fmt::format("{} '{}'", entry.kind().table, entry.name);
    for (const toml::node& node : *list) {
      // A plain path is short for a table that holds nothing else.
      toml::table short_form;
      const toml::table* output = node.as_table();
      if (const auto* path = node.as_string()) {
        short_form.insert("path", path->get());
        output = &short_form;
      }
      if (!output) {
        diagnostics_.add(document::line_of(node), fmt::format("{}: an output is no path", what), limit);
        continue;
      }
      TableReader reader(*output, what + " output", diagnostics_);
      reader.place_at(document::line_of(node));
      parse_output(reader, entry, document::line_of(node), count);
      reader.finish();
    }
  }

  void parse_output(TableReader& reader, Entry& entry, int line, int count) {
    entry.add_output();
    const std::size_t index = entry.output_count() - 1;
    std::string& path = entry.output_path(index);
    entry.output_line(index) = line;
    if (!reader.has("path")) reader.mistake("path", "is missing", "a relative path inside the output folder");
    path = reader.text("path", "");
    if (count == 1 && (!path.empty() || reader.has("path"))) claim_path(reader, "path", path, line);
    for (int i = 0; count > 1 && i < count; ++i) {
      try {
        claim_path(reader, "path", numbered_path(path, i).string(), line);
      } catch (const Error& error) {
        reader.mistake("path", error.info().what, error.info().limit,
                       "with count, the path has a place for the number");
        break;
      }
    }
    if (!path.empty()) check_format(reader, path);
    entry.default_output(index);
    Options options = entry.output_options(index);
    read_options(reader, options);
  }

  void check_format(TableReader& reader, const std::string& path) {
    try {
      check_extension(path);
    } catch (const Error& error) {
      reader.mistake("path", fmt::format("'{}' names no format: {}", path, error.info().what),
                     error.info().limit);
    }
  }

  /// `count` entries of one table: names and paths with a number, seeds one after the other.
  void expand(TableReader& table, const Entry& entry, int count) {
    for (int i = 0; i < count; ++i) {
      try {
        const std::shared_ptr<Entry> single = numbered_entry(entry, i);
        if (lines_of_names_.emplace(single->name, entry.line).second) {
          recipe_.entries.push_back(single);
        } else {
          table.mistake("count", fmt::format("makes the name '{}', which is used already", single->name), "",
                        "give every entry a name of its own");
        }
      } catch (const Error&) {
        return;  // the path without a place for the number is noted already
      }
    }
  }

  Complain complaining_of(const Entry& entry) {
    return [this, &entry](std::string_view key, std::string problem, std::string limit, std::string remedy) {
      diagnostics_.add(entry.line,
                       fmt::format("{} '{}': {} {}", entry.kind().table, entry.name, key, problem),
                       std::move(limit), std::move(remedy));
    };
  }

  void check_references() {
    for (const auto& entry : recipe_.entries) {
      std::vector<Shape> shapes;
      for (const InputName& input : input_names(*entry)) {
        if (!input.is_file()) check_reference(*entry, input, shapes);
      }
      entry->check_inputs(shapes, complaining_of(*entry));
    }
    if (const auto entry = entry_in_cycle(recipe_)) {
      diagnostics_.add(entry->line,
                       fmt::format("{} '{}' is made from itself", entry->kind().table, entry->name), "",
                       "break the circle");
    }
  }

  void check_reference(const Entry& entry, const InputName& input, std::vector<Shape>& shapes) {
    const std::string what = fmt::format("{} '{}'", entry.kind().table, entry.name);
    const auto source = find_entry(recipe_, input);
    if (!source) {
      std::vector<std::string> names;
      for (const auto& other : recipe_.entries) {
        const std::string& table = other->kind().table;
        if (std::find(input.kinds.begin(), input.kinds.end(), table) != input.kinds.end())
          names.push_back(other->name);
      }
      const std::string nearest = nearest_word(input.text, names);
      diagnostics_.add(
          entry.line,
          fmt::format("{}: there is no {} '{}'", what, fmt::join(input.kinds, " or "), input.text),
          names.empty() ? "" : fmt::format("{}", fmt::join(names, ", ")),
          nearest.empty() ? fmt::format("add a [[{}]] of that name", fmt::join(input.kinds, "]] or [["))
                          : fmt::format("did you mean '{}'?", nearest));
      return;
    }
    if (const auto shape = source->shape()) shapes.push_back(*shape);
    try {
      // The file names its source's file, so there must be one with those very samples.
      entry.input_output(*source);
    } catch (const Error& error) {
      diagnostics_.add(entry.line, fmt::format("{}: {}", what, error.info().what), "", error.info().remedy);
    }
  }

  document::Diagnostics diagnostics_;
  TableReader root_;
  Recipe& recipe_;
  std::map<std::string, int> lines_of_names_ = {{"contact_sheet", 0}};
  std::map<std::string, int> lines_of_paths_ = {{"manifest.json", 0}};
};

}  // namespace

std::shared_ptr<Entry> numbered_entry(const Entry& entry, int number) {
  std::shared_ptr<Entry> single = entry.clone();
  single->name = fmt::format("{}_{}", entry.name, number);
  for (std::size_t i = 0; i < single->output_count(); ++i)
    single->output_path(i) = numbered_path(single->output_path(i), number).string();
  single->take_later_seeds(number);
  return single;
}

Recipe parse_recipe(std::string_view text, const std::string& name, const std::filesystem::path& folder) {
  if (text.size() > kMaxRecipeBytes) {
    throw Error({.code = ErrorCode::over_limit,
                 .what = fmt::format("a recipe of {} bytes", text.size()),
                 .where = name,
                 .limit = fmt::format("at most {} bytes", kMaxRecipeBytes),
                 .remedy = "split the recipe"});
  }
  const toml::table root = document::parse_toml(text, name);
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
  // A picture would give a complaint a line.
  if (text.find('\0') != std::string::npos) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = "is no text",
                 .where = path.string(),
                 .limit = "a recipe, which is a TOML file",
                 .remedy = "bn info says what a texture is"});
  }
  return parse_recipe(text, path.string(), path.parent_path());
}

}  // namespace bn
