// Scenes: checks, the flat words the shaders read, and the camera's path.
//
// All of this runs once a scene or once a frame, in double precision, and is rounded to single at the
// end: both renderers get the same words, so nothing here can make them differ.

#include "render/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bn/error.h"
#include "bn/random.h"

namespace bn::render {
namespace {

constexpr std::uint32_t kGoldenRatio24 = 10368890;  // 0.618034 * 2^24
constexpr std::uint32_t kMethodStream = 0x52540003u;

Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vector operator*(Vector a, double s) { return {a.x * s, a.y * s, a.z * s}; }
double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double length(Vector a) { return std::sqrt(dot(a, a)); }
Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

vec3 rounded(Vector v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }
vec3 words(Rgb c) { return {c.r, c.g, c.b}; }

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

struct Camera {
  Vector eye, forward, right, down;  // right and down as long as a pixel at distance 1
};

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

}  // namespace

void check_scene(const Scene& scene) {
  check_name(scene, scene.name);
  for (const Region& region : scene.regions) {
    check_name(scene, region.name);
    if (region.name == "picture") refuse(scene, "a region 'picture': that is the whole picture's name");
  }
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
  const auto count = scene.rectangles.size() + scene.spheres.size();
  if (count == 0 || count > kMaxPrimitives) {
    refuse(scene, fmt::format("{} primitives", count), fmt::format("1..{}", kMaxPrimitives));
  }
  const auto check_colour = [&](Rgb c, float high, std::string_view what) {
    for (const float v : {c.r, c.g, c.b}) {
      if (!(v >= 0.0f && v <= high)) refuse(scene, fmt::format("{} {}", what, v), fmt::format("0..{}", high));
    }
  };
  check_colour(scene.sky, 1e6f, "sky");
  for (const Material& material : scene.materials) {
    check_colour(material.albedo, 1.0f, "albedo");
    check_colour(material.checker_albedo, 1.0f, "albedo");
    check_colour(material.emission, 1e6f, "emission");
    if (!(material.roughness < 0.0f || (material.roughness >= 0.05f && material.roughness <= 1.0f))) {
      refuse(scene, fmt::format("roughness {}", material.roughness), "0.05..1");
    }
    if (std::min(material.checker_u, material.checker_v) < 0 ||
        std::max(material.checker_u, material.checker_v) > 1023) {
      refuse(scene, "checker cells", "0..1023");
    }
  }
  std::int64_t texels = 0;
  for (const Grid<Rgb>& image : scene.images) {
    texels += image.size().area();
    if (image.count() == 0) refuse(scene, "an empty image");
    for (const Rgb& texel : image) check_colour(texel, 1.0f, "texel");
  }
  if (texels > kMaxTexels) refuse(scene, fmt::format("{} texels", texels), fmt::format("0..{}", kMaxTexels));
  for (const Material& material : scene.materials) {
    if (material.image >= static_cast<int>(scene.images.size())) refuse(scene, "no such image");
    if (material.image >= 0 && material.checker_u > 0) refuse(scene, "a checker pattern on an image");
  }
  const auto check_material = [&](int material) {
    if (material < 0 || static_cast<std::size_t>(material) >= scene.materials.size())
      refuse(scene, "no such material");
  };
  for (const Rectangle& rectangle : scene.rectangles) {
    check_material(rectangle.material);
    if (!finite(rectangle.corner) || !finite(rectangle.edge_u) || !finite(rectangle.edge_v)) {
      refuse(scene, "a rectangle is not finite");
    }
    const double u = length(rectangle.edge_u), v = length(rectangle.edge_v);
    if (!(u > 0.0 && v > 0.0) || std::abs(dot(rectangle.edge_u, rectangle.edge_v)) > 1e-6 * u * v) {
      refuse(scene, "a rectangle's edges are not at right angles");
    }
  }
  for (const Sphere& sphere : scene.spheres) {
    check_material(sphere.material);
    if (!finite(sphere.centre) || !(sphere.radius > 0.0) || !std::isfinite(sphere.radius)) {
      refuse(scene, "a sphere without centre or radius");
    }
    const Rgb e = scene.materials[static_cast<std::size_t>(sphere.material)].emission;
    if (e.r + e.g + e.b > 0.0f) refuse(scene, "a sphere emits light", "rectangles only");
    if (scene.materials[static_cast<std::size_t>(sphere.material)].image >= 0)
      refuse(scene, "an image on a sphere", "rectangles only");
  }
  for (const Region& region : scene.regions) {
    if (!(region.x >= 0.0 && region.y >= 0.0 && region.width > 0.0 && region.height > 0.0 &&
          region.x + region.width <= 1.0 && region.y + region.height <= 1.0)) {
      refuse(scene, "region " + region.name + " leaves the picture", "0..1");
    }
  }
}

bool same_view(const Scene& scene, int frame, int other) {
  const Extent any{100, 100};
  const Camera a = camera_at(scene, any, frame);
  const Camera b = camera_at(scene, any, other);
  return length(a.eye - b.eye) == 0.0 && length(a.forward - b.forward) == 0.0;
}

PackedScene pack_scene(const Scene& scene) {
  PackedScene packed;
  std::vector<float> lights;
  for (const Rectangle& rectangle : scene.rectangles) {
    const Vector normal = cross(rectangle.edge_u, rectangle.edge_v);
    const double area = length(normal);
    packed.words.emplace_back(rounded(rectangle.corner), 0.0f);
    packed.words.emplace_back(rounded(rectangle.edge_u), static_cast<float>(rectangle.material));
    packed.words.emplace_back(rounded(rectangle.edge_v), 0.0f);
    packed.words.emplace_back(rounded(normal * (1.0 / area)), static_cast<float>(area));
    const Rgb emission = scene.materials[static_cast<std::size_t>(rectangle.material)].emission;
    if (emission.r + emission.g + emission.b > 0.0f) lights.push_back(static_cast<float>(packed.primitives));
    ++packed.primitives;
  }
  for (const Sphere& sphere : scene.spheres) {
    packed.words.emplace_back(rounded(sphere.centre), 1.0f);
    packed.words.emplace_back(static_cast<float>(sphere.radius), static_cast<float>(sphere.material), 0.0f,
                              0.0f);
    packed.words.resize(packed.words.size() + 2);
    ++packed.primitives;
  }
  // Indices are stored as floats, which hold integers up to 2^24: kMaxTexels and what precedes stays below.
  std::vector<float> first_texel;
  std::size_t next = packed.words.size() + 3 * scene.materials.size() + lights.size();
  for (const Grid<Rgb>& image : scene.images) {
    first_texel.push_back(static_cast<float>(next));
    next += image.count();
  }
  for (const Material& material : scene.materials) {
    packed.words.emplace_back(words(material.albedo), material.roughness);
    packed.words.emplace_back(words(material.emission), 0.0f);
    if (material.image >= 0) {
      const auto image = static_cast<std::size_t>(material.image);
      packed.words.emplace_back(first_texel[image], static_cast<float>(scene.images[image].width()),
                                static_cast<float>(scene.images[image].height()), -1.0f);
    } else {
      packed.words.emplace_back(words(material.checker_albedo),
                                static_cast<float>(material.checker_u * 1024 + material.checker_v));
    }
    ++packed.materials;
  }
  for (const float light : lights) packed.words.emplace_back(light, 0.0f, 0.0f, 0.0f);
  packed.lights = static_cast<int>(lights.size());
  for (const Grid<Rgb>& image : scene.images) {
    for (const Rgb& texel : image) packed.words.emplace_back(words(texel), 0.0f);
  }
  return packed;
}

std::vector<std::int32_t> levels_to_sample(const TemporalTextures& textures, Method method) {
  if (method != Method::slices) return {textures.mask.begin(), textures.mask.end()};
  std::vector<std::int32_t> levels;
  for (const auto& slice : textures.slices) levels.insert(levels.end(), slice.begin(), slice.end());
  return levels;
}

FrameConstants frame_constants(const Scene& scene, const PackedScene& packed,
                               const TemporalTextures& textures, const RenderSettings& settings,
                               Extent padded, int frame) {
  FrameConstants constants{};
  const int view = settings.camera_frame.value_or(frame);
  const int view_before = settings.camera_frame.value_or(std::max(frame - 1, 0));
  const Camera now = camera_at(scene, settings.screen, view);
  const Camera before = camera_at(scene, settings.screen, view_before);
  constants.eye = {rounded(now.eye), 0.0f};
  constants.forward = {rounded(now.forward), 0.0f};
  constants.right = {rounded(now.right), 0.0f};
  constants.down = {rounded(now.down), 0.0f};
  constants.previous_eye = {rounded(before.eye), 0.0f};
  constants.previous_forward = {rounded(before.forward), 0.0f};
  constants.previous_right = {rounded(before.right), 0.0f};
  constants.previous_down = {rounded(before.down), 0.0f};
  constants.sky = {words(scene.sky), 0.0f};
  constants.pixel_size2 = static_cast<float>(dot(now.right, now.right));
  constants.screen_width = settings.screen.width;
  constants.screen_height = settings.screen.height;
  constants.seed_pitch = padded.width;
  constants.primitive_count = packed.primitives;
  constants.material_count = packed.materials;
  constants.light_count = packed.lights;
  constants.bounces = settings.bounces;
  constants.sort_by_light = settings.sort_by_light ? 1 : 0;
  constants.paths = settings.paths;
  const bool by_slices = settings.method == Method::slices;
  const bool by_mask = settings.method == Method::mask_still || settings.method == Method::mask_moved ||
                       settings.method == Method::mask_golden || by_slices;
  constants.sampling = by_mask ? 1 : 0;
  // White noise gets new seeds each frame; a mask turns one point, which is new each frame only where
  // the mask itself is neither moved nor turned in time.
  const auto random = [&](int draw) {
    return static_cast<std::uint32_t>(
        random_bits(settings.seed, kMethodStream, static_cast<std::uint64_t>(draw)));
  };
  if (settings.method == Method::white) constants.frame_key = random(frame);
  if (by_mask) constants.frame_key = random(0);
  int highest = 0;
  for (const std::int32_t level : levels_to_sample(textures, settings.method))
    highest = std::max(highest, level);
  constants.level_shift = highest < 256 ? 23 - 8 : 23 - 16;
  if (settings.method == Method::mask_golden) {
    constants.rotation = static_cast<std::uint32_t>(frame) * kGoldenRatio24 & 0xFFFFFFu;
  }
  const Grid<std::int32_t>& sampled = by_slices ? textures.slices.front() : textures.mask;
  constants.tile_width = sampled.width();
  constants.tile_height = sampled.height();
  if (by_slices) {
    const auto slice = static_cast<std::size_t>(frame) % textures.slices.size();
    constants.first_level = static_cast<std::int32_t>(slice * sampled.count());
  }
  if (settings.method == Method::mask_moved) {
    const Offset shift = tile_shift(textures.mask.size(), textures.step, frame);
    constants.shift_x = shift.x;
    constants.shift_y = shift.y;
  }
  return constants;
}

}  // namespace bn::render
