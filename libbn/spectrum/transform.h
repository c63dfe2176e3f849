// Behind transform(): the rows come from a callback, so that a caller can convert them on the way.

#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "bn/spectrum.h"

namespace bn::spectrum {

/// Throws invalid_input, naming `where`, unless every side is 1..kMaxSpectrumSide and `count` values
/// fill the shape.
void check_shape(const Shape& shape, std::int64_t count, std::string_view where);

/// Throws invalid_input unless `power` fills its shape.
void check_power(const PowerSpectrum& power, std::string_view where);

/// The same, and it is of a line or picture.
void check_flat(const PowerSpectrum& power, std::string_view where);

/// Throws invalid_input with the number of values that are not finite and the first one's position.
template <class T>
void check_finite(std::span<const T> values, const Shape& shape, std::string_view where,
                  const Execution& execution);

/// Frequencies that a HalfSpectrum of `shape` holds.
inline std::int64_t half_count(const Shape& shape) {
  return std::int64_t{half_width(shape)} * shape.height * shape.depth;
}

/// transform() of rows that `load_row` writes; row z * H + y, from any thread.
template <class T>
HalfSpectrum<T> transform_rows(Shape shape, const std::function<void(std::int64_t row, T* line)>& load_row,
                               const Execution& execution);

}  // namespace bn::spectrum
