// The pictures of one texture, as parts of its section.

#pragma once

#include <string>
#include <vector>

#include "bn/spectrum.h"
#include "report/sources.h"

namespace bn::report {

/// What the pictures are made from; figures and curves are read off the same.
struct TextureView {
  const Texture& texture;
  const PowerSpectrum& power;              ///< of the whole
  const PowerSpectrum& plane;              ///< of a picture, or the mean of a volume's slices
  const std::vector<double>& correlation;  ///< autocorrelation of `plane`
  const std::vector<double>& slice;        ///< the first slice
};

/// Texture, spectrum, autocorrelation, a picture dithered with it; for a volume the spectrum in x and time.
std::string gallery(const TextureView& view, const Execution& execution);

/// Three by three copies.
std::string tiling(const TextureView& view);

/// The texture thresholded at n/16, with spectra.
std::string levels(const TextureView& view, const Execution& execution);

/// A volume's slices, and what its frames look like in the mean.
std::string volume_strips(const TextureView& view, const Execution& execution);

/// Texture and spectrum, for --compare.
std::string card_pictures(const TextureView& view);

/// "64 × 64".
std::string size_of(Shape shape);

}  // namespace bn::report
