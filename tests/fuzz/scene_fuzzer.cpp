// Any bytes: the reader of scenes answers with a scene or a bn::Error that says where; and a scene that came
// out can be rendered: every number is finite and in its range, every reference leads somewhere, and it fits
// the device's buffers.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "bn/error.h"
#include "bn/render.h"
#include "promise.h"
#include "render/scene.h"

namespace {

using namespace bn;
using namespace bn::render;

bool finite(Vector v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void check_promises(const Scene& scene) {
  require(!scene.camera.empty(), "there is a camera");
  for (const CameraKey& key : scene.camera) require(finite(key.eye) && finite(key.at), "cameras are finite");
  require(scene.fov_degrees >= 1.0 && scene.fov_degrees <= 150.0, "the field of view is in range");
  require(scene.rectangles.size() + scene.spheres.size() <= std::size_t{kMaxPrimitives},
          "primitives are few");
  const auto has = [&](int material) {
    return material >= 0 && static_cast<std::size_t>(material) < scene.materials.size();
  };
  for (const Rectangle& r : scene.rectangles) {
    require(has(r.material), "rectangles have a material");
    require(finite(r.corner) && finite(r.edge_u) && finite(r.edge_v), "rectangles are finite");
  }
  for (const Sphere& s : scene.spheres) {
    require(has(s.material), "spheres have a material");
    require(finite(s.centre) && s.radius > 0.0 && std::isfinite(s.radius), "spheres are finite");
  }
  for (const Material& m : scene.materials) {
    require(m.image < static_cast<int>(scene.images.size()), "a material's image is there");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Scene scene;
  try {
    scene = read_scene({reinterpret_cast<const char*>(data), size}, "input");
  } catch (const Error& error) {
    // A wrong number is named by its scene.
    const std::string_view what = error.what();
    require(what.starts_with("input") || what.starts_with("scene"), "an error says where");
    return 0;
  }
  check_promises(scene);
  check_scene(scene);
  require(!pack_scene(scene).words.empty(), "it packs");
  return 0;
}
