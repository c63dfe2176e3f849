// Speed against error of the two-dimensional transforms at hand.
//
// Problem: a speed without its error says nothing, and a direct transform of 4096^2 values would take days.
// Method: four columns kx of the spectrum are summed in long double, rows first and then the column of row
// sums; each method is timed on the same picture, whose values are exact in float, and held against them.
// The peer's transform is complex and unitary: its results are scaled by sqrt(N) before they are compared.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <numbers>

#include "bn/error.h"
#include "bn/random.h"
#include "bn/spectrum.h"
#include "bn_study/fft.h"
#include "core/module.h"
#include "oiio/fft.h"

namespace bn {
namespace {

using LongComplex = std::complex<long double>;

/// Multiples of 2^-24 in -1/2..1/2.
std::vector<float> picture(int side) {
  std::vector<float> values(std::size_t(side) * static_cast<std::size_t>(side));
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = static_cast<float>(random_bits(1, 0, i) >> 40) * 0x1p-24f - 0.5f;
  }
  return values;
}

struct Column {
  int kx;
  std::vector<LongComplex> value;  // by ky
};

std::vector<Column> exact_columns(const std::vector<float>& values, int side, const Execution& execution) {
  std::vector<LongComplex> root;
  for (int k = 0; k < side; ++k) {
    const long double angle = -2.0L * std::numbers::pi_v<long double> * k / side;
    root.emplace_back(std::cos(angle), std::sin(angle));
  }
  std::vector<Column> columns;
  for (const int kx : {0, 1, side / 3, side / 2}) {
    Column column{kx, std::vector<LongComplex>(static_cast<std::size_t>(side))};
    std::vector<LongComplex> row_sum(static_cast<std::size_t>(side));
    for (int y = 0; y < side; ++y) {
      throw_if_stopped(execution);
      LongComplex sum{};
      for (std::int64_t x = 0; x < side; ++x) {
        sum += static_cast<long double>(values[static_cast<std::size_t>(std::int64_t{y} * side + x)]) *
               root[static_cast<std::size_t>(kx * x % side)];
      }
      row_sum[static_cast<std::size_t>(y)] = sum;
    }
    for (std::int64_t ky = 0; ky < side; ++ky) {
      for (std::int64_t y = 0; y < side; ++y) {
        column.value[static_cast<std::size_t>(ky)] +=
            row_sum[static_cast<std::size_t>(y)] * root[static_cast<std::size_t>(ky * y % side)];
      }
    }
    columns.push_back(std::move(column));
  }
  return columns;
}

/// `result(kx, ky)` against the exact columns.
template <class Result>
double relative_error(const std::vector<Column>& columns, int side, const Result& result) {
  long double error = 0.0L, total = 0.0L;
  for (const Column& column : columns) {
    for (int ky = 0; ky < side; ++ky) {
      const LongComplex& wanted = column.value[static_cast<std::size_t>(ky)];
      error += std::norm(result(column.kx, ky) - wanted);
      total += std::norm(wanted);
    }
  }
  return static_cast<double>(std::sqrt(error / total));
}

/// Median processor time of one call; enough calls for half a second, at least three.
template <class Call>
double median_seconds(const Call& call, const Execution& execution) {
  std::vector<double> seconds;
  double total = 0.0;
  while (seconds.size() < 3 || (total < 0.5 && seconds.size() < 101)) {
    throw_if_stopped(execution);
    const std::clock_t start = std::clock();
    call();
    seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    total += seconds.back();
  }
  const auto middle = seconds.begin() + std::ssize(seconds) / 2;
  std::nth_element(seconds.begin(), middle, seconds.end());
  return *middle;
}

template <class T>
FftStudyRow study_ours(const std::vector<float>& values, int side, const std::vector<Column>& columns,
                       const Execution& execution) {
  const std::vector<T> typed(values.begin(), values.end());
  const Execution one_thread{.threads = 1, .stop = execution.stop};
  HalfSpectrum<T> spectrum;
  const double seconds = median_seconds(
      [&] {
        spectrum = transform<T>(typed, {side, side}, one_thread);
      },
      execution);
  const double error = relative_error(columns, side, [&](int kx, int ky) {
    return LongComplex(
        spectrum.values[static_cast<std::size_t>(std::int64_t{ky} * half_width(spectrum.shape) + kx)]);
  });
  return {"bn", sizeof(T) == sizeof(float) ? "float" : "double", side, seconds, error};
}

FftStudyRow study_openimageio(const std::vector<float>& values, int side, const std::vector<Column>& columns,
                              const Execution& execution) {
  const auto fft = reinterpret_cast<oiio::Fft*>(
      module_symbol("bn_oiio", oiio::kFftSymbol, "the comparison with OpenImageIO",
                    "install OpenImageIO (Debian: libopenimageio2.4)"));
  double seconds = 0.0;
  std::vector<std::complex<float>> spectrum;
  std::string problem;
  fft(
      values.data(), side,
      [&](const std::function<void()>& call) { seconds = median_seconds(call, execution); }, spectrum,
      problem);
  if (!problem.empty()) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = problem,
                 .where = "OpenImageIO's fft",
                 .limit = "",
                 .remedy = ""});
  }
  const double error = relative_error(columns, side, [&](int kx, int ky) {
    return static_cast<long double>(side) *
           LongComplex(spectrum[static_cast<std::size_t>(std::int64_t{ky} * side + kx)]);
  });
  return {"OpenImageIO", "float", side, seconds, error};
}

}  // namespace

std::vector<FftStudyRow> study_fft(const std::vector<int>& sides, const Execution& execution) {
  for (const int side : sides) {
    if (side >= 2 && side <= 8192) continue;
    throw Error({.code = ErrorCode::invalid_input,
                 .what = fmt::format("a side of {}", side),
                 .where = "study of transforms",
                 .limit = "2..8192",
                 .remedy = ""});
  }
  std::vector<FftStudyRow> rows;
  for (const int side : sides) {
    const auto values = picture(side);
    const auto columns = exact_columns(values, side, execution);
    rows.push_back(study_ours<double>(values, side, columns, execution));
    rows.push_back(study_ours<float>(values, side, columns, execution));
    rows.push_back(study_openimageio(values, side, columns, execution));
    if (execution.progress)
      execution.progress(static_cast<double>(rows.size()) / (3.0 * static_cast<double>(sides.size())));
  }
  return rows;
}

}  // namespace bn
