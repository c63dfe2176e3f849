// Transforms in one, two and three dimensions, axis by axis.
//
// Problem: real data of any shape; only half the plane need be computed and kept.
// Method: every row from real to half (W/2 + 1 frequencies), then the lines along y, then along z, in place.
// A line along y or z is a stride apart in memory: eight neighbouring lines are gathered into one buffer,
// transformed and scattered back, so each cache line that is fetched is used whole.
// Invariant: each line is transformed on its own, by one thread, so the number of threads changes no bit.
// Cost: 1024^2 in about a hundredth of a second (docs/spectrum.md).

#include "spectrum/transform.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <vector>

#include "bn/error.h"
#include "spectrum/line_fft.h"

namespace bn {
namespace spectrum {
namespace {

/// Lines gathered at once: eight complex doubles fill two cache lines.
constexpr int kBlockLines = 8;

/// Engines of one length with their buffers, lent to one task at a time: their tables are made once a thread,
/// not once a task.
template <class T>
class Workshop {
 public:
  struct Bench {
    LineFft<T> fft;
    std::vector<std::complex<T>> gathered, result;
    std::vector<T> row;
  };

  explicit Workshop(int length) : length_(length) {}

  template <class Body>
  void with_bench(const Body& body) {
    std::unique_ptr<Bench> bench = take();
    body(*bench);
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(bench));
  }

 private:
  std::unique_ptr<Bench> take() {
    {
      const std::lock_guard lock(mutex_);
      if (!free_.empty()) {
        std::unique_ptr<Bench> bench = std::move(free_.back());
        free_.pop_back();
        return bench;
      }
    }
    return std::make_unique<Bench>(Bench{LineFft<T>(length_), {}, {}, {}});
  }

  int length_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Bench>> free_;
};

enum class Direction { forward, inverse };

/// Transforms `lines` neighbouring lines of `length` values `stride` apart, in each of `groups` groups.
template <class T>
void transform_lines(std::complex<T>* data, int length, std::int64_t stride, std::int64_t lines,
                     std::int64_t groups, Direction direction, const Execution& execution) {
  if (length == 1) return;
  const std::int64_t blocks = (lines + kBlockLines - 1) / kBlockLines;
  Workshop<T> workshop(length);
  parallel_for(execution, groups * blocks, [&](std::int64_t task) {
    throw_if_stopped(execution);
    const std::int64_t first = task % blocks * kBlockLines;
    const int count = static_cast<int>(std::min<std::int64_t>(kBlockLines, lines - first));
    std::complex<T>* base = data + task / blocks * length * stride + first;
    workshop.with_bench([&](auto& bench) {
      bench.gathered.resize(static_cast<std::size_t>(length) * kBlockLines);
      bench.result.resize(static_cast<std::size_t>(length) * kBlockLines);
      std::complex<T>* gathered = bench.gathered.data();
      std::complex<T>* result = bench.result.data();
      for (int i = 0; i < length; ++i) {
        for (int l = 0; l < count; ++l) gathered[l * length + i] = base[i * stride + l];
      }
      for (int l = 0; l < count; ++l) {
        const auto offset = static_cast<std::ptrdiff_t>(l) * length;
        if (direction == Direction::forward) {
          bench.fft.forward(result + offset, gathered + offset);
        } else {
          bench.fft.inverse(result + offset, gathered + offset);
        }
      }
      for (int i = 0; i < length; ++i) {
        for (int l = 0; l < count; ++l) base[i * stride + l] = result[l * length + i];
      }
    });
  });
}

/// Calls body(bench, row) for every row, some rows to a task.
template <class T, class Body>
void for_each_row(const Shape& shape, const Execution& execution, const Body& body) {
  const std::int64_t rows = std::int64_t{shape.height} * shape.depth;
  const std::int64_t rows_a_task = std::max<std::int64_t>(1, (std::int64_t{1} << 14) / shape.width);
  Workshop<T> workshop(shape.width);
  parallel_for(execution, (rows + rows_a_task - 1) / rows_a_task, [&](std::int64_t task) {
    throw_if_stopped(execution);
    workshop.with_bench([&](auto& bench) {
      bench.row.resize(static_cast<std::size_t>(shape.width));
      const std::int64_t end = std::min(rows, (task + 1) * rows_a_task);
      for (std::int64_t row = task * rows_a_task; row < end; ++row) body(bench, row);
    });
  });
}

}  // namespace

void check_shape(const Shape& shape, std::int64_t count, std::string_view where) {
  for (const int side : {shape.width, shape.height, shape.depth}) {
    if (side < 1 || side > kMaxSpectrumSide) {
      throw Error({.code = ErrorCode::invalid_input,
                   .what = fmt::format("{} x {} x {}", shape.width, shape.height, shape.depth),
                   .where = std::string(where),
                   .limit = fmt::format("sides of 1..{}", kMaxSpectrumSide),
                   .remedy = ""});
    }
  }
  if (count != shape.count()) {
    throw Error(
        {.code = ErrorCode::invalid_input,
         .what = fmt::format("{} values for {} x {} x {}", count, shape.width, shape.height, shape.depth),
         .where = std::string(where),
         .limit = fmt::format("{} values", shape.count()),
         .remedy = ""});
  }
}

template <class T>
void check_finite(std::span<const T> values, const Shape& shape, std::string_view where,
                  const Execution& execution) {
  const auto total = static_cast<std::int64_t>(values.size());
  const std::int64_t chunk = std::int64_t{1} << 16;
  std::vector<std::int64_t> bad(static_cast<std::size_t>((total + chunk - 1) / chunk));
  parallel_for(execution, std::ssize(bad), [&](std::int64_t c) {
    std::int64_t count = 0;
    for (std::int64_t i = c * chunk; i < std::min(total, (c + 1) * chunk); ++i)
      count += !std::isfinite(values[i]);
    bad[c] = count;
  });
  const std::int64_t count = std::accumulate(bad.begin(), bad.end(), std::int64_t{0});
  if (count == 0) return;
  const std::int64_t first =
      std::find_if(values.begin(), values.end(), [](T v) { return !std::isfinite(v); }) - values.begin();
  const std::int64_t row = first / shape.width;
  throw Error({.code = ErrorCode::invalid_input,
               .what = fmt::format("{} of {} values are NaN or infinite, the first ({}) at x {}, y {}, z {}",
                                   count, total, static_cast<double>(values[first]), first % shape.width,
                                   row % shape.height, row / shape.height),
               .where = std::string(where),
               .limit = "finite values",
               .remedy = ""});
}

template <class T>
HalfSpectrum<T> transform_rows(Shape shape, const std::function<void(std::int64_t, T*)>& load_row,
                               const Execution& execution) {
  HalfSpectrum<T> spectrum{shape, {}};
  spectrum.values.resize(static_cast<std::size_t>(half_count(shape)));
  const std::int64_t pitch = half_width(shape);
  for_each_row<T>(shape, execution, [&](auto& bench, std::int64_t row) {
    load_row(row, bench.row.data());
    bench.fft.forward_real(spectrum.values.data() + row * pitch, bench.row.data());
  });
  transform_lines(spectrum.values.data(), shape.height, pitch, pitch, shape.depth, Direction::forward,
                  execution);
  transform_lines(spectrum.values.data(), shape.depth, pitch * shape.height, pitch * shape.height, 1,
                  Direction::forward, execution);
  return spectrum;
}

template void check_finite(std::span<const float>, const Shape&, std::string_view, const Execution&);
template void check_finite(std::span<const double>, const Shape&, std::string_view, const Execution&);
template HalfSpectrum<double> transform_rows(Shape, const std::function<void(std::int64_t, double*)>&,
                                             const Execution&);

}  // namespace spectrum

using namespace spectrum;

template <class T>
HalfSpectrum<T> transform(std::span<const T> values, Shape shape, const Execution& execution) {
  check_shape(shape, static_cast<std::int64_t>(values.size()), "transform");
  check_finite(values, shape, "transform", execution);
  check_memory(execution, static_cast<std::uint64_t>(half_count(shape)) * sizeof(std::complex<T>),
               "transform");
  const std::function<void(std::int64_t, T*)> load_row = [&](std::int64_t row, T* line) {
    std::copy_n(values.data() + row * shape.width, shape.width, line);
  };
  return transform_rows(shape, load_row, execution);
}

template <class T>
std::vector<T> inverse_transform(HalfSpectrum<T> spectrum, const Execution& execution) {
  const Shape shape = spectrum.shape;
  check_shape(shape, shape.count(), "inverse transform");
  if (static_cast<std::int64_t>(spectrum.values.size()) != half_count(shape)) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = fmt::format("{} frequencies", spectrum.values.size()),
                 .where = "inverse transform",
                 .limit = fmt::format("{} for this shape", half_count(shape)),
                 .remedy = ""});
  }
  check_memory(execution, static_cast<std::uint64_t>(shape.count()) * sizeof(T), "inverse transform");
  const std::int64_t pitch = half_width(shape);
  transform_lines(spectrum.values.data(), shape.depth, pitch * shape.height, pitch * shape.height, 1,
                  Direction::inverse, execution);
  transform_lines(spectrum.values.data(), shape.height, pitch, pitch, shape.depth, Direction::inverse,
                  execution);
  std::vector<T> values(static_cast<std::size_t>(shape.count()));
  const T scale = static_cast<T>(1.0 / static_cast<double>(shape.count()));
  for_each_row<T>(shape, execution, [&](auto& bench, std::int64_t row) {
    T* line = values.data() + row * shape.width;
    bench.fft.inverse_real(line, spectrum.values.data() + row * pitch);
    for (int x = 0; x < shape.width; ++x) line[x] *= scale;
  });
  return values;
}

template HalfSpectrum<float> transform(std::span<const float>, Shape, const Execution&);
template HalfSpectrum<double> transform(std::span<const double>, Shape, const Execution&);
template std::vector<float> inverse_transform(HalfSpectrum<float>, const Execution&);
template std::vector<double> inverse_transform(HalfSpectrum<double>, const Execution&);

}  // namespace bn
