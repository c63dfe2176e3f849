#pragma once

namespace bn::noise {

/// A place in a volume; z is the slice.
struct Voxel {
  int x = 0;
  int y = 0;
  int z = 0;
};

}  // namespace bn::noise
