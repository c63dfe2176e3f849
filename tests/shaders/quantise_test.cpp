// Protects: what textures/shaders/bn_quantise.glsl promises. For every input the mean over the noise is the
// light asked for, in the dark and at both ends too; an even dither is never off by a code, a triangular one
// by one and a half at most; triangular noise has the same variance at every value; more noise never gives a
// lower code; and the ways that the text calls wrong are.
#include "quantise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

namespace bn::test {
namespace {

using Dither = std::function<float(Quantise&, float value, float steps, float noise)>;
using Transfer = double (*)(double);

double same(double value) { return value; }
/// IEC 61966-2-1, in doubles.
double light_of(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}
double encoded_of(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

struct Kind {
  const char* name;
  Dither dither;
  Transfer light;    ///< of an encoded value
  Transfer encoded;  ///< of a light
  double most_codes_off;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{
      {"even", [](Quantise& q, float v, float s, float n) { return q.bn_dither(v, s, n); }, same, same, 1.0},
      {"triangular", [](Quantise& q, float v, float s, float n) { return q.bn_dither_triangular(v, s, n); },
       same, same, 1.5},
      {"even, sRGB", [](Quantise& q, float v, float s, float n) { return q.bn_dither_srgb(v, s, n); },
       light_of, encoded_of, 1.0},
      {"triangular, sRGB",
       [](Quantise& q, float v, float s, float n) { return q.bn_dither_srgb_triangular(v, s, n); }, light_of,
       encoded_of, 1.5},
  };
  return all;
}

/// Where a value stands between codes, by light: 3.25 is a quarter of the way from code 3 to code 4.
double place_in_codes(const Kind& kind, double value, int steps) {
  const double low = std::clamp(std::floor(kind.encoded(value) * steps), 0.0, steps - 1.0);
  const double below = kind.light(low / steps), above = kind.light((low + 1.0) / steps);
  return low + (value - below) / (above - below);
}

/// Inputs over all of [0, 1], denser in the dark, with every code's light and its neighbours.
std::vector<float> inputs(const Kind& kind, int steps) {
  std::vector<float> all;
  for (int i = 0; i <= 400; ++i) all.push_back(static_cast<float>(i) / 400.0f);
  for (int i = 0; i < 400; ++i) all.push_back(static_cast<float>(i) / 40000.0f);
  for (int code = 0; code <= steps; ++code) {
    const auto light = static_cast<float>(kind.light(static_cast<double>(code) / steps));
    for (const float v : {std::nextafter(light, 0.0f), light, std::nextafter(light, 1.0f)}) all.push_back(v);
  }
  return all;
}

TEST(Quantise, TheMeanOverTheNoiseIsTheLightAskedFor) {
  Quantise q;
  for (const Kind& kind : kinds()) {
    for (const int steps : {1, 2, 7, 255}) {
      // As many levels as a mask of 16 bits is fine; one of 8 is tried below.
      constexpr int kLevels = 1024;
      double worst = 0.0, bias_in_the_dark = 0.0;
      int dark = 0;
      for (const float value : inputs(kind, steps)) {
        double sum = 0.0;
        for (int k = 0; k < kLevels; ++k) {
          const float code =
              kind.dither(q, value, static_cast<float>(steps), (static_cast<float>(k) + 0.5f) / kLevels);
          sum += kind.light(code);
        }
        const double mean = sum / kLevels;
        // The wider of the two steps hereabouts: a probability is met to half a level.
        const auto light_of_code = [&](double code) { return kind.light(std::min(1.0, code / steps)); };
        const double low = std::floor(kind.encoded(value) * steps);
        const double widest = std::max(light_of_code(low + 1.0) - light_of_code(low),
                                       light_of_code(low + 2.0) - light_of_code(low + 1.0));
        const double off = (mean - value) / widest;
        worst = std::max(worst, std::abs(off));
        if (value < 0.01f) bias_in_the_dark += off, ++dark;
      }
      // Two probabilities, half a level each, and the rounding of floats.
      EXPECT_LT(worst, 1.0 / kLevels + 2e-4) << kind.name << ", " << steps << " steps";
      EXPECT_LT(std::abs(bias_in_the_dark / dark), 1e-4) << kind.name << ", " << steps << " steps";
    }
  }
}

TEST(Quantise, AMaskOfEightBitsIsEnough) {
  Quantise q;
  for (const Kind& kind : kinds()) {
    for (const float value : inputs(kind, 255)) {
      double sum = 0.0;
      for (int level = 0; level < 256; ++level) {
        sum += kind.light(kind.dither(q, value, 255.0f, (static_cast<float>(level) + 0.5f) / 256.0f));
      }
      // A 256th of the steepest step.
      EXPECT_NEAR(sum / 256.0, value, 1.01 / 256.0 * (1.0 - kind.light(254.0 / 255.0)) + 1e-7) << kind.name;
    }
  }
}

TEST(Quantise, IsACodeAndNeverFurtherOffThanPromised) {
  Quantise q;
  for (const Kind& kind : kinds()) {
    for (const int steps : {1, 2, 7, 255, 1023, 65535}) {
      const double to_codes = steps;
      for (const float value : inputs(kind, std::min(steps, 255))) {
        const double at = place_in_codes(kind, value, steps);
        for (const float noise :
             {1e-6f, 0.5f / 256.0f, 0.1f, 0.4999f, 0.5f, 0.77f, 255.5f / 256.0f, 0.99999994f}) {
          const double code = kind.dither(q, value, static_cast<float>(steps), noise) * to_codes;
          EXPECT_NEAR(code, std::round(code), 1e-2) << "a code";
          EXPECT_GE(code, 0.0);
          EXPECT_LE(code, steps);
          EXPECT_LE(std::abs(code - at), kind.most_codes_off + 0.02)
              << kind.name << ", " << steps << " steps, value " << value << ", noise " << noise;
        }
      }
      EXPECT_EQ(kind.dither(q, 0.0f, static_cast<float>(steps), 0.99999994f), 0.0f) << "black stays black";
      EXPECT_EQ(kind.dither(q, 1.0f, static_cast<float>(steps), 1e-6f), 1.0f) << "white stays white";
    }
  }
}

TEST(Quantise, MoreNoiseNeverGivesALowerCode) {
  Quantise q;
  for (const Kind& kind : kinds()) {
    for (const float value : inputs(kind, 31)) {
      float before = 0.0f;
      for (int k = 0; k < 512; ++k) {
        const float code = kind.dither(q, value, 31.0f, (static_cast<float>(k) + 0.5f) / 512.0f);
        EXPECT_GE(code, before) << kind.name << ", value " << value;
        before = code;
      }
    }
  }
}

TEST(Quantise, TriangularNoiseIsTheRoundedSumOfTwoEvenOnes) {
  // On a linear target: exactly the usual remap of one even noise, rounded, wherever three codes are there.
  Quantise q;
  for (int i = 0; i <= 1000; ++i) {
    const float value = static_cast<float>(0.5 / 31 + i / 1000.0 * 30 / 31);
    for (int k = 0; k < 256; ++k) {
      const double u = (k + 0.5) / 256.0;
      const double t = u < 0.5 ? std::sqrt(2.0 * u) - 1.0 : 1.0 - std::sqrt(2.0 - 2.0 * u);
      const double wanted = static_cast<double>(value) * 31.0 + t;
      if (std::abs(wanted - std::floor(wanted) - 0.5) < 1e-4) continue;  // a tie, to a float
      EXPECT_NEAR(q.bn_dither_triangular(value, 31.0f, static_cast<float>(u)) * 31.0f, std::round(wanted),
                  1e-4)
          << value << " " << u;
    }
  }
}

TEST(Quantise, TriangularNoiseHasOneVarianceForAllValues) {
  Quantise q;
  const auto variance = [&](const Kind& kind, double value) {
    double sum = 0.0, squares = 0.0;
    for (int k = 0; k < 4096; ++k) {
      const double code =
          kind.dither(q, static_cast<float>(value), 31.0f, (static_cast<float>(k) + 0.5f) / 4096.0f) * 31.0;
      sum += code, squares += code * code;
    }
    return squares / 4096 - sum / 4096 * sum / 4096;
  };
  for (int i = 0; i <= 300; ++i) {
    const double value = (0.5 + i / 10.0) / 31.0;
    EXPECT_NEAR(variance(kinds()[1], value), 0.25, 0.002) << value;
  }
  EXPECT_NEAR(variance(kinds()[0], 10.0 / 31.0), 0.0, 0.002) << "the even one comes ...";
  EXPECT_NEAR(variance(kinds()[0], 10.5 / 31.0), 0.25, 0.002) << "... and goes";
}

TEST(Quantise, OutOfRangeIsCutOffAndNotANumberIsBlack) {
  Quantise q;
  constexpr float inf = std::numeric_limits<float>::infinity();
  for (const Kind& kind : kinds()) {
    for (const float noise : {0.001f, 0.5f, 0.999f}) {
      for (const float low : {-1.0f, -inf, std::numeric_limits<float>::quiet_NaN()}) {
        EXPECT_EQ(kind.dither(q, low, 255.0f, noise), 0.0f) << kind.name;
      }
      for (const float high : {1.5f, inf}) EXPECT_EQ(kind.dither(q, high, 255.0f, noise), 1.0f) << kind.name;
    }
  }
}

// The claims about other ways, in codes of 8 bits.
TEST(Quantise, OtherWaysAreAsWrongAsTheTextSays) {
  // 1/255 of linear light, in codes, where the sRGB curve is straight.
  EXPECT_NEAR(encoded_of(1.0 / 255.0) * 255.0, 12.9, 0.2);
  // Even noise added to the encoded value and rounded: too bright half-way between codes above the straight
  // part.
  double bias = 0.0, light_step = 0.0;
  for (int code = 20; code < 255; ++code) {
    const double a = light_of(code / 255.0), b = light_of((code + 1) / 255.0);
    const double between = light_of((code + 0.5) / 255.0);
    EXPECT_GT((a + b) / 2, between);
    bias = std::max(bias, ((a + b) / 2 - between) / (b - a));
    light_step = std::max(light_step, b - a);
  }
  EXPECT_GT(bias, 0.005);
  // Triangular noise, rounded and cut off at 0, shows black as an eighth of a code.
  double black = 0.0;
  for (int k = 0; k < 4096; ++k) {
    const double u = (k + 0.5) / 4096.0;
    const double t = u < 0.5 ? std::sqrt(2.0 * u) - 1.0 : 1.0 - std::sqrt(2.0 - 2.0 * u);
    black += std::max(0.0, std::round(t)) / 4096.0;
  }
  EXPECT_NEAR(black, 0.125, 0.001);
}

}  // namespace
}  // namespace bn::test
