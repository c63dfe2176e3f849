// The transform of OpenImageIO, which a study compares ours with; in the module bn_oiio.

#pragma once

#include <complex>
#include <functional>
#include <string>
#include <vector>

namespace bn::oiio {

/// Transforms side x side values; `measure` is called once with the call to be timed. Returns the spectrum,
/// unitary, row by row. `error` is what went wrong; empty if nothing did.
using Fft = void(const float* values, int side,
                 const std::function<void(const std::function<void()>&)>& measure,
                 std::vector<std::complex<float>>& spectrum, std::string& error);

/// The name of an Fft in the module.
inline constexpr const char* kFftSymbol = "bn_oiio_fft";

}  // namespace bn::oiio
