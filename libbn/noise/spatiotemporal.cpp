// The presets of bn/spatiotemporal.h as kernels.
//
// Why these kernels. Blur a thresholded picture b and average it over frames: the error left is a quadratic
// form b^T A b, A the autocorrelation of blur and average. Void-and-cluster with the kernel A makes each of
// these forms small greedily, for all thresholds at once. Sharing a part between the voxels of one slice
// only, and one between those of one pixel only, and a slightly narrower Gaussian, are what measurements
// added to that (docs/spatiotemporal.md).

#include <fmt/format.h>

#include <cmath>

#include "bn/spatiotemporal.h"
#include "core/refuse.h"

namespace bn {
namespace {

constexpr AxisFunction kDelta = {AxisForm::delta};

void check_range(const char* where, const char* what, double value, double least, double most) {
  // Written so that NaN fails.
  if (!(value >= least && value <= most)) {
    refuse(where, fmt::format("{} of {}", what, value), fmt::format("{}..{}", least, most));
  }
}

void check_range(const char* where, const char* what, const std::optional<double>& value, double least,
                 double most) {
  if (value) check_range(where, what, *value, least, most);
}

void check(const SpatiotemporalOptions& o) {
  const double width = o.spatial_width;
  if (o.spatial == SpatialFilter::gauss) {
    check_range("spatial", "a Gaussian blur", width, 0.3, 11.0);
  } else if (o.spatial != SpatialFilter::none) {
    check_range("spatial", o.spatial == SpatialFilter::box ? "a box" : "a binomial filter", width, 1.0, 64.0);
    if (width != std::floor(width))
      refuse("spatial", fmt::format("a filter of width {}", width), "whole numbers");
  }
  if (o.temporal == TemporalFilter::ema) {
    check_range("temporal", "an exponential average with an alpha", o.temporal_width, 0.0001, 1.0);
  } else if (o.temporal == TemporalFilter::box) {
    check_range("temporal", "an average over frames", o.temporal_width, 1.0, 64.0);
  } else if (o.temporal == TemporalFilter::gauss) {
    check_range("temporal", "a Gaussian average", o.temporal_width, 0.3, 45.0);
  }
  check_range("sigma_px", "a standard deviation", o.sigma_px, 0.3, 16.0);
  check_range("gauss_share", "a Gaussian's weight", o.gauss_share, 0.0, 16.0);
  check_range("slice_share", "a share", o.slice_share, 0.0, 1.0);
  check_range("pixel_share", "a weight", o.pixel_share, 0.0, 16.0);
  check_range("pixel_sigma", "a standard deviation", o.pixel_sigma, 0.3, 64.0);
}

/// The standard deviation of a filter that is, or resembles, a Gaussian.
double filter_sigma(const SpatiotemporalOptions& o) {
  switch (o.spatial) {
    case SpatialFilter::gauss:
      return o.spatial_width;
    case SpatialFilter::binomial:
      return std::sqrt(o.spatial_width) / 2.0;
    default:
      return 0.0;
  }
}

double default_sigma(const SpatiotemporalOptions& o) {
  if (o.spatial == SpatialFilter::none) return 0.3;
  if (o.spatial == SpatialFilter::box) return 0.2 + 0.2 * o.spatial_width;
  if (o.spatial == SpatialFilter::binomial) return std::max(0.3, filter_sigma(o) * std::sqrt(2.0));
  const double ratio = o.preset == SpatiotemporalPreset::stbn                       ? std::sqrt(2.0)
                       : o.preset == SpatiotemporalPreset::both && o.size.depth > 1 ? 1.1165
                                                                                    : 1.191;
  return std::max(0.3, ratio * filter_sigma(o));
}

/// The spatial part of the kernel.
VolumeKernel spatial_terms(const SpatiotemporalOptions& o) {
  const AxisFunction gauss{AxisForm::gauss, *o.sigma_px};
  switch (o.spatial) {
    case SpatialFilter::none:
      return {{.x = kDelta, .y = kDelta}};
    case SpatialFilter::box: {
      const AxisFunction tent{AxisForm::tent, o.spatial_width};
      VolumeKernel terms{{.x = tent, .y = tent}};
      if (*o.gauss_share > 0.0) terms.push_back({.weight = *o.gauss_share, .x = gauss, .y = gauss});
      return terms;
    }
    default:
      return {{.x = gauss, .y = gauss}};
  }
}

AxisFunction temporal_function(const SpatiotemporalOptions& o) {
  switch (o.temporal) {
    case TemporalFilter::ema:
      return {AxisForm::exponential, o.temporal_width};
    case TemporalFilter::box:
      return {AxisForm::tent, o.temporal_width};
    case TemporalFilter::gauss:
      return {AxisForm::gauss, o.temporal_width * std::sqrt(2.0)};
    default:
      return kDelta;
  }
}

}  // namespace

SpatiotemporalOptions spatiotemporal_constants(const SpatiotemporalOptions& options) {
  check(options);
  SpatiotemporalOptions o = options;
  const auto by_preset = [&](double stbn, double filtered, double both) {
    return o.preset == SpatiotemporalPreset::stbn       ? stbn
           : o.preset == SpatiotemporalPreset::filtered ? filtered
                                                        : both;
  };
  if (!o.sigma_px) o.sigma_px = std::min(default_sigma(o), 16.0);
  if (!o.gauss_share)
    o.gauss_share = o.spatial != SpatialFilter::box ? 0.0 : o.spatial_width < 4.0 ? 0.3 : 0.02;
  if (!o.slice_share) o.slice_share = by_preset(1.0, 0.5, 0.6);
  if (!o.pixel_share) o.pixel_share = by_preset(1.0, 0.0, 0.52);
  if (!o.pixel_sigma) o.pixel_sigma = 1.9;
  return o;
}

VolumeKernel spatiotemporal_kernel(const SpatiotemporalOptions& options) {
  const SpatiotemporalOptions o = spatiotemporal_constants(options);
  const VolumeKernel spatial = spatial_terms(o);
  if (o.size.depth == 1) return spatial;
  VolumeKernel kernel;
  const auto add = [&](double share, AxisFunction in_time) {
    if (share <= 0.0) return;
    for (KernelTerm term : spatial) {
      term.weight *= share;
      term.z = in_time;
      kernel.push_back(term);
    }
  };
  add(*o.slice_share, kDelta);
  add(1.0 - *o.slice_share, temporal_function(o));
  if (*o.pixel_share > 0.0) {
    kernel.push_back(
        {.weight = *o.pixel_share, .x = kDelta, .y = kDelta, .z = {AxisForm::gauss, *o.pixel_sigma}});
  }
  return kernel;
}

Grid<std::uint32_t> spatiotemporal_mask(const SpatiotemporalOptions& options, const Execution& execution) {
  return volume_mask({.size = {options.size.width, options.size.height, options.size.depth, 1},
                      .kernel = spatiotemporal_kernel(options),
                      .ranks = options.ranks,
                      .seed = options.seed},
                     execution);
}

std::string_view name_of(SpatiotemporalPreset preset) {
  switch (preset) {
    case SpatiotemporalPreset::stbn:
      return "stbn";
    case SpatiotemporalPreset::filtered:
      return "filtered";
    case SpatiotemporalPreset::both:
      break;
  }
  return "both";
}

}  // namespace bn
