// bn_study/fft.h - floor 4 (study): our transforms beside OpenImageIO's. Not installed.

#pragma once

#include <string>
#include <vector>

#include "bn/execution.h"

namespace bn {

/// One way to transform a side x side picture of white noise, on one thread.
struct FftStudyRow {
  std::string method;  ///< "bn" or "OpenImageIO"
  std::string type;    ///< "float" or "double"
  int side;
  double seconds;         ///< processor time, the median of repeated runs
  double relative_error;  ///< root mean square against a long-double sum over four columns of the spectrum
};

/// Speed against error of our transforms and of OpenImageIO's (ImageBufAlgo::fft) for each side, 2..8192.
std::vector<FftStudyRow> study_fft(const std::vector<int>& sides, const Execution& execution = {});

}  // namespace bn
