// What several kinds declare alike.

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bn/error.h"
#include "bn/kinds.h"

namespace bn::baking {

/// The types of samples by the names that options have for them.
const std::vector<std::pair<std::string, SampleType>>& sample_types();

/// The options of a file that holds a mask.
Options mask_output_options(SampleType& type);

/// Complains of what the library refuses.
void complain_of(const ErrorInfo& refused, const Complain& complain);

}  // namespace bn::baking
