// Protects: values have the length, the density and the continuity that they promise; the curve mask spreads
// them evenly, slice by slice.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "bn/error.h"
#include "bn/vector_mask.h"

namespace bn {
namespace {

constexpr VectorValues kAll[] = {VectorValues::vec2,   VectorValues::vec3,   VectorValues::vec4,
                                 VectorValues::circle, VectorValues::sphere, VectorValues::hemisphere};

class Values : public testing::TestWithParam<VectorValues> {
 protected:
  /// The mean of `f` over 2^16 values spread evenly over the curve.
  template <class F>
  double mean(F f) const {
    constexpr std::uint32_t kCount = 1 << 16;
    double sum = 0.0;
    for (std::uint32_t i = 0; i < kCount; ++i) sum += f(vector_value(GetParam(), (i << 16) + (1u << 15)));
    return sum / kCount;
  }
  bool is_direction() const { return GetParam() >= VectorValues::circle; }
};
INSTANTIATE_TEST_SUITE_P(All, Values, testing::ValuesIn(kAll),
                         [](const auto& test) { return std::string(name_of(test.param)); });

TEST_P(Values, LieWhereTheyShould) {
  const auto components = static_cast<std::size_t>(vector_components(GetParam()));
  for (std::uint64_t place = 0; place < std::uint64_t{1} << 32; place += 77777) {
    const auto v = vector_value(GetParam(), static_cast<std::uint32_t>(place));
    double square = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      square += double{v[i]} * v[i];
      if (i >= components) {
        ASSERT_EQ(v[i], 0.0f);
      } else if (!is_direction()) {
        ASSERT_TRUE(v[i] > 0.0f && v[i] < 1.0f);
      }
    }
    if (is_direction()) {
      ASSERT_NEAR(square, 1.0, 3e-7);
    }
    if (GetParam() == VectorValues::hemisphere) {
      ASSERT_GE(v[2], 0.0f);
    }
  }
}

TEST_P(Values, HaveTheirMoments) {
  const auto components = static_cast<std::size_t>(vector_components(GetParam()));
  // The side of the cell of which each place tells no more; half of it.
  const double tolerance = GetParam() == VectorValues::vec4   ? 1.0 / 32
                           : GetParam() == VectorValues::vec3 ? 1.0 / 80
                                                              : 1.0 / 512;
  const bool hemisphere = GetParam() == VectorValues::hemisphere;
  for (std::size_t i = 0; i < components; ++i) {
    // Uniform: 1/2, 1/3. Sphere: 0, 1/3. Cosine hemisphere: mean z 2/3; squares 1/4, 1/4, 1/2.
    const bool up = hemisphere && i == 2;
    const double first = !is_direction() ? 0.5 : up ? 2.0 / 3.0 : 0.0;
    const double second = !is_direction() ? 1.0 / 3.0
                          : hemisphere    ? (up ? 0.5 : 0.25)
                                          : 1.0 / static_cast<double>(components);
    EXPECT_NEAR(mean([&](const auto& v) { return v[i]; }), first, tolerance);
    EXPECT_NEAR(mean([&](const auto& v) { return v[i] * v[i]; }), second, tolerance);
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_NEAR(mean([&](const auto& v) { return v[i] * v[j]; }), is_direction() ? 0.0 : 0.25, tolerance);
    }
  }
  // A cap of directions, or a corner of the cube, has its share.
  if (hemisphere) {
    EXPECT_NEAR(mean([](const auto& v) { return v[2] > 0.8f; }), 1.0 - 0.64, tolerance);
  } else if (GetParam() == VectorValues::sphere) {
    EXPECT_NEAR(mean([](const auto& v) { return v[0] + v[1] + v[2] > 0.9f; }), 0.5 - 0.45 / std::sqrt(3.0),
                tolerance);
  }
}

TEST_P(Values, NearPlacesAreNear) {
  double farthest = 0.0;
  constexpr std::uint32_t kCount = 1 << 12;
  for (std::uint32_t i = 0; i + 1 < kCount; ++i) {
    const auto a = vector_value(GetParam(), i << 20);
    const auto b = vector_value(GetParam(), (i + 1) << 20);
    double square = 0.0;
    for (std::size_t k = 0; k < 4; ++k) square += (double{b[k]} - a[k]) * (double{b[k]} - a[k]);
    farthest = std::max(farthest, std::sqrt(square));
  }
  // A 4096th of the curve is a cell of 1/64, 1/16 or 1/8 a side. The hemisphere is steep at its rim.
  const double most = GetParam() == VectorValues::hemisphere ? 0.3
                      : GetParam() == VectorValues::vec3     ? 0.12
                      : GetParam() == VectorValues::vec4     ? 0.22
                                                             : 0.09;
  EXPECT_LT(farthest, most);
}

TEST_P(Values, OfEachSliceAreSpreadEvenly) {
  const Grid<std::uint32_t> places =
      curve_mask({.values = GetParam(), .mask = {.size = {16, 8, 5}, .ranks = RankScope::slice}});
  std::set<std::uint32_t> all(places.begin(), places.end());
  EXPECT_EQ(all.size(), places.count());
  for (int z = 0; z < places.depth(); ++z) {
    std::set<std::uint64_t> strata;
    for (const std::uint32_t place : places.slice(z)) strata.insert(std::uint64_t{place} * 128 >> 32);
    EXPECT_EQ(strata.size(), 128u);
  }
}

TEST(CurveMask, OfOneVoxel) {
  const auto places = curve_mask({.mask = {.size = {1, 1, 1}}});
  ASSERT_EQ(places.count(), 1u);
  EXPECT_EQ(places[0], 1u << 31);
}

TEST(CurveMask, RefusesWhatTheScalarMaskRefuses) {
  EXPECT_THROW(curve_mask({.mask = {.size = {0, 8, 8}}}), Error);
  EXPECT_THROW(curve_mask({.mask = {.size = {8, 8, 8}, .temporal_width = 2.0}}), Error);
}

}  // namespace
}  // namespace bn
