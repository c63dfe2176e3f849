#include "render/camera.h"

#include <algorithm>
#include <numbers>

#include "render/vector_math.h"

namespace bn::render {
namespace {

/// Between the keys, before the pan.
CameraKey pose_at(const Scene& scene, int frame) {
  const auto after = std::find_if(scene.camera.begin(), scene.camera.end(),
                                  [&](const CameraKey& key) { return key.frame > frame; });
  const CameraKey& first = after == scene.camera.begin() ? *after : *(after - 1);
  const CameraKey& second = after == scene.camera.end() ? first : *after;
  const double span = second.frame - first.frame;
  const double share = span > 0 ? std::clamp((frame - first.frame) / span, 0.0, 1.0) : 0.0;
  return {.frame = 0,
          .eye = first.eye + (second.eye - first.eye) * share,
          .at = first.at + (second.at - first.at) * share};
}

}  // namespace

Camera camera_at(const Scene& scene, Extent screen, int frame) {
  const CameraKey pose = pose_at(scene, frame);
  const double distance = length(pose.at - pose.eye);
  const double pixel = 2.0 * std::tan(scene.fov_degrees * std::numbers::pi / 360.0) / screen.height;
  Camera camera;
  camera.forward = (pose.at - pose.eye) * (1.0 / distance);
  const Vector right = cross(camera.forward, {0.0, 1.0, 0.0});
  camera.right = right * (pixel / length(right));
  camera.down = cross(camera.forward, camera.right);
  camera.eye = pose.eye + (camera.right * scene.pan_x_px + camera.down * scene.pan_y_px) * (frame * distance);
  return camera;
}

bool same_view(const Scene& scene, int frame, int other) {
  const Extent any{100, 100};
  const Camera a = camera_at(scene, any, frame);
  const Camera b = camera_at(scene, any, other);
  return length(a.eye - b.eye) == 0.0 && length(a.forward - b.forward) == 0.0;
}

}  // namespace bn::render
