// Protects: the transform equals its definition to the last places, for every size and shape; the inverse
// gives the data back; threads change no bit; bad input is refused with its position.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "bn/error.h"
#include "direct_dft.h"

namespace bn {
namespace {

using test::LongComplex;
using test::white_values;

/// Root mean square of the error over all frequencies, relative to that of the spectrum; every
/// frequency of the half plane is compared.
template <class T>
double relative_error(const std::vector<T>& values, Shape shape) {
  const auto exact = test::direct_dft(values, shape);
  const HalfSpectrum<T> fast = transform<T>(values, shape);
  EXPECT_EQ(fast.values.size(), static_cast<std::size_t>(half_width(shape)) * shape.height * shape.depth);
  long double error = 0.0L, total = 0.0L;
  std::size_t at = 0;
  for (int row = 0; row < shape.height * shape.depth; ++row) {
    for (int kx = 0; kx < half_width(shape); ++kx, ++at) {
      const LongComplex wanted = exact[static_cast<std::size_t>(row) * shape.width + kx];
      error += std::norm(LongComplex(fast.values[at]) - wanted);
      total += std::norm(wanted);
    }
  }
  return static_cast<double>(std::sqrt(error / (total > 0 ? total : 1.0L)));
}

// Eight rounding units, as the header states: a convolution's three transforms on each of two axes where
// sides have large prime factors, half of that elsewhere.
constexpr double kDoubleBound = 8 * 0x1p-53;
constexpr double kFloatBound = 8 * 0x1p-24;

std::vector<double> centred_noise(Shape shape) {
  auto values = white_values(shape.count(), 7);
  for (double& v : values) v -= 0.5;
  return values;
}

class Sizes : public testing::TestWithParam<Shape> {};

TEST_P(Sizes, EqualTheDefinitionInDouble) {
  EXPECT_LT(relative_error(centred_noise(GetParam()), GetParam()), kDoubleBound);
}

TEST_P(Sizes, EqualTheDefinitionInFloat) {
  const auto values = centred_noise(GetParam());
  EXPECT_LT(relative_error(std::vector<float>(values.begin(), values.end()), GetParam()), kFloatBound);
}

TEST_P(Sizes, InverseGivesTheDataBack) {
  const auto values = centred_noise(GetParam());
  const auto back = inverse_transform(transform<double>(values, GetParam()));
  ASSERT_EQ(back.size(), values.size());
  double error = 0.0, total = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    error += (back[i] - values[i]) * (back[i] - values[i]);
    total += values[i] * values[i];
  }
  EXPECT_LT(std::sqrt(error / total), kDoubleBound);
}

TEST_P(Sizes, ThreadsChangeNoBit) {
  const auto values = centred_noise(GetParam());
  const auto one = transform<double>(values, GetParam(), {.threads = 1});
  for (const int threads : {2, 5}) {
    EXPECT_EQ(transform<double>(values, GetParam(), {.threads = threads}).values, one.values) << threads;
  }
}

INSTANTIATE_TEST_SUITE_P(Transform, Sizes,
                         testing::Values(Shape{1}, Shape{2}, Shape{3}, Shape{4}, Shape{6}, Shape{61},
                                         Shape{64}, Shape{127}, Shape{210}, Shape{1021}, Shape{1, 2},
                                         Shape{1, 127}, Shape{1, 64}, Shape{2, 2}, Shape{3, 5}, Shape{61, 61},
                                         Shape{64, 64}, Shape{127, 33}, Shape{66, 127}, Shape{210, 14},
                                         Shape{62, 74}, Shape{8, 8, 5}, Shape{1, 1, 7}, Shape{5, 1, 37},
                                         Shape{4, 6, 41}),
                         [](const auto& test) {
                           return std::to_string(test.param.width) + "x" + std::to_string(test.param.height) +
                                  "x" + std::to_string(test.param.depth);
                         });

TEST(Transform, ConstantHasNothingButDc) {
  for (const Shape shape : {Shape{64, 64}, Shape{61, 127}, Shape{8, 8, 5}}) {
    const std::vector<double> values(static_cast<std::size_t>(shape.count()), 0.1);
    const auto spectrum = transform<double>(values, shape);
    const double total = 0.1 * static_cast<double>(shape.count());
    EXPECT_NEAR(spectrum.values[0].real(), total, total * 1e-15);
    for (std::size_t i = 1; i < spectrum.values.size(); ++i)
      ASSERT_LT(std::abs(spectrum.values[i]), total * 1e-15);
  }
}

TEST(Transform, ImpulseIsFlat) {
  for (const Shape shape : {Shape{64, 64}, Shape{61, 127}, Shape{8, 8, 5}}) {
    std::vector<double> values(static_cast<std::size_t>(shape.count()));
    values[values.size() / 3] = 1.0;
    for (const auto& f : transform<double>(values, shape).values) ASSERT_NEAR(std::abs(f), 1.0, 4e-15);
    EXPECT_LT(relative_error(values, shape), kDoubleBound);  // the phases too
  }
}

TEST(Transform, CheckerboardIsOneFrequency) {
  const Shape shape{64, 32};
  std::vector<double> values(static_cast<std::size_t>(shape.count()));
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) values[static_cast<std::size_t>(y * 64 + x)] = (x + y) % 2 == 0 ? 1.0 : -1.0;
  }
  const auto spectrum = transform<double>(values, shape);
  for (std::size_t i = 0; i < spectrum.values.size(); ++i) {
    const bool nyquist = i == std::size_t{16} * 33 + 32;
    EXPECT_EQ(spectrum.values[i], std::complex<double>(nyquist ? 2048.0 : 0.0, 0.0)) << i;
  }
}

TEST(Transform, SinusoidOffTheGridLeaksAsDefined) {
  const Shape shape{127, 64};
  std::vector<double> values;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 127; ++x)
      values.push_back(std::sin(2.0 * std::numbers::pi * (0.1234 * x + 0.0517 * y) + 0.3));
  }
  EXPECT_LT(relative_error(values, shape), kDoubleBound);
}

TEST(Transform, ScaleCostsNoAccuracy) {
  const Shape shape{61, 64};
  for (const double scale : {1e-30, 1e30, 1e-150, 1e150}) {
    auto values = centred_noise(shape);
    for (double& v : values) v *= scale;
    EXPECT_LT(relative_error(values, shape), kDoubleBound) << scale;
  }
  for (const double scale : {1e-30, 1e30}) {
    const auto values = centred_noise(shape);
    std::vector<float> scaled;
    for (const double v : values) scaled.push_back(static_cast<float>(v * scale));
    EXPECT_LT(relative_error(scaled, shape), kFloatBound) << scale;
  }
}

TEST(Transform, ParsevalHolds) {
  for (const Shape shape :
       {Shape{210}, Shape{64, 64}, Shape{61, 127}, Shape{127, 61}, Shape{8, 8, 5}, Shape{7, 9, 11}}) {
    const auto values = centred_noise(shape);
    const auto spectrum = transform<double>(values, shape);
    long double energy = 0.0L, power = 0.0L;
    for (const double v : values) energy += static_cast<long double>(v) * v;
    for (std::size_t i = 0; i < spectrum.values.size(); ++i) {
      const int kx = static_cast<int>(i) % half_width(shape);
      const int weight = kx == 0 || 2 * kx == shape.width ? 1 : 2;
      power += weight * std::norm(LongComplex(spectrum.values[i]));
    }
    EXPECT_NEAR(static_cast<double>(power / (energy * shape.count())), 1.0, 1e-13);
  }
}

TEST(Transform, RefusesValuesThatAreNotFinite) {
  const Shape shape{5, 4, 3};
  std::vector<double> values(60, 1.0);
  values[(2 * 4 + 1) * 5 + 3] = std::numeric_limits<double>::quiet_NaN();
  values[(2 * 4 + 3) * 5 + 0] = -std::numeric_limits<double>::infinity();
  const auto expect_refusal = [&](auto call) {
    try {
      call();
      FAIL() << "accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_input);
      EXPECT_NE(std::string(error.what()).find("2 of 60"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("x 3, y 1, z 2"), std::string::npos) << error.what();
    }
  };
  expect_refusal([&] { transform<double>(values, shape); });
  const std::vector<float> floats(values.begin(), values.end());
  expect_refusal([&] { transform<float>(floats, shape); });
  expect_refusal([&] { power_spectrum(values, shape); });
  expect_refusal([&] { analyse(values, shape, 0.0, 1.0); });
}

TEST(Transform, RefusesShapesThatDoNotFit) {
  const std::vector<double> values(6, 1.0);
  for (const Shape shape :
       {Shape{7}, Shape{0, 6}, Shape{-2, -3}, Shape{6, 1, 2}, Shape{kMaxSpectrumSide + 1}}) {
    EXPECT_THROW(transform<double>(values, shape), Error);
    EXPECT_THROW(power_spectrum(values, shape), Error);
  }
  EXPECT_THROW(inverse_transform(HalfSpectrum<double>{{4, 4}, std::vector<std::complex<double>>(5)}), Error);
  EXPECT_THROW(transform<double>(values, {6}, {.memory_limit_bytes = 10}), Error);
}

TEST(Transform, StopsWhenAsked) {
  std::stop_source source;
  source.request_stop();
  try {
    transform<double>(white_values(4096, 1), {64, 64}, {.stop = source.get_token()});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::cancelled);
  }
}

}  // namespace
}  // namespace bn
