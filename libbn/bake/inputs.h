// The dependency graph of a recipe: what each entry is made from, and in which order entries are baked.

#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bn/bake.h"

namespace bn::baking {

/// One input of an entry, as its options name it: another entry of the recipe, or a file.
struct InputName {
  std::string key;                 ///< of the option
  std::vector<std::string> kinds;  ///< of the entry, their tables; empty for a file
  std::string text;                ///< the entry's name, or the path
  bool is_file() const { return kinds.empty(); }
};

/// In the order of the options.
std::vector<InputName> input_names(const Entry& entry);

/// Null if there is none of this name and of one of these kinds.
std::shared_ptr<const Entry> find_entry(const Recipe& recipe, const std::vector<std::string>& kinds,
                                        std::string_view name);
inline std::shared_ptr<const Entry> find_entry(const Recipe& recipe, const InputName& input) {
  return find_entry(recipe, input.kinds, input.text);
}

/// The entries that `entry` is made from, directly or through others, each once, those that others build on
/// first.
std::vector<std::shared_ptr<const Entry>> input_entries(const Recipe& recipe, const Entry& entry);

/// Where the inputs of `entry` lie when the recipe is baked into `out_dir`, in the order of input_names().
std::vector<std::filesystem::path> input_paths(const Recipe& recipe, const Entry& entry,
                                               const std::filesystem::path& out_dir);

/// Reads one input, which may be a volume. Errors: as read_volume().
Input read_input(const std::filesystem::path& path, const Execution& execution);
std::vector<Shape> shapes_of(const std::vector<Input>& inputs);

/// Indices into recipe.entries such that every entry comes after those it is made from, and otherwise in
/// their order. The recipe has no cycles; parse_recipe() sees to it.
std::vector<std::size_t> baking_order(const Recipe& recipe);

/// The first entry that is made from itself through others; null if there is none.
std::shared_ptr<const Entry> entry_in_cycle(const Recipe& recipe);

}  // namespace bn::baking
