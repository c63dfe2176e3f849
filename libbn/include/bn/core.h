// bn/core.h - floor 0: what every room builds on.
//
// Errors, grids on a torus, counter-based random numbers, execution control and parallel loops.
// Everything here is deterministic; nothing here computes noise.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#ifdef __FAST_MATH__
#error "libbn promises the same bytes everywhere; build it without -ffast-math"
#endif

namespace bn {

/// Semantic version of the toolkit; CMake reads it from this line.
inline constexpr std::string_view kVersion = "0.1.0";

// --- errors ------------------------------------------------------------------------------------

/// Why something failed. Numbers are permanent and never reused.
enum class ErrorCode : int {
  usage = 1,                ///< a command line that cannot be parsed (tools only)
  io = 2,                   ///< a file or folder could not be read, written, flushed or renamed
  invalid_input = 3,        ///< a value outside its range, or a file whose content is not acceptable
  over_limit = 4,           ///< out of memory, or a request above a stated limit
  verification_failed = 5,  ///< a recomputed figure differs from the recorded one
  cancelled = 6,            ///< stopped through Execution::stop
};

/// The parts of a message. `what` is required; a reader must be able to act on the rest.
struct ErrorInfo {
  ErrorCode code;
  std::string what;    ///< what is wrong, with the offending value
  std::string where;   ///< file:line, path, recipe key or parameter
  std::string limit;   ///< the allowed range or the limit that was met
  std::string remedy;  ///< what to do about it
};

/// The one exception type that libbn throws on purpose.
/// what() reads "where: what (allowed: limit); remedy", leaving out the parts that are empty.
class Error : public std::runtime_error {
 public:
  explicit Error(ErrorInfo info);
  ErrorCode code() const { return info_.code; }
  const ErrorInfo& info() const { return info_; }

 private:
  ErrorInfo info_;
};

// --- grids -------------------------------------------------------------------------------------

/// A position difference in pixels: x to the right, y down.
struct Offset {
  int x = 0;
  int y = 0;
  friend bool operator==(const Offset&, const Offset&) = default;
};

/// Width and height in pixels.
struct Extent {
  int width = 0;
  int height = 0;
  std::int64_t area() const { return std::int64_t{width} * height; }
  friend bool operator==(const Extent&, const Extent&) = default;
};

/// The representative of `value` in 0..period-1. `period` > 0.
constexpr int wrap(std::int64_t value, int period) {
  const std::int64_t rest = value % period;
  return static_cast<int>(rest < 0 ? rest + period : rest);
}

/// The representative of `value` nearest to zero; of two equally near, the negative one.
/// Result in -floor(period/2) .. ceil(period/2)-1.
constexpr int wrap_centred(std::int64_t value, int period) {
  return wrap(value + period / 2, period) - period / 2;
}

/// A dense array of width x height values, origin top-left, index y * width + x.
template <class T>
class Grid {
 public:
  Grid() = default;
  explicit Grid(Extent size, T fill = T{})
      : size_(size), values_(static_cast<std::size_t>(size.area()), fill) {}

  Extent size() const { return size_; }
  int width() const { return size_.width; }
  int height() const { return size_.height; }
  std::size_t count() const { return values_.size(); }

  T& operator[](std::size_t index) { return values_[index]; }
  const T& operator[](std::size_t index) const { return values_[index]; }
  T& operator()(int x, int y) { return values_[index(x, y)]; }
  const T& operator()(int x, int y) const { return values_[index(x, y)]; }
  /// The value at a position taken modulo the size.
  const T& torus(std::int64_t x, std::int64_t y) const {
    return values_[index(wrap(x, size_.width), wrap(y, size_.height))];
  }

  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }
  auto begin() { return values_.begin(); }
  auto end() { return values_.end(); }
  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }

  friend bool operator==(const Grid&, const Grid&) = default;

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) + static_cast<std::size_t>(x);
  }
  Extent size_;
  std::vector<T> values_;
};

// --- random numbers ----------------------------------------------------------------------------

/// Philox4x32-10, a counter-based generator: the output depends on (counter, key) and nothing else,
/// so any thread may draw any number in any order.
/// Source: Salmon, Moraes, Dror, Shaw, "Parallel Random Numbers: As Easy as 1, 2, 3", SC 2011.
constexpr std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                              std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t product0 = std::uint64_t{0xD2511F53u} * counter[0];
    const std::uint64_t product1 = std::uint64_t{0xCD9E8D57u} * counter[2];
    counter = {static_cast<std::uint32_t>(product1 >> 32) ^ counter[1] ^ key[0],
               static_cast<std::uint32_t>(product1),
               static_cast<std::uint32_t>(product0 >> 32) ^ counter[3] ^ key[1],
               static_cast<std::uint32_t>(product0)};
    key[0] += 0x9E3779B9u;
    key[1] += 0xBB67AE85u;
  }
  return counter;
}

/// 64 random bits for draw number `index` of stream `stream` under `seed`. Streams keep the uses of
/// one seed apart; each algorithm states the numbers it takes.
constexpr std::uint64_t random_bits(std::uint64_t seed, std::uint32_t stream, std::uint64_t index) {
  const auto words =
      philox({static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32), stream, 0u},
             {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
  return (std::uint64_t{words[1]} << 32) | words[0];
}

/// An integer in 0..bound-1 from 32 random bits; each value's probability is within 2^-32 of
/// 1/bound. `bound` > 0.
constexpr std::uint32_t random_below(std::uint32_t bits, std::uint32_t bound) {
  return static_cast<std::uint32_t>((std::uint64_t{bits} * bound) >> 32);
}

// --- execution ---------------------------------------------------------------------------------

/// How a long computation runs. None of this can change a result, only whether and when it comes.
struct Execution {
  /// Threads to use at most, 1..1024; 0 takes every core this process may run on.
  int threads = 0;
  /// Request a stop and the computation ends soon with ErrorCode::cancelled.
  std::stop_token stop = {};
  /// Called with the share done, 0..1: never backwards, never from two threads at once, from any
  /// thread of the computation. It must not throw and must not call back into the computation.
  std::function<void(double done)> progress = {};
  /// A computation that would need more fails with ErrorCode::over_limit before it starts.
  std::uint64_t memory_limit_bytes = std::uint64_t{8} << 30;
};

/// The number of threads `execution` means. Throws invalid_input outside 0..1024.
int thread_count(const Execution& execution);

/// Throws over_limit, naming `where`, if `bytes` is above the memory limit.
void check_memory(const Execution& execution, std::uint64_t bytes, std::string_view where);

/// Throws cancelled if a stop was requested. Cheap; call it every few milliseconds of work.
void throw_if_stopped(const Execution& execution);

/// Calls body(i) for every i in 0..count-1, on thread_count(execution) threads, in no particular
/// order; returns when all are done. For reproducible results each i writes a range of its own.
/// The first exception thrown by a body ends the loop and is rethrown.
void parallel_for(const Execution& execution, std::int64_t count,
                  const std::function<void(std::int64_t)>& body);

// --- instruction sets --------------------------------------------------------------------------

/// Names of the instruction sets that this machine can run, best first; for example
/// {"AVX3", "AVX2", "SSE4", "SCALAR"}, the last being plain scalar code. Any of them gives the same bytes.
std::vector<std::string> instruction_sets();

/// Makes the kernels use `name` (from instruction_sets()) from now on in the whole process; an
/// empty name returns to the best. For tests and benchmarks. Not thread safe. Throws invalid_input.
void use_instruction_set(std::string_view name);

}  // namespace bn
