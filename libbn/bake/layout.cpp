#include "bake/layout.h"

#include <algorithm>

#include "bn/error.h"

namespace bn {
namespace {

template <class Entry, class Output>
Entry with_one_output(const Entry& entry, const Output& output) {
  Entry single = entry;
  single.outputs = {output};
  return single;
}

/// A recipe of nothing yet, for the text inside a file.
Recipe bare_recipe() {
  Recipe recipe;
  recipe.contact_sheet.clear();
  return recipe;
}

}  // namespace

std::vector<JobFile> mask_files(const MaskEntry& entry, const std::filesystem::path& out_dir) {
  std::vector<JobFile> files;
  for (const MaskOutput& output : entry.outputs) {
    Recipe single = bare_recipe();
    single.masks = {with_one_output(entry, output)};
    files.push_back({.path = out_dir / output.path, .name = output.path, .recipe = recipe_text(single)});
  }
  return files;
}

std::vector<JobFile> retarget_files(const Recipe& recipe, const RetargetEntry& entry,
                                    const std::filesystem::path& out_dir) {
  std::vector<JobFile> files;
  for (const RetargetOutput& output : entry.outputs) {
    Recipe single = bare_recipe();
    if (const MaskEntry* mask = mask_of(recipe, entry)) {
      single.masks = {with_one_output(*mask, source_output(*mask, entry))};
    }
    single.retargets = {with_one_output(entry, output)};
    files.push_back({.path = out_dir / output.path, .name = output.path, .recipe = recipe_text(single)});
  }
  return files;
}

JobFile contact_sheet_file(const Recipe& recipe, const std::filesystem::path& out_dir) {
  return {.path = out_dir / recipe.contact_sheet, .name = recipe.contact_sheet, .recipe = whole_text(recipe)};
}

std::vector<JobFile> free_mask_files(const MaskEntry& entry) {
  std::vector<JobFile> files;
  for (const MaskOutput& output : entry.outputs) {
    MaskOutput beside = output;
    beside.path = std::filesystem::path(output.path).filename().string();
    files.push_back(mask_files(with_one_output(entry, beside), "").front());
    files.back().path = output.path;
    files.back().name = output.path;
  }
  return files;
}

std::vector<JobFile> free_retarget_files(const RetargetEntry& entry) {
  std::vector<JobFile> files;
  for (const RetargetOutput& output : entry.outputs) {
    RetargetOutput beside = output;
    beside.path = std::filesystem::path(output.path).filename().string();
    RetargetEntry single = with_one_output(entry, beside);
    const auto folder = std::filesystem::absolute(output.path).lexically_normal().parent_path();
    const auto image = std::filesystem::absolute(entry.image).lexically_normal();
    single.image = image.lexically_relative(folder).generic_string();
    files.push_back(retarget_files(Recipe{}, single, "").front());
    files.back().path = output.path;
    files.back().name = output.path;
  }
  return files;
}

std::string whole_text(const Recipe& recipe) {
  return recipe.text.empty() ? recipe_text(recipe) : recipe.text;
}

const MaskEntry* mask_of(const Recipe& recipe, const RetargetEntry& entry) {
  const auto found = std::find_if(recipe.masks.begin(), recipe.masks.end(),
                                  [&](const MaskEntry& mask) { return mask.name == entry.mask; });
  return entry.mask.empty() || found == recipe.masks.end() ? nullptr : &*found;
}

const MaskOutput& source_output(const MaskEntry& mask, const RetargetEntry& entry) {
  const auto found = std::find_if(mask.outputs.begin(), mask.outputs.end(),
                                  [&](const MaskOutput& output) { return output.type == entry.levels; });
  if (found != mask.outputs.end()) return *found;
  throw Error(
      {.code = ErrorCode::invalid_input,
       .what = "mask '" + mask.name + "' has no output of the levels of retarget '" + entry.name + "'",
       .where = "recipe",
       .limit = "",
       .remedy = "add one to its outputs"});
}

std::filesystem::path source_path(const Recipe& recipe, const RetargetEntry& entry,
                                  const std::filesystem::path& out_dir) {
  const MaskEntry* mask = mask_of(recipe, entry);
  return mask ? out_dir / source_output(*mask, entry).path : recipe.folder / entry.image;
}

}  // namespace bn
