// The options that masks made for filters have alike, still or in volumes.

#include "bake/kinds/alike.h"

namespace bn {

void baking::add_filter_options(Options& options, SpatiotemporalOptions& mask, std::string_view ranks_help) {
  using Preset = SpatiotemporalPreset;
  constexpr const char* kMeasured = "the best that was measured";
  options.shape("size", mask.size, 1, 16384, "Width and height of a slice, and how many slices.")
      .in("pixels")
      .must_be_given();
  options.choice<Preset>("preset", mask.preset,
                         {{"both", Preset::both}, {"filtered", Preset::filtered}, {"stbn", Preset::stbn}},
                         "What the mask is best at.");
  options.measured<SpatialFilter>(
      "spatial", mask.spatial, mask.spatial_width,
      {{{"gauss", 0.3, 11.0, 1.3435}, SpatialFilter::gauss},
       {{"box", 1, 64, 3, true}, SpatialFilter::box},
       {{"binomial", 1, 64, 3, true}, SpatialFilter::binomial},
       {{"none"}, SpatialFilter::none}},
      "What blurs a frame: a Gaussian of that standard deviation in pixels, a box of that "
      "side, a binomial filter of that order.");
  options.measured<TemporalFilter>(
      "temporal", mask.temporal, mask.temporal_width,
      {{{"ema", 0.0001, 1.0, 0.1}, TemporalFilter::ema},
       {{"box", 1, 64, 8, true}, TemporalFilter::box},
       {{"gauss", 0.3, 45.0, 1.0}, TemporalFilter::gauss},
       {{"none"}, TemporalFilter::none}},
      "What averages frames: an exponential average with that share of the new frame, so "
      "many frames, a Gaussian of that standard deviation in frames.");
  options.choice<RankScope>("ranks", mask.ranks, {{"slice", RankScope::slice}, {"volume", RankScope::volume}},
                            std::string(ranks_help));
  options.seed("seed", mask.seed, "Another seed gives another mask.");
  options.real("sigma", mask.sigma_px, 0.3, 16.0, "Standard deviation of the kernel's Gaussian in a slice.")
      .in("pixels")
      .if_unset(kMeasured);
  options
      .real("gauss_share", mask.gauss_share, 0.0, 16.0, "Weight of that Gaussian beside a box filter's tent.")
      .if_unset(kMeasured);
  options.real("slice_share", mask.slice_share, 0.0, 1.0, "Share of what voxels see of their own slice only.")
      .if_unset(kMeasured);
  options
      .real("pixel_share", mask.pixel_share, 0.0, 16.0, "Weight of what voxels see of their own pixel only.")
      .if_unset(kMeasured);
  options
      .real("pixel_sigma", mask.pixel_sigma, 0.3, 64.0, "Standard deviation of the latter, along the frames.")
      .in("frames")
      .if_unset(kMeasured);
}

void baking::check_filter_options(const SpatiotemporalOptions& mask, const Complain& complain) {
  constexpr std::int64_t kMostVoxels = std::int64_t{1} << 31;
  if (mask.size.count() > kMostVoxels) {
    complain("size", "has too many voxels", "at most 2^31", "");
    return;
  }
  // The library says what else is wrong.
  try {
    spatiotemporal_kernel(mask);
  } catch (const Error& error) {
    complain_of(error.info(), complain);
  }
}

void baking::add_constants(Facts& facts, const SpatiotemporalOptions& mask) {
  const SpatiotemporalOptions used = spatiotemporal_constants(mask);
  const auto add = [&](const char* constant, const std::optional<double>& value) {
    if (value) facts.add(constant, *value);
  };
  add("sigma", used.sigma_px);
  add("gauss_share", used.gauss_share);
  add("slice_share", used.slice_share);
  add("pixel_share", used.pixel_share);
  add("pixel_sigma", used.pixel_sigma);
}

}  // namespace bn
