// A contact sheet is a baked file, so its bytes must not depend on the C library's sine or on the order in
// which an FFT adds. Every m-th frequency of a line is the whole spectrum of the line folded m times onto
// itself, so large masks shrink by exact integer sums first; what is left, at most 128 x 128, is transformed
// by its definition, line by line, with sines from their series. Additions and products are in a written
// order.

#include "bake/sheet_spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/reproducible_math.h"

namespace bn::baking {
namespace {

constexpr int kMostFrequencies = 128;
constexpr double kLow_db = -50.0, kHigh_db = 12.5;

/// The least divisor of `side` that leaves at most kMostFrequencies, or 0.
int folds_of(int side) {
  for (int m = 1; m <= side / 2; ++m) {
    if (side % m == 0 && side / m <= kMostFrequencies) return m;
  }
  return side <= kMostFrequencies ? 1 : 0;
}

struct SineCosine {
  double sine, cosine;
};

/// Of 2 pi k / n for 0 <= k < n, by their series over an eighth of a turn and symmetry.
SineCosine sine_cosine(int k, int n) {
  constexpr double kPi = 3.14159265358979323846;
  const int quarter = 4 * k / n;       // which quarter of the turn
  int rest = 4 * k - quarter * n;      // 0 <= rest < n: rest / n quarters
  const bool mirrored = 2 * rest > n;  // beyond an eighth: from the other axis
  if (mirrored) rest = n - rest;
  const double x = 0.5 * kPi * rest / n, x2 = x * x;
  double sine = 0.0, cosine = 0.0;
  for (int term = 10; term >= 0; --term) {
    sine = 1.0 - sine * x2 / ((2 * term + 2) * (2 * term + 3));
    cosine = 1.0 - cosine * x2 / ((2 * term + 1) * (2 * term + 2));
  }
  sine *= x;
  if (mirrored) std::swap(sine, cosine);
  switch (quarter) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

std::vector<SineCosine> turn(int n) {
  std::vector<SineCosine> table;
  for (int k = 0; k < n; ++k) table.push_back(sine_cosine(k, n));
  return table;
}

/// Power against white noise, DC in the middle and 0.
Grid<double> power_of(const Grid<std::int32_t>& levels) {
  const int fold_x = folds_of(levels.width()), fold_y = folds_of(levels.height());
  if (fold_x == 0 || fold_y == 0 || levels.count() < 2) return {};
  const int w = levels.width() / fold_x, h = levels.height() / fold_y;
  std::int64_t sum = 0, squares = 0;
  Grid<std::int64_t> folded(Extent{w, h});
  for (int y = 0; y < levels.height(); ++y) {
    for (int x = 0; x < levels.width(); ++x) {
      const std::int64_t level = levels(x, y);
      sum += level;
      squares += level * level;
      folded(x % w, y % h) += level;
    }
  }
  const double count = static_cast<double>(levels.count()), mean = static_cast<double>(sum) / count;
  const double variance = static_cast<double>(squares) / count - mean * mean;
  if (!(variance > 0.0)) return {};

  const std::vector<SineCosine> turn_x = turn(w), turn_y = turn(h);
  Grid<double> real(Extent{w, h}), imaginary(Extent{w, h});  // transformed along x
  for (int y = 0; y < h; ++y) {
    for (int k = 0; k < w; ++k) {
      double re = 0.0, im = 0.0;
      for (int x = 0, at = 0; x < w; ++x) {
        const double value = static_cast<double>(folded(x, y));
        re += value * turn_x[static_cast<std::size_t>(at)].cosine;
        im -= value * turn_x[static_cast<std::size_t>(at)].sine;
        at += k;
        if (at >= w) at -= w;
      }
      real(k, y) = re;
      imaginary(k, y) = im;
    }
  }
  Grid<double> power(Extent{w, h});
  for (int k = 0; k < h; ++k) {
    for (int j = 0; j < w; ++j) {
      double re = 0.0, im = 0.0;
      for (int y = 0, at = 0; y < h; ++y) {
        const SineCosine& t = turn_y[static_cast<std::size_t>(at)];
        re += real(j, y) * t.cosine + imaginary(j, y) * t.sine;
        im += imaginary(j, y) * t.cosine - real(j, y) * t.sine;
        at += k;
        if (at >= h) at -= h;
      }
      power((j + w / 2) % w, (k + h / 2) % h) =
          j == 0 && k == 0 ? 0.0 : (re * re + im * im) / (count * variance);
    }
  }
  return power;
}

Grid<std::uint8_t> decibels(const Grid<double>& power) {
  const double scale = 10.0 / reproducible_log(10.0);
  Grid<std::uint8_t> picture(power.size());
  for (std::size_t i = 0; i < power.count(); ++i) {
    const double db = scale * reproducible_log(std::max(power[i], 1e-12));
    const double share = std::clamp((db - kLow_db) / (kHigh_db - kLow_db), 0.0, 1.0);
    picture[i] = static_cast<std::uint8_t>(255.0 * share + 0.5);
  }
  return picture;
}

}  // namespace

Grid<std::uint8_t> sheet_spectrum(const Grid<std::int32_t>& levels) { return decibels(power_of(levels)); }

Grid<std::uint8_t> sheet_spectrum_in_time(const Grid<std::int32_t>& volume) {
  constexpr int kMostRows = 16;  // enough for a calm mean
  const int rows = std::min(volume.height(), kMostRows);
  Grid<double> sum;
  for (int i = 0; i < rows; ++i) {
    const int y = static_cast<int>(std::int64_t{i} * volume.height() / rows);
    const Grid<double> power = power_of(row_in_time(volume, y));
    if (power.count() == 0) return {};
    if (i == 0) {
      sum = power;
      continue;
    }
    for (std::size_t at = 0; at < sum.count(); ++at) sum[at] += power[at];
  }
  for (double& power : sum) power /= rows;
  return decibels(sum);
}

Grid<std::int32_t> row_in_time(const Grid<std::int32_t>& volume, int y) {
  Grid<std::int32_t> plane(Extent{volume.width(), volume.depth()});
  for (int z = 0; z < volume.depth(); ++z) {
    const auto slice = volume.slice(z);
    for (int x = 0; x < volume.width(); ++x)
      plane(x, z) = slice[static_cast<std::size_t>(y) * static_cast<std::size_t>(volume.width()) +
                          static_cast<std::size_t>(x)];
  }
  return plane;
}

}  // namespace bn::baking
