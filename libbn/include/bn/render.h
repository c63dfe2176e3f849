// bn/render.h - floor 3: the temporal algorithm at work.
//
// A renderer whose pixels draw all their random numbers from one seed each moves those seeds between
// frames, so that the error of the picture becomes blue noise:
//
//   trace with the seeds  ->  sort them, block by block, like the dither mask  ->  retarget them from
//   this frame's mask to the next frame's  ->  next frame
//
// Source: E. Heitz and L. Belcour, "Distributing Monte Carlo errors as a blue noise in screen space
// by permuting pixel seeds between frames", Computer Graphics Forum 38(4), 2019.
//
// The functions of this header are the specification; the shaders in textures/shaders must equal
// them bit for bit. Conventions (grid, dither, scatter form, padding): docs/conventions.md.

#pragma once

#include <cstdint>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bn/execution.h"
#include "bn/gpu.h"
#include "bn/grid.h"
#include "bn/spatiotemporal.h"

namespace bn {

// --- random numbers of a pixel -----------------------------------------------------------------

/// One seed a pixel. The seed alone decides a pixel's samples: no frame number, no position.
using Seeds = Grid<std::uint32_t>;

/// A bijection of the 32-bit integers without visible structure: PCG-RXS-M-XS.
/// Source: M. Jarzynski and M. Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020.
constexpr std::uint32_t pcg_hash(std::uint32_t value) {
  const std::uint32_t state = value * 747796405u + 2891336453u;
  const std::uint32_t word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}

/// Random number `dimension` = 0, 1, ... of the stream that `seed` stands for, in [0, 1): a multiple
/// of 2^-24, so exact in single precision on any machine.
constexpr float sample(std::uint32_t seed, std::uint32_t dimension) {
  const std::uint32_t bits = pcg_hash(pcg_hash(seed) + dimension * 0x9E3779B9u);
  return static_cast<float>(bits >> 8) * 0x1p-24f;
}

/// The seed image for a screen: padded up to multiples of the tile, where a retarget tile wraps.
Extent padded_extent(Extent screen, Extent tile);

/// Seeds in no order, all different. `size` at most 2^32 pixels; `start` chooses another set.
Seeds initial_seeds(Extent size, std::uint32_t start);

/// A number that any permutation of the seeds leaves alone, and that almost any other change moves.
std::uint64_t multiset_digest(const Seeds& seeds);

// --- the passes --------------------------------------------------------------------------------

/// The baked textures of one run: one mask that the step moves, or a stack of masks, one a frame.
struct TemporalTextures {
  /// One or more of one size, levels 0..65535: frame t has mask t mod their number.
  std::vector<Grid<std::int32_t>> masks;
  Offset step;  ///< d: frame t dithers pixel p with texel p + t * d of its mask
  /// Scatter form, each of the masks' size: empty (never retarget), or for each mask the way to the next one,
  /// the last to the first: one tile (plain), or (2 * motion_range + 1)^2 variants row by row, the plain one
  /// in the middle.
  std::vector<Grid<Offset>> moves = {};
  int motion_range = 0;  ///< 0..8

  /// Throws invalid_input naming the first thing that is wrong. The rest may be asked of what has passed.
  void check() const;
  Extent size() const { return masks.front().size(); }
  /// Of frame `frame` >= 0: its mask's number, the mask, and where the frame begins in it.
  std::size_t mask_index(std::int64_t frame) const;
  const Grid<std::int32_t>& mask(std::int64_t frame) const { return masks[mask_index(frame)]; }
  Offset shift(std::int64_t frame) const;
  /// The tile that leads from `frame` to the next one, for a motion within the range.
  const Grid<Offset>& move(Offset motion, std::int64_t frame) const;
};

/// Where frame `frame` begins in a tile of `tile` texels: frame * step, wrapped into it.
Offset tile_shift(Extent tile, Offset step, std::int64_t frame);

/// The blocks within which seeds are sorted.
struct SortBlocks {
  int side = 8;   ///< 2, 4, 8 or 16 pixels
  Offset origin;  ///< the grid's first block starts at -origin; 0..side-1 each
};

/// The grid of frame `frame`: at rest, or moved by a random offset each frame.
SortBlocks sort_blocks(int side, bool jitter, std::uint64_t seed, std::int64_t frame);

/// Sort pass. In each block the seed of the k-th darkest pixel goes to the pixel with the k-th
/// lowest mask level at `shift`. Only pixels of the screen (luminance's extent) take part; a block
/// that the screen's edge cuts is smaller.
/// The orders are total, so that every machine finds the same one: luminance is compared by its
/// exponent and its 16 leading fraction bits (relative steps of 1/65536), then by index in the block;
/// level, then index. NaN and negative luminance count as 0.
/// `seeds` is at least as large as `luminance`; `mask` levels 0..65535.
void sort_seeds(Seeds& seeds, const Grid<float>& luminance, const Grid<std::int32_t>& mask, Offset shift,
                const SortBlocks& blocks, const Execution& execution = {});

/// Retarget pass: the seed at p moves to p + move(p + shift), on the torus of `seeds`, whose sides
/// are multiples of the tile's. A bijection wherever `move` is one.
Seeds retarget_seeds(const Seeds& seeds, const Grid<Offset>& move, Offset shift,
                     const Execution& execution = {});

/// How far the picture moved at one pixel, in 1/256 pixel; x = kNoMotion where nothing is known
/// (sky, or a point that was behind the camera).
struct PixelMotion {
  std::int16_t x = 0;
  std::int16_t y = 0;
  friend bool operator==(const PixelMotion&, const PixelMotion&) = default;
};
inline constexpr std::int16_t kNoMotion = -32768;

/// The mean motion over the known pixels, rounded half up to whole pixels, clamped to -range..range
/// on each axis; (0, 0) where no pixel knows. Exact: sums are integers.
Offset choose_motion(const Grid<PixelMotion>& motion, int range);

// --- scenes --------------------------------------------------------------------------------------

struct Rgb {
  float r = 0.0f, g = 0.0f, b = 0.0f;
  friend bool operator==(const Rgb&, const Rgb&) = default;
};

struct Vector {
  double x = 0.0, y = 0.0, z = 0.0;
};

/// Rectangles, boxes and spheres with one material each, lit by the rectangles that emit and the
/// sky. At most kMaxPrimitives of them, met one after the other by every ray.
inline constexpr int kMaxPrimitives = 1024;

/// At most so many texels in the images of a scene: 64 MiB on the device.
inline constexpr std::int64_t kMaxTexels = 4'194'304;

struct Material {
  Rgb albedo{0.5f, 0.5f, 0.5f};  ///< 0..1; reflectance at normal incidence where glossy
  Rgb emission;                  ///< 0 or more; rectangles only
  float roughness = -1.0f;       ///< below 0: diffuse; 0.05..1: glossy, GGX with alpha = roughness^2
  int checker_u = 0;             ///< cells along a rectangle's edges, 0 (no pattern) .. 1023
  int checker_v = 0;
  Rgb checker_albedo;  ///< of every other cell
  int image = -1;      ///< albedo from Scene::images[image]; rectangles only, no checker with it
};

struct Rectangle {
  Vector corner, edge_u, edge_v;  ///< edges at right angles
  int material = 0;
};

struct Sphere {
  Vector centre;
  double radius = 1.0;
  int material = 0;
};

struct CameraKey {
  int frame = 0;
  Vector eye, at;
};

/// A part of the picture, as shares of its sides, for measures of their own.
struct Region {
  std::string name;
  double x = 0.0, y = 0.0, width = 1.0, height = 1.0;
};

struct Scene {
  std::string name;
  std::string about = {};  ///< a sentence or two on what is to be seen, for the page of a study
  Rgb sky;
  double fov_degrees = 45.0;      ///< vertical, 1..150
  std::vector<CameraKey> camera;  ///< at least one, frames rising; straight lines between keys
  double pan_x_px = 0.0;          ///< moves the camera each frame, in pixels at the looked-at point
  double pan_y_px = 0.0;
  std::vector<Material> materials;
  std::vector<Rectangle> rectangles;  ///< a box of the file is six of these
  std::vector<Sphere> spheres;
  std::vector<Region> regions;
  /// Albedo textures, linear, 0..1: upright where edge_u goes right and edge_v up. The nearest texel counts.
  std::vector<Grid<Rgb>> images = {};
};

/// The names of the scenes that come with libbn, in the order in which a study renders them.
std::vector<std::string> shipped_scene_names();

/// `name_or_path`: a shipped scene, or a TOML file (docs/validation.md has the keys).
/// Errors: io; invalid_input naming file and line: unknown keys, missing materials, numbers that are
/// not finite or out of range, edges that are not at right angles, too many primitives.
Scene load_scene(const std::string& name_or_path);
/// The same from text; `where` names it in messages, and images are looked for in its folder.
Scene read_scene(std::string_view toml, const std::string& where);

// --- rendering -----------------------------------------------------------------------------------

/// Where a pixel takes its random numbers from. All cost the same rays.
enum class Sampler {
  white,        ///< new random seeds each frame
  seeds,        ///< the pixel's seed alone
  mask_still,   ///< the first mask for all frames
  mask_moved,   ///< the frame's mask: one that the step moves, or the next of a stack
  mask_golden,  ///< the first mask's levels turned by the golden ratio each frame
};

/// What carries the seeds of one frame to the next. Anything but `none` needs the sampler `seeds`.
enum class SeedTransport {
  none,       ///< each pixel keeps its seed
  sort,       ///< sort like the mask
  retarget,   ///< sort, and the plain retarget tile
  reproject,  ///< sort, and the tile for the mean motion of the picture
};

/// A sampler with a transport. The seven that have names are those that a study compares.
struct Method {
  Sampler sampler = Sampler::seeds;
  SeedTransport transport = SeedTransport::none;
  friend constexpr bool operator==(const Method&, const Method&) = default;

  static const Method white, mask_still, mask_moved, mask_golden;
  static const Method sort, retarget, reproject;  ///< the temporal algorithm
};
inline constexpr Method Method::white{Sampler::white};
inline constexpr Method Method::mask_still{Sampler::mask_still};
inline constexpr Method Method::mask_moved{Sampler::mask_moved};
inline constexpr Method Method::mask_golden{Sampler::mask_golden};
inline constexpr Method Method::sort{Sampler::seeds, SeedTransport::sort};
inline constexpr Method Method::retarget{Sampler::seeds, SeedTransport::retarget};
inline constexpr Method Method::reproject{Sampler::seeds, SeedTransport::reproject};

/// "white", "mask-still", ... of the seven; empty for other combinations.
std::string_view name_of(const Method& method);
inline constexpr Method kMethods[] = {Method::white,       Method::mask_still, Method::mask_moved,
                                      Method::mask_golden, Method::sort,       Method::retarget,
                                      Method::reproject};

struct RenderSettings {
  Extent screen{256, 256};  ///< sides 1..4096
  Method method = Method::retarget;
  int bounces = 2;             ///< 1..8 scatterings a path
  int paths = 1;               ///< a pixel, 1..64: the seed and the path's number decide each
  int block = 8;               ///< sort block's side: 2, 4, 8, 16
  bool jitter = false;         ///< of the block grid
  bool sort_by_light = false;  ///< sort by the light alone, without the surface's colour
  std::uint64_t seed = 1;
  std::optional<int> camera_frame = {};  ///< the camera stays where it is at this frame
};

struct Frame {
  Grid<Rgb> colour;           ///< linear radiance
  Grid<std::uint32_t> shown;  ///< tone mapped, bytes R, G, B, 255 from low to high
  Seeds seeds;                ///< as the frame was traced with
  Offset motion;              ///< that the seeds were carried by before this frame
  Grid<PixelMotion> motion_of_pixel;
  std::vector<PassTime> times;  ///< empty for the plain renderer
};

/// Renders frames 0, 1, 2, ... of one sequence; each call is the next frame:
/// G-buffer, motion, retarget, trace, sort, tone map, as the method needs them. The multiset of seeds is
/// checked at every frame.
class Renderer {
 public:
  virtual ~Renderer() = default;
  virtual Frame next() = 0;
  virtual std::string device() const = 0;
};

/// The plain renderer, on the processor.
std::unique_ptr<Renderer> make_plain_renderer(const Scene& scene, const TemporalTextures& textures,
                                              const RenderSettings& settings,
                                              const Execution& execution = {});

/// The same renderer on a device: equal bit for bit where the device rounds like IEEE, as lavapipe
/// does; seeds are equal whenever the luminance is.
/// Errors: over_limit (device memory).
std::unique_ptr<Renderer> make_vulkan_renderer(std::shared_ptr<VulkanDevice> device, const Scene& scene,
                                               const TemporalTextures& textures,
                                               const RenderSettings& settings);

// --- textures of a run ---------------------------------------------------------------------------

/// Reads mask.png and retarget_atlas.png (or retarget.png) of a baked folder. The step is the one the
/// tiles were baked for.
/// Errors: io; verification_failed (a pixel hash that is not the recorded one); invalid_input: sizes
/// that disagree, and a `step` other than the recorded one, unless `unsafe` lets it pass.
TemporalTextures read_temporal_textures(const std::filesystem::path& folder, std::optional<Offset> step = {},
                                        bool unsafe = false, const Execution& execution = {});

/// A stack of masks: a file that holds slices, a pattern (slice_%03d.png), or the images of a folder in name
/// order, numbers by their value; the first channel of each. With `tiles`, likewise, what `bn retarget` made
/// of that stack, or without moves.
/// Errors: io; invalid_input (no images, sizes that differ; tiles of another stack, size or depth);
/// verification_failed (as above).
TemporalTextures read_stack_textures(const std::filesystem::path& slices,
                                     const std::filesystem::path& tiles = {},
                                     const Execution& execution = {});

/// A 64 x 64 mask of 8 bits and its proven tiles for motions of -range..range, made on the spot.
TemporalTextures make_temporal_textures(int motion_range, const Execution& execution = {});

/// The same of a stack: 64 x 64 x 32 of a preset, seed 1, at rest, without moves.
TemporalTextures make_preset_textures(SpatiotemporalPreset preset, const Execution& execution = {});

/// Gives `textures` the proven plain tile of each mask to the next one, by execution.threads.
/// Errors: those of solve_retarget().
void solve_moves(TemporalTextures& textures, int radius, const Execution& execution = {});

}  // namespace bn
