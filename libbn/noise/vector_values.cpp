// Values as points of a curve, and the scalar mask pushed through it.
//
// Why a curve: a scalar mask spreads its ranks so that each interval of ranks is blue noise. A curve that is
// continuous and keeps measure makes of each interval a compact region of values, so each such region is blue
// noise too.

#include <algorithm>
#include <cmath>

#include "bn/space_filling_curve.h"
#include "bn/vector_mask.h"
#include "core/reproducible_math.h"
#include "noise/vector_field.h"

namespace bn {
namespace {

using Vector = std::array<double, 4>;

}  // namespace

int noise::curve_dimensions(VectorValues values) {
  switch (values) {
    case VectorValues::vec3:
      return 3;
    case VectorValues::vec4:
      return 4;
    case VectorValues::circle:
      return 1;
    default:
      return 2;
  }
}

namespace {

Vector cube_point(int dimensions, std::uint32_t place) {
  const int bits = curve_bits(dimensions);
  const CurveCell cell = hilbert_cell(place >> (32 - dimensions * bits), dimensions);
  Vector point{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(dimensions); ++i) {
    point[i] = std::ldexp(static_cast<double>(cell[i]) + 0.5, -bits);
  }
  return point;
}

/// From the unit square to the sphere, by way of an octahedron whose faces are folded out (Clarberg 2008).
Vector octahedral(double u, double v) {
  const double a = 2.0 * u - 1.0;
  const double b = 2.0 * v - 1.0;
  const double beyond_equator = std::fabs(a) + std::fabs(b) - 1.0;
  const double r = 1.0 - std::fabs(beyond_equator);
  // Points are middles of cells, so r > 0.
  const auto [cosine, sine] = reproducible_turn(((std::fabs(b) - std::fabs(a)) / r + 1.0) / 8.0);
  const double from_axis = r * std::sqrt(2.0 - r * r);
  return {std::copysign(from_axis * cosine, a), std::copysign(from_axis * sine, b),
          std::copysign(1.0 - r * r, -beyond_equator)};
}

/// From the unit square to the disc (Shirley and Chiu 1997), and up to the hemisphere (Malley).
Vector concentric(double u, double v) {
  const double a = 2.0 * u - 1.0;
  const double b = 2.0 * v - 1.0;
  const bool flat = std::fabs(a) > std::fabs(b);
  const double r = flat ? a : b;
  const double turns = flat ? b / a / 8.0 : 0.25 - a / b / 8.0;
  // Of a negative angle, -turns is used.
  const auto [cosine, sine] = reproducible_turn(std::fabs(turns));
  return {r * cosine, r * std::copysign(sine, turns), std::sqrt(1.0 - r * r)};
}

}  // namespace

std::string_view name_of(VectorValues values) {
  constexpr std::string_view kNames[] = {"vec2", "vec3", "vec4", "circle", "sphere", "hemisphere"};
  return kNames[static_cast<std::size_t>(values)];
}

std::string_view name_of(VectorEnergy energy) {
  return energy == VectorEnergy::half_spaces ? "half_spaces" : "georgiev_fajardo";
}

int vector_components(VectorValues values) {
  constexpr int kComponents[] = {2, 3, 4, 2, 3, 3};
  return kComponents[static_cast<std::size_t>(values)];
}

std::array<float, 4> vector_value(VectorValues values, std::uint32_t place) {
  Vector vector = {};
  if (values == VectorValues::circle) {
    const auto [cosine, sine] = reproducible_turn(std::ldexp(static_cast<double>(place), -32));
    vector = {cosine, sine};
  } else {
    vector = cube_point(noise::curve_dimensions(values), place);
    if (values == VectorValues::sphere) vector = octahedral(vector[0], vector[1]);
    if (values == VectorValues::hemisphere) vector = concentric(vector[0], vector[1]);
  }
  std::array<float, 4> rounded;
  std::transform(vector.begin(), vector.end(), rounded.begin(),
                 [](double c) { return static_cast<float>(c); });
  return rounded;
}

Grid<std::uint32_t> curve_mask(const VectorMaskOptions& options, const Execution& execution) {
  Grid<std::uint32_t> places = spatiotemporal_mask(options.mask, execution);
  const auto in_slice = static_cast<std::uint64_t>(places.size().area());
  const auto depth = static_cast<std::uint64_t>(places.depth());
  const bool by_slice = options.mask.ranks == RankScope::slice;
  // Slices take the ranks in turn, so that all values together are spread as evenly as those of a slice.
  const std::uint64_t strata = in_slice * depth;
  parallel_for(execution, places.depth(), [&](std::int64_t z) {
    for (std::uint32_t& place : places.slice(static_cast<int>(z))) {
      const std::uint64_t stratum = by_slice ? place * depth + static_cast<std::uint64_t>(z) : place;
      place = static_cast<std::uint32_t>(((2 * stratum + 1) << 31) / strata);
    }
  });
  return places;
}

}  // namespace bn
