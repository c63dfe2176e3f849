// What several kinds declare alike.

#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bn/error.h"
#include "bn/kinds.h"

namespace bn::baking {

/// The types of samples by the names that options have for them.
const std::vector<std::pair<std::string, SampleType>>& sample_types();

/// The options of a file that holds a mask.
Options mask_output_options(SampleType& type);

/// Size, preset, filters, ranks, seed and the kernel's constants, in filter_options.cpp.
void add_filter_options(Options& options, SpatiotemporalOptions& mask, std::string_view ranks_help);
void check_filter_options(const SpatiotemporalOptions& mask, const Complain& complain);
/// The constants that are used, as facts of the manifest.
void add_constants(Facts& facts, const SpatiotemporalOptions& mask);

/// Complains of what the library refuses.
void complain_of(const ErrorInfo& refused, const Complain& complain);

}  // namespace bn::baking
