#include "bake/inputs.h"

#include <algorithm>

#include "bn/error.h"
#include "bn/volume.h"

namespace bn::baking {
namespace {

/// Visits what `entry` is made from, depth first. A cycle ends the search.
void collect(const Recipe& recipe, const Entry& entry, std::vector<const Entry*>& path,
             std::vector<std::shared_ptr<const Entry>>& found) {
  path.push_back(&entry);
  for (const InputName& input : input_names(entry)) {
    if (input.is_file()) continue;
    const auto source = find_entry(recipe, input);
    if (!source || std::find(found.begin(), found.end(), source) != found.end()) continue;
    if (std::find(path.begin(), path.end(), source.get()) != path.end()) continue;
    collect(recipe, *source, path, found);
    found.push_back(source);
  }
  path.pop_back();
}

}  // namespace

std::vector<InputName> input_names(const Entry& entry) {
  std::vector<InputName> names;
  const Options options = options_of(entry);
  for (const Option& option : options.list()) {
    if (option.names_kinds.empty() && !option.names_file) continue;
    const Value value = option.get();
    const auto* text = std::get_if<std::string>(&value);
    if (text) names.push_back({.key = option.key, .kinds = option.names_kinds, .text = *text});
  }
  return names;
}

std::shared_ptr<const Entry> find_entry(const Recipe& recipe, const std::vector<std::string>& kinds,
                                        std::string_view name) {
  for (const auto& entry : recipe.entries) {
    const bool fits = std::find(kinds.begin(), kinds.end(), entry->kind().table) != kinds.end();
    if (fits && entry->name == name) return entry;
  }
  return nullptr;
}

std::vector<std::shared_ptr<const Entry>> input_entries(const Recipe& recipe, const Entry& entry) {
  std::vector<std::shared_ptr<const Entry>> found;
  std::vector<const Entry*> path;
  collect(recipe, entry, path, found);
  return found;
}

std::vector<std::filesystem::path> input_paths(const Recipe& recipe, const Entry& entry,
                                               const std::filesystem::path& out_dir) {
  std::vector<std::filesystem::path> paths;
  for (const InputName& input : input_names(entry)) {
    if (input.is_file()) {
      paths.push_back(recipe.folder / input.text);
      continue;
    }
    const auto source = find_entry(recipe, input);
    if (!source) {
      throw Error({.code = ErrorCode::invalid_input,
                   .what = "there is no " + input.kinds.front() + " '" + input.text + "'",
                   .where = entry.name,
                   .limit = "",
                   .remedy = "add it to the recipe"});
    }
    paths.push_back(out_dir / source->path_of(entry.input_output(*source)));
  }
  return paths;
}

Input read_input(const std::filesystem::path& path, const Execution& execution) {
  Execution silent = execution;
  silent.progress = {};
  Volume volume = read_volume(path, {}, silent);
  return {.path = path,
          .hash = pixel_hash(volume.image),
          .image = std::move(volume.image),
          .is_mask = volume.metadata && volume.metadata->kind == "mask"};
}

std::vector<Shape> shapes_of(const std::vector<Input>& inputs) {
  std::vector<Shape> shapes;
  for (const Input& input : inputs) shapes.push_back(input.image.shape());
  return shapes;
}

std::vector<std::size_t> baking_order(const Recipe& recipe) {
  std::vector<std::size_t> order;
  std::vector<bool> placed(recipe.entries.size(), false);
  const auto index_of = [&](const std::shared_ptr<const Entry>& entry) {
    return static_cast<std::size_t>(std::find(recipe.entries.begin(), recipe.entries.end(), entry) -
                                    recipe.entries.begin());
  };
  const auto place = [&](std::size_t index) {
    if (placed[index]) return;
    placed[index] = true;
    order.push_back(index);
  };
  for (std::size_t i = 0; i < recipe.entries.size(); ++i) {
    for (const auto& source : input_entries(recipe, *recipe.entries[i])) place(index_of(source));
    place(i);
  }
  return order;
}

std::shared_ptr<const Entry> entry_in_cycle(const Recipe& recipe) {
  for (const auto& entry : recipe.entries) {
    for (const auto& source : input_entries(recipe, *entry)) {
      for (const InputName& input : input_names(*source)) {
        if (!input.is_file() && find_entry(recipe, input) == entry) return entry;
      }
    }
    for (const InputName& input : input_names(*entry)) {
      if (!input.is_file() && find_entry(recipe, input) == entry) return entry;
    }
  }
  return nullptr;
}

}  // namespace bn::baking
