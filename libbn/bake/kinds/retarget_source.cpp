#include "bake/kinds/retarget_source.h"

#include <fmt/format.h>

#include <algorithm>

#include "bn/error.h"

namespace bn::baking {

std::vector<int> channels_of(const RetargetEntry& entry) {
  if (entry.anneals && !entry.anneal.channels.empty()) return entry.anneal.channels;
  return {entry.channel};
}

namespace {

std::vector<Levels> levels_of(const Input& input, const std::vector<int>& channels) {
  try {
    std::vector<Levels> levels;
    for (const int channel : channels) levels.push_back(levels_of_channel(input.image, channel));
    return levels;
  } catch (const Error& error) {
    ErrorInfo info = error.info();
    const std::string path = input.path.string();
    info.where = info.where.empty() ? path : fmt::format("{}: {}", path, info.where);
    throw Error(info);
  }
}

/// Levels of two pictures compare only if they have one unit.
void check_pair(const Input& from, const Input& to) {
  const auto text = [](const Image& image) {
    return fmt::format("{}x{}x{}, {}", image.size.width, image.size.height, image.depth, name_of(image.type));
  };
  const bool integers = from.image.type == SampleType::u8 || from.image.type == SampleType::u16;
  if (from.image.shape() == to.image.shape() && from.image.type == to.image.type && integers) return;
  throw Error({.code = ErrorCode::invalid_input,
               .what = fmt::format("{}", text(to.image)),
               .where = to.path.string(),
               .limit = integers ? fmt::format("{}, as {}", text(from.image), from.path.string())
                                 : "8bit or 16bit: levels of two pictures compare only in the same unit",
               .remedy = ""});
}

Grid<std::int32_t> slice(const Grid<std::int32_t>& levels, int z) {
  Grid<std::int32_t> result(levels.size());
  std::copy_n(levels.slice(z).begin(), result.count(), result.begin());
  return result;
}

}  // namespace

Source source_of(const std::vector<Input>& inputs, const std::vector<int>& channels) {
  const Input& input = inputs.at(0);
  Source source{.hash = input.hash,
                .channel = channels.front(),
                .is_mask = input.is_mask,
                .levels = levels_of(input, channels)};
  if (inputs.size() > 1) {
    check_pair(input, inputs[1]);
    source.to_hash = inputs[1].hash;
    source.to = levels_of(inputs[1], channels);
  }
  return source;
}

FrameMasks frame_masks(const Source& source, int z, std::size_t channel) {
  const Grid<std::int32_t>& levels = source.levels.at(channel).value;
  const int next = (z + 1) % levels.depth();
  return {slice(levels, z), source.to.empty() ? slice(levels, next) : slice(source.to.at(channel).value, z)};
}

Offset step_of(const RetargetEntry& entry, const Source& source) {
  if (entry.step) return *entry.step;
  return source.moves() ? auto_step(source.size()).step : Offset{0, 0};
}

int largest_motion(Extent size) { return (std::min(size.width, size.height) - 1) / 2; }

std::size_t motion_index(Offset motion, int range) {
  return static_cast<std::size_t>((motion.y + range) * (2 * range + 1) + motion.x + range);
}

std::vector<std::string> source_notes(const Source& source, const RetargetOptions& options) {
  std::vector<std::string> notes;
  const Levels& levels = source.levels[0];
  const Offset step = options.step;
  const Extent size = levels.value.size();
  if (levels.distinct == 1) {
    notes.emplace_back("the source is constant: every permutation has energy 0");
  } else if (levels.distinct == 2) {
    notes.emplace_back("the source has two levels only: most permutations cost the same");
  } else if (!levels.is_permutation && !source.is_mask) {
    notes.emplace_back(
        "the source is no permutation (its levels are not equally frequent): energies do not compare with a "
        "mask's");
  }
  for (const Levels& channel : source.levels) {
    if (channel.rounding_error == 0.0) continue;
    notes.push_back(fmt::format("float samples rounded to 65536 levels of {:.3g}, by at most {:.3g}",
                                channel.unit, channel.rounding_error));
  }
  if (!source.moves()) {
    // Each frame has a mask of its own, whatever the step.
  } else if (wrap(step.x, size.width) == 0 && wrap(step.y, size.height) == 0) {
    notes.emplace_back("the step is 0 on this tile: the dither never changes, and not moving is optimal");
  } else {
    const std::int64_t orbit = orbit_length(size, step);
    const AutoStep best = auto_step(size);
    if (orbit < best.orbit_length) {
      notes.push_back(fmt::format("step ({}, {}) repeats after {} frames; ({}, {}) would after {}", step.x,
                                  step.y, orbit, best.step.x, best.step.y, best.orbit_length));
    }
  }
  if (2 * options.radius >= std::min(size.width, size.height)) {
    notes.push_back(
        fmt::format("radius {} reaches around the tile of {}x{}: some offsets name the same pixel",
                    options.radius, size.width, size.height));
  }
  return notes;
}

}  // namespace bn::baking
