// Protects: what was done to a broken mask is said, with its figure; nothing is said of textures that are as
// they should be.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bn/error.h"
#include "bn/judgement.h"
#include "bn/noise.h"
#include "direct_dft.h"

namespace bn {
namespace {

constexpr Shape kSmall{64, 64};

std::vector<double> ranks(int side, std::uint64_t seed = 1) {
  const auto rank = void_and_cluster({.size = {side, side}, .seed = seed});
  return {rank.begin(), rank.end()};
}

/// Ranks as levels 0..range-1, as docs/conventions.md has it.
std::vector<double> levels(std::vector<double> rank, double range) {
  const double count = static_cast<double>(rank.size());
  for (double& r : rank) r = std::floor(r * range / count);
  return rank;
}

/// Even values 0..1 through a curve, as levels of `range`.
template <class Curve>
std::vector<double> bent(const std::vector<double>& rank, double range, const Curve& curve) {
  std::vector<double> result;
  for (const double r : rank) {
    const double even = (r + 0.5) / static_cast<double>(rank.size());
    result.push_back(std::clamp(std::floor(range * curve(even)), 0.0, range - 1.0));
  }
  return result;
}

std::vector<Finding> diagnosis(const std::vector<double>& values, Shape shape, double low, double high) {
  return diagnose({values, shape, low, high}, analyse(values, shape, low, high));
}

std::vector<double> picture_of(Shape shape, const auto& value) {
  std::vector<double> result;
  for (int y = 0; y < shape.height; ++y) {
    for (int x = 0; x < shape.width; ++x) result.push_back(value(x, y));
  }
  return result;
}

TEST(Diagnose, SaysNothingOfGoodTextures) {
  for (const int side : {16, 32, 64, 128}) {
    const Shape shape{side, side};
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const auto mask = ranks(side, seed);
      const double n = static_cast<double>(shape.count());
      EXPECT_TRUE(diagnosis(mask, shape, 0, n).empty());
      EXPECT_TRUE(diagnosis(levels(mask, 256), shape, 0, 256).empty()) << side;
      EXPECT_TRUE(diagnosis(levels(mask, 65536), shape, 0, 65536).empty());
      EXPECT_TRUE(diagnosis(test::white_values(shape.count(), seed), shape, 0, 1).empty())
          << side << " " << seed;
    }
    const auto of = [&](const Grid<std::uint32_t>& rank) {
      return diagnosis({rank.begin(), rank.end()}, shape, 0, static_cast<double>(shape.count()));
    };
    EXPECT_TRUE(of(bayer_mask(side)).empty());
    EXPECT_TRUE(of(white_noise_mask({side, side}, 1)).empty());
    EXPECT_TRUE(of(interleaved_gradient_mask({side, side})).empty());
    EXPECT_TRUE(of(r2_mask({side, side})).empty());
  }
}

TEST(Diagnose, FindsTheExponentOfAGamma) {
  const auto mask = ranks(64);
  for (const double range : {256.0, 65536.0}) {
    for (const double exponent : {1 / 2.2, 1 / 1.8, 0.7, 1.5, 2.2}) {
      const auto found =
          diagnosis(bent(mask, range, [&](double v) { return std::pow(v, exponent); }), kSmall, 0, range);
      ASSERT_EQ(found.size(), 1u) << exponent;
      EXPECT_EQ(found[0].cause, Cause::gamma);
      EXPECT_NEAR(found[0].number, exponent, 0.01 * exponent);
    }
  }
  const auto found =
      diagnosis(bent(mask, 256, [](double v) { return std::pow(v, 1 / 2.2); }), kSmall, 0, 256);
  EXPECT_EQ(found.at(0).text, "looks gamma-encoded, exponent .45 (1/2.2)");
}

TEST(Diagnose, TellsSrgbFromAGamma) {
  const auto mask = ranks(64);
  const auto encode = [](double v) {
    return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  };
  const auto decode = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  for (const double range : {256.0, 65536.0}) {
    EXPECT_EQ(diagnosis(bent(mask, range, encode), kSmall, 0, range).at(0).cause, Cause::srgb_encoded);
    EXPECT_EQ(diagnosis(bent(mask, range, decode), kSmall, 0, range).at(0).cause, Cause::srgb_decoded);
  }
}

TEST(Diagnose, NamesTheDistribution) {
  const auto triangle = [](double v) { return v < 0.5 ? std::sqrt(v / 2) : 1 - std::sqrt((1 - v) / 2); };
  const auto normal = [](double v) {  // the inverse of erf by bisection
    double low = -6, high = 6;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (0.5 * std::erfc(-middle / std::sqrt(2.0)) < v ? low : high) = middle;
    }
    return 0.5 + low / 8;
  };
  const auto mask = ranks(64);
  EXPECT_EQ(diagnosis(bent(mask, 256, triangle), kSmall, 0, 256).at(0).cause, Cause::triangular);
  EXPECT_EQ(diagnosis(bent(mask, 65536, triangle), kSmall, 0, 65536).at(0).cause, Cause::triangular);
  EXPECT_EQ(diagnosis(bent(mask, 256, normal), kSmall, 0, 256).at(0).cause, Cause::gaussian);
  const auto half = diagnosis(bent(mask, 256, [](double v) { return v / 2; }), kSmall, 0, 256).at(0);
  EXPECT_EQ(half.cause, Cause::part_of_range);
  EXPECT_NEAR(half.number, 0.5, 0.01);
}

TEST(Diagnose, FindsSwappedBytes) {
  for (const int side : {16, 64, 256}) {
    auto values = levels(ranks(side), 65536);
    for (double& v : values) {
      const auto level = static_cast<unsigned>(v);
      v = (level & 255u) * 256 + level / 256;
    }
    const auto found = diagnosis(values, {side, side}, 0, 65536);
    ASSERT_FALSE(found.empty()) << side;
    EXPECT_EQ(found[0].cause, Cause::bytes_swapped);
  }
}

TEST(Diagnose, FindsEnlarging) {
  const auto mask = levels(ranks(32), 256);
  const auto at = [&](int x, int y) {
    return mask[static_cast<std::size_t>(wrap(y, 32) * 32 + wrap(x, 32))];
  };
  const auto twice =
      diagnosis(picture_of({64, 64}, [&](int x, int y) { return at(x / 2, y / 2); }), {64, 64}, 0, 256);
  ASSERT_EQ(twice.size(), 1u);
  EXPECT_EQ(twice[0].cause, Cause::enlarged);
  EXPECT_EQ(twice[0].text, "is enlarged 2 times, every pixel repeated");
  const auto wide =
      diagnosis(picture_of({96, 32}, [&](int x, int y) { return at(x / 3, y); }), {96, 32}, 0, 256).at(0);
  EXPECT_EQ(wide.x, 3);
  EXPECT_EQ(wide.y, 1);
  // Bilinear, by two.
  const auto smooth = diagnosis(picture_of({64, 64},
                                           [&](int x, int y) {
                                             const int u = x / 2, v = y / 2;
                                             const double a = x % 2 / 2.0, b = y % 2 / 2.0;
                                             return (1 - b) * ((1 - a) * at(u, v) + a * at(u + 1, v)) +
                                                    b * ((1 - a) * at(u, v + 1) + a * at(u + 1, v + 1));
                                           }),
                                {64, 64}, 0, 256);
  const auto found =
      std::find_if(smooth.begin(), smooth.end(), [](auto& f) { return f.cause == Cause::smoothed; });
  ASSERT_NE(found, smooth.end());
  EXPECT_NEAR(found->number, 2.0, 0.5);
}

TEST(Diagnose, FindsRepeatedTiles) {
  const auto mask = ranks(16);
  const auto tile = [&](int x, int y) {
    return mask[static_cast<std::size_t>(wrap(y, 16) * 16 + wrap(x, 16))];
  };
  for (const Shape shape : {Shape{64, 64}, Shape{40, 64}, Shape{50, 27}}) {
    const auto found = diagnosis(picture_of(shape, tile), shape, 0, 256);
    const auto it =
        std::find_if(found.begin(), found.end(), [](auto& f) { return f.cause == Cause::repeated; });
    ASSERT_NE(it, found.end());
    EXPECT_EQ(it->x, 16);
    EXPECT_EQ(it->y, 16);
  }
  // In 8 bit a Bayer matrix of 64 is one of 16, four times over.
  const auto bayer = bayer_mask(64);
  const auto found = diagnosis(levels({bayer.begin(), bayer.end()}, 256), kSmall, 0, 256);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].text, "is one tile repeated, every 16 pixels in x and y");
  // Slices, one of four again and again.
  std::vector<double> volume;
  for (std::uint64_t z = 0; z < 8; ++z) {
    const auto slice = ranks(16, z % 4 + 1);
    volume.insert(volume.end(), slice.begin(), slice.end());
  }
  EXPECT_EQ(diagnosis(volume, {16, 16, 8}, 0, 256).at(0).z, 4);
}

TEST(Diagnose, SearchesALargePictureOfHardlyAnything) {
  // All but three pixels are equal, at the end: every period is refuted by the last pixel only.
  const Shape shape{2048, 2048};
  std::vector<double> values(static_cast<std::size_t>(shape.count()), 5.0);
  values.end()[-1] = 7.0;
  values.end()[-2] = 9.0;
  values.end()[-2049] = 11.0;
  for (const Finding& finding : diagnosis(values, shape, 0, 256)) EXPECT_NE(finding.cause, Cause::repeated);
}

TEST(Diagnose, FindsConstantsAndTwoLevels) {
  EXPECT_EQ(diagnosis(std::vector<double>(4096, 7.0), kSmall, 0, 256).at(0).cause, Cause::constant);
  const auto bits = thresholded(ranks(64), 0.25);
  const auto found = diagnosis(bits, kSmall, 0, 256);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].cause, Cause::two_levels);
  EXPECT_NEAR(found[0].number, 0.25, 1e-3);
}

TEST(Diagnose, CallsAPictureAPicture) {
  const auto found = diagnosis(picture_of(kSmall, [](int x, int y) { return x * y / 16; }), kSmall, 0, 256);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].cause, Cause::picture);
}

TEST(Diagnose, RefusesWhatDoesNotFit) {
  const std::vector<double> four{0, 1, 2, std::nan("")};
  const Analysis analysis = analyse(std::vector<double>{0, 1, 2, 3}, {2, 2}, 0, 4);
  EXPECT_THROW(diagnose({four, {2, 2}, 0, 4}, analysis), Error);
  EXPECT_THROW(diagnose({four, {3, 2}, 0, 4}, analysis), Error);
}

TEST(DiagnoseAlpha, FindsProductsAndQuotients) {
  std::vector<std::vector<double>> straight;
  for (std::uint64_t c = 1; c <= 4; ++c) straight.push_back(levels(ranks(64, c), 256));
  const auto found = [&](const auto& colour) {
    auto stored = straight;
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t i = 0; i < 4096; ++i)
        stored[c][i] = std::floor(colour(straight[c][i], straight[3][i]));
    }
    std::vector<Samples> channels;
    for (const auto& values : stored) channels.push_back({values, kSmall, 0, 256});
    return diagnose_alpha(channels);
  };
  EXPECT_TRUE(found([](double c, double) { return c; }).empty());
  EXPECT_TRUE(found([](double, double a) { return a; }).empty()) << "grey as colour is no product";
  EXPECT_EQ(found([](double c, double a) { return c * a / 255; }).at(0).cause, Cause::alpha_multiplied);
  EXPECT_EQ(found([](double c, double a) { return std::min(255.0, a > 0 ? 255 * c / a : 255); }).at(0).cause,
            Cause::alpha_divided);
  EXPECT_TRUE(diagnose_alpha({}).empty());
}

}  // namespace
}  // namespace bn
