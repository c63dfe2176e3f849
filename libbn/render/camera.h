// The camera's path, and the view that it gives at a frame.
#pragma once

#include "bn/render.h"

namespace bn::render {

struct Camera {
  Vector eye, forward, right, down;  ///< right and down as long as a pixel at distance 1
};

Camera camera_at(const Scene& scene, Extent screen, int frame);

/// Is the camera at the same place, looking the same way, at both frames?
bool same_view(const Scene& scene, int frame, int other);

}  // namespace bn::render
