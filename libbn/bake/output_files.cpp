#include "bake/output_files.h"

#include "bake/inputs.h"

namespace bn::baking {
namespace {

namespace fs = std::filesystem;

/// The recipe of one output: the entries that it is made from, with the one output that is read, and itself.
std::string recipe_of(const Recipe& recipe, const std::shared_ptr<const Entry>& single) {
  Recipe own;
  own.contact_sheet.clear();
  // Of each source the output that is read, which the entries above it know.
  std::vector<std::shared_ptr<const Entry>> sources = input_entries(recipe, *single);
  std::vector<std::shared_ptr<const Entry>> users = sources;
  users.push_back(single);
  for (const auto& source : sources) {
    std::size_t output = 0;
    for (const auto& user : users) {
      for (const InputName& input : input_names(*user)) {
        if (find_entry(recipe, input) == source) output = user->input_output(*source);
      }
    }
    own.entries.push_back(source->with_output(output));
  }
  own.entries.push_back(single);
  return recipe_text(own);
}

}  // namespace

std::vector<OutputFile> output_files(const Recipe& recipe, const Entry& entry, const fs::path& out_dir) {
  std::vector<OutputFile> files;
  for (std::size_t i = 0; i < entry.output_count(); ++i) {
    files.push_back({.path = out_dir / entry.path_of(i),
                     .name = entry.path_of(i),
                     .recipe = recipe_of(recipe, entry.with_output(i))});
  }
  return files;
}

std::vector<OutputFile> free_output_files(const Entry& entry) {
  std::vector<OutputFile> files;
  for (std::size_t i = 0; i < entry.output_count(); ++i) {
    const fs::path path = entry.path_of(i);
    const fs::path folder = fs::absolute(path).lexically_normal().parent_path();
    const std::shared_ptr<Entry> single = entry.with_output(i);
    single->output_path(0) = path.filename().string();
    Options options = single->options();
    for (const InputName& input : input_names(*single)) {
      const fs::path file = fs::absolute(input.text).lexically_normal();
      if (input.is_file())
        options.find(input.key)->set(Value(file.lexically_relative(folder).generic_string()));
    }
    files.push_back({.path = path, .name = path.string(), .recipe = recipe_of(Recipe{}, single)});
  }
  return files;
}

OutputFile contact_sheet_file(const Recipe& recipe, const fs::path& out_dir) {
  return {.path = out_dir / recipe.contact_sheet, .name = recipe.contact_sheet, .recipe = whole_text(recipe)};
}

std::string whole_text(const Recipe& recipe) {
  return recipe.text.empty() ? recipe_text(recipe) : recipe.text;
}

}  // namespace bn::baking
