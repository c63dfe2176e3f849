// What a contact sheet shows: every retarget set, every spatiotemporal mask, and every mask that no set uses,
// read back from their own files. sheet.cpp draws it.

#include "bake/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "bake/inputs.h"
#include "bake/kinds/retarget_source.h"
#include "bake/sheet.h"
#include "bn/volume.h"

namespace bn::baking {
namespace {

constexpr int kMaxSets = 32, kMaxStacks = 32, kMaxMasks = 128;

/// Reads what the sheet shows of a set from its own files.
SheetSet view_of(const Recipe& recipe, const RetargetEntry& entry, const JobRecord& job,
                 const std::filesystem::path& out_dir, const Execution& execution) {
  std::vector<Input> inputs;
  for (const auto& path : input_paths(recipe, entry, out_dir)) inputs.push_back(read_input(path, execution));
  const Source source = source_of(inputs, channels_of(entry));
  const Levels& levels = source.levels[0];
  FrameMasks masks = frame_masks(source, 0);  // of a stack its first slice
  const Extent size = levels.value.size();
  const auto mask = std::dynamic_pointer_cast<const MaskEntry>(find_entry(recipe, {"mask"}, entry.mask));
  SheetSet view;
  view.name = entry.name;
  view.levels = std::move(masks.from);
  view.to = std::move(masks.to);
  view.source =
      mask ? fmt::format("sigma {}, seed {}", mask->void_and_cluster.sigma_px, mask->void_and_cluster.seed)
           : fmt::format("{} levels", levels.distinct);
  view.step = job.facts.get<Offset>("step").value_or(Offset{});
  view.radius = entry.problem.radius;
  view.motion = entry.motion;
  const auto motions = static_cast<std::size_t>((2 * entry.motion + 1) * (2 * entry.motion + 1));
  view.tiles = {job.tiles.begin(),
                job.tiles.begin() + static_cast<std::ptrdiff_t>(std::min(motions, job.tiles.size()))};
  // What is said of a stack is said of all its slices.
  std::int64_t least = std::numeric_limits<std::int64_t>::max(), most = 0;
  for (std::size_t i = motion_index({0, 0}, entry.motion); i < job.tiles.size(); i += motions) {
    least = std::min(least, job.tiles[i].energy);
    most = std::max(most, job.tiles[i].energy);
  }
  view.plain = view.tiles.at(motion_index({0, 0}, entry.motion));
  const auto optimal = static_cast<std::size_t>(std::count_if(
      job.tiles.begin(), job.tiles.end(), [](auto& tile) { return tile.energy == tile.lower_bound; }));
  view.about = fmt::format(
      "{} x {}   step ({}, {}), {}   radius {} {}, {}{}   {} motion{}, {} proven optimal", size.width,
      size.height, view.step.x, view.step.y,
      source.moves()
          ? fmt::format("repeats after {} frames", job.facts.get<std::int64_t>("orbit_length").value_or(0))
      : source.depth() > 1 ? fmt::format("slice 0 of {}, E {}..{}", source.depth(), least, most)
                           : std::string("to another mask"),
      entry.problem.radius, name_of(entry.problem.reach), name_of(entry.problem.metric),
      entry.problem.wrap ? "" : ", no wrap", motions, motions == 1 ? "" : "s",
      optimal == job.tiles.size() ? "all" : fmt::format("{}", optimal));
  for (const RetargetOutput& output : entry.outputs) {
    const bool is_tile = output.kind == RetargetOutput::Kind::tile;
    const bool shows_plain_tile = !view.tile && (!is_tile || output.motion == Offset{});
    const bool shows_atlas = !view.atlas && !is_tile && entry.motion > 0;
    if (!shows_plain_tile && !shows_atlas) continue;
    const Image image = slice_of(read_volume(out_dir / output.path, {}, execution).image, 0);
    if (shows_plain_tile) {
      const int index = is_tile ? 0 : static_cast<int>(motion_index({0, 0}, entry.motion));
      const Grid<Offset> stored = decode_moves(atlas_tile(image, size, index));
      view.tile = output.form == MoveForm::scatter ? stored : invert_moves(stored);
    }
    if (shows_atlas) view.atlas = decode_moves(image);
  }
  return view;
}

}  // namespace

Metadata contact_sheet_metadata() {
  Metadata metadata;
  metadata.algorithm = kContactSheetKind;
  metadata.algorithm_version = kContactSheetVersion;
  metadata.kind = kContactSheetKind;
  return metadata;
}

Image draw_contact_sheet(const Recipe& recipe, const std::filesystem::path& out_dir,
                         const std::vector<JobRecord>& jobs, const Execution& execution) {
  std::vector<const RetargetEntry*> all_sets;
  std::vector<const MaskEntry*> lone_masks;
  for (const auto& entry : recipe.entries) {
    // What moves between slices has no flat picture.
    const auto* set = dynamic_cast<const RetargetEntry*>(entry.get());
    if (set && !set->volume) all_sets.push_back(set);
  }
  for (const auto& entry : recipe.entries) {
    const auto* mask = dynamic_cast<const MaskEntry*>(entry.get());
    const bool used = mask && std::any_of(all_sets.begin(), all_sets.end(),
                                          [&](auto* set) { return set->mask == mask->name; });
    if (mask && !used) lone_masks.push_back(mask);
  }
  std::vector<SheetSet> sets;
  for (std::size_t i = 0; i < std::min<std::size_t>(all_sets.size(), kMaxSets); ++i) {
    throw_if_stopped(execution);
    const RetargetEntry& set = *all_sets[i];
    const auto job = std::find_if(jobs.begin(), jobs.end(), [&](auto& made) {
      return made.kind == "retarget" && made.name == set.name;
    });
    if (job != jobs.end()) sets.push_back(view_of(recipe, set, *job, out_dir, execution));
  }
  std::vector<SheetMask> masks;
  for (std::size_t i = 0; i < std::min<std::size_t>(lone_masks.size(), kMaxMasks); ++i) {
    throw_if_stopped(execution);
    const MaskEntry& mask = *lone_masks[i];
    Levels levels = source_of({read_input(out_dir / mask.path_of(0), execution)}, {0}).levels[0];
    const Extent size = levels.value.size();
    masks.push_back(
        {mask.name, fmt::format("{} x {}", size.width, size.height),
         fmt::format("sigma {}, seed {}", mask.void_and_cluster.sigma_px, mask.void_and_cluster.seed),
         std::move(levels.value), levels.distinct});
  }
  std::vector<const SpatiotemporalEntry*> all_stacks;
  for (const auto& entry : recipe.entries) {
    if (const auto* stack = dynamic_cast<const SpatiotemporalEntry*>(entry.get()))
      all_stacks.push_back(stack);
  }
  std::vector<SheetStack> stacks;
  for (std::size_t i = 0; i < std::min<std::size_t>(all_stacks.size(), kMaxStacks); ++i) {
    throw_if_stopped(execution);
    const SpatiotemporalEntry& stack = *all_stacks[i];
    Levels levels = source_of({read_input(out_dir / stack.path_of(0), execution)}, {0}).levels[0];
    const Shape shape = levels.value.shape();
    stacks.push_back({stack.name,
                      fmt::format("{} x {} x {}, preset {}, seed {}", shape.width, shape.height, shape.depth,
                                  name_of(stack.mask.preset), stack.mask.seed),
                      std::move(levels.value), levels.distinct});
  }
  const std::size_t left_out =
      all_sets.size() - sets.size() + all_stacks.size() - stacks.size() + lone_masks.size() - masks.size();
  return draw_sheet(sets, stacks, masks, static_cast<int>(left_out), execution);
}

}  // namespace bn::baking
