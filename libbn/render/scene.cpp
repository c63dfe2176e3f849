// Scenes as the flat words that shaders read, and the constants of a frame.
//
// All of this runs once a scene or once a frame, in double precision, and is rounded to single at the
// end: both renderers get the same words, so nothing here can make them differ.

#include "render/scene.h"

#include <algorithm>

#include "bn/random.h"
#include "render/camera.h"
#include "render/vector_math.h"

namespace bn::render {
namespace {

constexpr std::uint32_t kGoldenRatio24 = 10368890;  // 0.618034 * 2^24
constexpr std::uint32_t kMethodStream = 0x52540003u;

}  // namespace

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

std::vector<std::int32_t> levels_of(const TemporalTextures& textures) {
  std::vector<std::int32_t> levels;
  for (const auto& mask : textures.masks) levels.insert(levels.end(), mask.begin(), mask.end());
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
  const Sampler sampler = settings.method.sampler;
  const bool by_mask = sampler != Sampler::white && sampler != Sampler::seeds;
  constants.sampling = by_mask ? 1 : 0;
  // White noise gets new seeds each frame; a mask turns one point, the same for all frames.
  const auto random = [&](int draw) {
    return static_cast<std::uint32_t>(
        random_bits(settings.seed, kMethodStream, static_cast<std::uint64_t>(draw)));
  };
  if (sampler == Sampler::white) constants.frame_key = random(frame);
  if (by_mask) constants.frame_key = random(0);
  int highest = 0;
  for (const std::int32_t level : levels_of(textures)) highest = std::max(highest, level);
  constants.level_shift = highest < 256 ? 23 - 8 : 23 - 16;
  if (sampler == Sampler::mask_golden) {
    constants.rotation = static_cast<std::uint32_t>(frame) * kGoldenRatio24 & 0xFFFFFFu;
  }
  constants.tile_width = textures.size().width;
  constants.tile_height = textures.size().height;
  if (sampler == Sampler::mask_moved) {
    constants.first_level =
        static_cast<std::int32_t>(textures.mask_index(frame) * textures.mask(frame).count());
    const Offset shift = textures.shift(frame);
    constants.shift_x = shift.x;
    constants.shift_y = shift.y;
  }
  return constants;
}

}  // namespace bn::render
