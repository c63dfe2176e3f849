#include "bn_study/search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <utility>

#include "bn/noise.h"
#include "bn/random.h"
#include "bn/spatiotemporal.h"
#include "bn_study/convergence.h"
#include "core/progress.h"
#include "noise/volume_weights.h"

namespace bn {
namespace {

constexpr std::uint32_t kSwapStream = 94;  // of random_bits

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

SearchResult result_of(std::string method, double seconds, const Grid<std::uint32_t>& ranks,
                       const Execution& execution) {
  const std::vector<double> error = filtered_error(samples_of_ranks(ranks), {}, ranks.depth(), 0, execution);
  return {std::move(method), seconds, error.front(), error.back()};
}

/// Ranks, a column of slices after the other.
class SwapSearch {
 public:
  SwapSearch(const Grid<std::uint32_t>& ranks, std::uint64_t seed)
      : size_(ranks.shape()),
        weights_(
            {size_.width, size_.height, size_.depth},
            {{.x = {AxisForm::gauss, 1.9}, .y = {AxisForm::gauss, 1.9}, .z = {AxisForm::exponential, 0.1}}}),
        seed_(seed) {
    ranks_.resize(ranks.count());
    for (int z = 0; z < size_.depth; ++z) {
      const auto slice = ranks.slice(z);
      for (std::size_t i = 0; i < slice.size(); ++i)
        ranks_[i * static_cast<std::size_t>(size_.depth) + static_cast<std::size_t>(z)] =
            static_cast<std::int32_t>(slice[i]);
    }
    // A line twice over: the weights around any slice are side by side.
    for (int dy = 0; dy <= weights_.reach_y(); ++dy) {
      for (int dx = 0; dx <= weights_.reach_x(); ++dx) {
        for (int i = 0; i < 2 * size_.depth; ++i)
          lines_.push_back(weights_.line(dx, dy)[static_cast<std::size_t>(i % size_.depth)]);
      }
    }
  }

  /// Tries so many swaps more, and returns how many were made.
  std::int64_t run(std::int64_t tries, const Execution& execution) {
    std::int64_t made = 0;
    for (std::int64_t i = 0; i < tries; ++i, ++tried_) {
      if (i % 1024 == 0) throw_if_stopped(execution);
      const std::uint64_t chance = random_bits(seed_, kSwapStream, static_cast<std::uint64_t>(tried_));
      const auto pixels = static_cast<std::uint64_t>(size_.slice().area());
      const auto a = static_cast<int>((chance & 0xFFFFFF) * pixels >> 24);
      const auto b = static_cast<int>((chance >> 24 & 0xFFFFFF) * pixels >> 24);
      const auto z = static_cast<int>((chance >> 48) * static_cast<std::uint64_t>(size_.depth) >> 16);
      // Their own distance stays as it is, though each gain counts it.
      const std::int64_t own = 2 * (between(a, b) - between(a, a)) * std::abs(rank(a, z) - rank(b, z));
      if (a == b || gain(a, b, z) + gain(b, a, z) + own <= 0) continue;
      std::swap(rank(a, z), rank(b, z));
      ++made;
    }
    return made;
  }

  Grid<std::uint32_t> ranks() const {
    Grid<std::uint32_t> ranks(size_);
    for (int z = 0; z < size_.depth; ++z) {
      for (int i = 0; i < static_cast<int>(size_.slice().area()); ++i)
        ranks.slice(z)[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(rank(i, z));
    }
    return ranks;
  }

 private:
  std::int32_t& rank(int pixel, int z) { return ranks_[static_cast<std::size_t>(pixel * size_.depth + z)]; }
  std::int32_t rank(int pixel, int z) const {
    return ranks_[static_cast<std::size_t>(pixel * size_.depth + z)];
  }

  /// How much farther from its surroundings `at` gets with the rank of `other`.
  std::int64_t gain(int at, int other, int z) const {
    const std::int32_t from = rank(at, z), to = rank(other, z);
    const int x = at % size_.width, y = at / size_.width, depth = size_.depth;
    std::int64_t sum = 0;
    for (int dy = first(weights_.reach_y(), size_.height); dy <= weights_.reach_y(); ++dy) {
      for (int dx = first(weights_.reach_x(), size_.width); dx <= weights_.reach_x(); ++dx) {
        const std::int32_t* line = lines_.data() +
                                   (std::abs(dy) * (weights_.reach_x() + 1) + std::abs(dx)) * 2 * depth +
                                   (depth - z);
        const std::int32_t* ranks =
            ranks_.data() +
            std::int64_t{wrap(y + dy, size_.height) * size_.width + wrap(x + dx, size_.width)} * depth;
        std::int64_t of_line = 0;
        for (int i = 0; i < depth; ++i)
          of_line += std::int64_t{line[i]} * (std::abs(to - ranks[i]) - std::abs(from - ranks[i]));
        sum += of_line;
      }
    }
    return sum;
  }
  /// Each distance around the torus once.
  static int first(int reach, int side) { return 2 * reach == side ? 1 - reach : -reach; }

  /// The weight between two pixels of a slice.
  std::int64_t between(int a, int b) const {
    const int dx = std::abs(wrap_centred(a % size_.width - b % size_.width, size_.width));
    const int dy = std::abs(wrap_centred(a / size_.width - b / size_.width, size_.height));
    if (dx > weights_.reach_x() || dy > weights_.reach_y()) return 0;
    return weights_.line(dx, dy)[0];
  }

  Shape size_;
  noise::VolumeWeights weights_;
  std::uint64_t seed_;
  std::int64_t tried_ = 0;
  std::vector<std::int32_t> ranks_, lines_;
};

/// White noise of which every slice has every rank once.
Grid<std::uint32_t> white_ranks(Shape size, std::uint64_t seed) {
  Grid<std::uint32_t> ranks(size);
  for (int z = 0; z < size.depth; ++z) {
    const auto slice =
        white_noise_mask(size.slice(), random_bits(seed, kSwapStream + 1, static_cast<std::uint64_t>(z)));
    std::copy(slice.begin(), slice.end(), ranks.slice(z).begin());
  }
  return ranks;
}

}  // namespace

std::vector<SearchResult> study_search(Shape size, std::span<const std::int64_t> tries_a_voxel,
                                       std::uint64_t seed, const Execution& execution) {
  Execution one_thread = execution;
  one_thread.threads = 1;
  one_thread.progress = {};
  std::vector<SearchResult> results;
  Grid<std::uint32_t> filtered;
  for (const auto preset :
       {SpatiotemporalPreset::stbn, SpatiotemporalPreset::both, SpatiotemporalPreset::filtered}) {
    const double begin = processor_seconds();
    filtered = spatiotemporal_mask({.size = size, .preset = preset, .seed = seed}, one_thread);
    results.push_back(
        result_of(std::string(name_of(preset)), processor_seconds() - begin, filtered, execution));
  }
  const std::int64_t voxels = size.count();
  ProgressMeter meter(execution, static_cast<std::uint64_t>(2 * tries_a_voxel.back()));
  const auto search = [&](std::string method, const Grid<std::uint32_t>& start,
                          std::span<const std::int64_t> budgets) {
    SwapSearch swaps(start, seed);
    double seconds = 0.0;
    std::int64_t tried = 0, made = 0;
    for (const std::int64_t budget : budgets) {
      const double begin = processor_seconds();
      for (; tried < budget; ++tried) {
        made += swaps.run(voxels, one_thread);
        meter.advance(1);
      }
      seconds += processor_seconds() - begin;
      results.push_back(result_of(fmt::format("{}, {} tries a voxel, {} swaps", method, budget, made),
                                  seconds, swaps.ranks(), execution));
    }
  };
  search("swaps from white noise", white_ranks(size, seed), tries_a_voxel);
  search("swaps from filtered", filtered, tries_a_voxel.last(1));
  meter.finish();
  return results;
}

}  // namespace bn
