// What a scene must be before anything is rendered: names that can become files, a camera that looks
// somewhere, colours and materials in range, primitives with an extent, regions inside the picture.

#include <fmt/format.h>

#include <algorithm>

#include "bn/error.h"
#include "render/scene.h"
#include "render/vector_math.h"

namespace bn::render {
namespace {

[[noreturn]] void refuse(const Scene& scene, std::string what, std::string limit = "") {
  throw Error({.code = ErrorCode::invalid_input,
               .what = std::move(what),
               .where = "scene " + scene.name,
               .limit = std::move(limit),
               .remedy = ""});
}

/// Names become names of files and cells of CSV.
void check_name(const Scene& scene, const std::string& name) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_' || c == ' ';
  };
  if (name.empty() || name.size() > 64 || name.front() == ' ' ||
      !std::all_of(name.begin(), name.end(), plain)) {
    refuse(scene, fmt::format("the name '{}'", name), "1..64 letters, digits, spaces, - and _");
  }
}

bool finite(Vector v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void check_names(const Scene& scene) {
  check_name(scene, scene.name);
  if (scene.about.size() > 500)
    refuse(scene, fmt::format("'about' of {} bytes", scene.about.size()), "0..500 bytes");
  for (const Region& region : scene.regions) {
    check_name(scene, region.name);
    if (region.name == "picture") refuse(scene, "a region 'picture': that is the whole picture's name");
  }
}

void check_camera(const Scene& scene) {
  if (scene.camera.empty()) refuse(scene, "no camera");
  for (std::size_t i = 0; i < scene.camera.size(); ++i) {
    const CameraKey& key = scene.camera[i];
    if (!finite(key.eye) || !finite(key.at)) refuse(scene, "a camera position is not finite");
    if (i > 0 && key.frame <= scene.camera[i - 1].frame) refuse(scene, "camera frames do not rise");
    const Vector view = key.at - key.eye;
    if (length(cross(view, {0.0, 1.0, 0.0})) < 1e-6 * (1.0 + length(view))) {
      refuse(scene, "the camera looks straight up or down, or nowhere");
    }
  }
  if (!(scene.fov_degrees >= 1.0 && scene.fov_degrees <= 150.0)) {
    refuse(scene, fmt::format("field of view {}", scene.fov_degrees), "1..150 degrees");
  }
  if (!std::isfinite(scene.pan_x_px) || !std::isfinite(scene.pan_y_px))
    refuse(scene, "the pan is not finite");
}

void check_colour(const Scene& scene, Rgb c, float high, std::string_view what) {
  for (const float v : {c.r, c.g, c.b}) {
    if (!(v >= 0.0f && v <= high)) refuse(scene, fmt::format("{} {}", what, v), fmt::format("0..{}", high));
  }
}

void check_materials(const Scene& scene) {
  for (const Material& material : scene.materials) {
    check_colour(scene, material.albedo, 1.0f, "albedo");
    check_colour(scene, material.checker_albedo, 1.0f, "albedo");
    check_colour(scene, material.emission, 1e6f, "emission");
    if (!(material.roughness < 0.0f || (material.roughness >= 0.05f && material.roughness <= 1.0f))) {
      refuse(scene, fmt::format("roughness {}", material.roughness), "0.05..1");
    }
    if (std::min(material.checker_u, material.checker_v) < 0 ||
        std::max(material.checker_u, material.checker_v) > 1023) {
      refuse(scene, "checker cells", "0..1023");
    }
  }
}

void check_images(const Scene& scene) {
  std::int64_t texels = 0;
  for (const Grid<Rgb>& image : scene.images) {
    texels += image.size().area();
    if (image.count() == 0) refuse(scene, "an empty image");
    for (const Rgb& texel : image) check_colour(scene, texel, 1.0f, "texel");
  }
  if (texels > kMaxTexels) refuse(scene, fmt::format("{} texels", texels), fmt::format("0..{}", kMaxTexels));
  for (const Material& material : scene.materials) {
    if (material.image >= static_cast<int>(scene.images.size())) refuse(scene, "no such image");
    if (material.image >= 0 && material.checker_u > 0) refuse(scene, "a checker pattern on an image");
  }
}

void check_material(const Scene& scene, int material) {
  if (material < 0 || static_cast<std::size_t>(material) >= scene.materials.size())
    refuse(scene, "no such material");
}

void check_rectangles(const Scene& scene) {
  for (const Rectangle& rectangle : scene.rectangles) {
    check_material(scene, rectangle.material);
    if (!finite(rectangle.corner) || !finite(rectangle.edge_u) || !finite(rectangle.edge_v)) {
      refuse(scene, "a rectangle is not finite");
    }
    const double u = length(rectangle.edge_u), v = length(rectangle.edge_v);
    if (!(u > 0.0 && v > 0.0) || std::abs(dot(rectangle.edge_u, rectangle.edge_v)) > 1e-6 * u * v) {
      refuse(scene, "a rectangle's edges are not at right angles");
    }
  }
}

void check_spheres(const Scene& scene) {
  for (const Sphere& sphere : scene.spheres) {
    check_material(scene, sphere.material);
    if (!finite(sphere.centre) || !(sphere.radius > 0.0) || !std::isfinite(sphere.radius)) {
      refuse(scene, "a sphere without centre or radius");
    }
    const Rgb e = scene.materials[static_cast<std::size_t>(sphere.material)].emission;
    if (e.r + e.g + e.b > 0.0f) refuse(scene, "a sphere emits light", "rectangles only");
    if (scene.materials[static_cast<std::size_t>(sphere.material)].image >= 0)
      refuse(scene, "an image on a sphere", "rectangles only");
  }
}

void check_regions(const Scene& scene) {
  for (const Region& region : scene.regions) {
    if (!(region.x >= 0.0 && region.y >= 0.0 && region.width > 0.0 && region.height > 0.0 &&
          region.x + region.width <= 1.0 && region.y + region.height <= 1.0)) {
      refuse(scene, "region " + region.name + " leaves the picture", "0..1");
    }
  }
}

}  // namespace

void check_scene(const Scene& scene) {
  check_names(scene);
  check_camera(scene);
  const auto count = scene.rectangles.size() + scene.spheres.size();
  if (count == 0 || count > kMaxPrimitives) {
    refuse(scene, fmt::format("{} primitives", count), fmt::format("1..{}", kMaxPrimitives));
  }
  check_colour(scene, scene.sky, 1e6f, "sky");
  check_materials(scene);
  check_images(scene);
  check_rectangles(scene);
  check_spheres(scene);
  check_regions(scene);
}

}  // namespace bn::render
