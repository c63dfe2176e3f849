// The temporal algorithm on stacks of masks against one mask that moves, on the flat picture.
//
// Two things may tell them apart: how well a tile carries seeds from one mask to the next (its energy), and
// how good the masks themselves are (the floor). 32 masks that know nothing of each other have the floor of
// the one mask and tiles of like energy, so they show what the presets' order in time does.

#include <algorithm>
#include <cmath>

#include "bn/noise.h"
#include "bn/retarget.h"
#include "bn/texture.h"
#include "bn_study/measures.h"
#include "bn_study/models.h"

namespace bn {
namespace {

constexpr int kSeeds = 8;
constexpr double kBand = 0.1;

TemporalTextures unrelated_masks(int count, const Execution& execution) {
  TemporalTextures stack;
  for (int i = 1; i <= count; ++i) {
    const auto ranks = void_and_cluster({.size = {64, 64}, .seed = static_cast<std::uint64_t>(i)}, execution);
    stack.masks.push_back(levels_of_channel(encode_mask(ranks, SampleType::u8), 0).value);
  }
  return stack;
}

/// Values as the model makes them, from the masks' levels in place of random numbers.
double floor_db(const TemporalTextures& textures) {
  double power = 0.0;
  for (const Grid<std::int32_t>& mask : textures.masks) {
    Grid<float> values(mask.size());
    for (std::size_t i = 0; i < values.count(); ++i) {
      const float u = (static_cast<float>(mask[i]) + 0.5f) / 256.0f;
      values[i] = u * u;
    }
    power += low_frequency_power(values, kBand) / static_cast<double>(textures.masks.size());
  }
  return 10.0 * std::log10(power);
}

double mean_energy(const TemporalTextures& textures, int radius) {
  double energy = 0.0;
  const std::int64_t count = std::ssize(textures.masks);
  for (std::int64_t t = 0; t < count; ++t) {
    energy += static_cast<double>(retarget_energy({textures.mask(t), textures.mask(t + 1)},
                                                  textures.move({0, 0}, t),
                                                  {.step = textures.step, .radius = radius}));
  }
  return energy / static_cast<double>(count);
}

}  // namespace

std::vector<StackRow> study_stacks(const TemporalTextures& moved, std::span<const int> frames,
                                   const Execution& execution) {
  std::vector<std::pair<std::string, TemporalTextures>> sources{
      {"one mask, moved", moved}, {"32 unrelated masks", unrelated_masks(32, execution)}};
  for (const auto preset :
       {SpatiotemporalPreset::stbn, SpatiotemporalPreset::filtered, SpatiotemporalPreset::both})
    sources.emplace_back(name_of(preset), make_preset_textures(preset, execution));
  const int last = *std::max_element(frames.begin(), frames.end());
  std::vector<StackRow> rows;
  for (const auto& [radius, block] : {std::pair{6, 8}, {10, 8}, {6, 16}}) {
    for (auto& [name, textures] : sources) {
      solve_moves(textures, radius, execution);
      StackRow row{.masks = name,
                   .radius = radius,
                   .block = block,
                   .energy = mean_energy(textures, radius),
                   .floor_db = floor_db(textures)};
      std::vector<FlatRun> runs(kSeeds);
      parallel_for(execution, kSeeds, [&, block = block](std::int64_t run) {
        throw_if_stopped(execution);
        runs[static_cast<std::size_t>(run)] = run_flat_model(
            {.block = block, .frames = last, .seed = static_cast<std::uint64_t>(run + 1)}, textures);
      });
      const auto mean = [&](std::vector<double> FlatRun::*db, int frame) {
        double sum = 0.0;
        for (const FlatRun& run : runs) sum += (run.*db)[static_cast<std::size_t>(frame)];
        return sum / kSeeds;
      };
      for (const int frame : frames) {
        row.db.push_back(mean(&FlatRun::power_db, frame));
        row.averaged_db.push_back(mean(&FlatRun::averaged_db, frame));
        row.averaged_blurred_db.push_back(mean(&FlatRun::averaged_blurred_db, frame));
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace bn
