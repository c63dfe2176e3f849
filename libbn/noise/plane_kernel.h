// Any kernel in two dimensions, as integers for the path of void_and_cluster().

#pragma once

#include "bn/spatiotemporal.h"
#include "noise/gaussian_kernel.h"

namespace bn::noise {

/// The weights of a kernel in a torus of one slice, not wrapped, scaled as a GaussianKernel's. Arguments are
/// checked by the caller.
class PlaneKernel : public PixelKernel {
 public:
  explicit PlaneKernel(const VolumeKernel& kernel);
};

}  // namespace bn::noise
