// Sort, retarget and motion choice on a device.

#include "render/temporal_passes.h"

#include <fmt/format.h>

#include "bn/error.h"
#include "render/scene.h"
#include "render/shaders.h"

namespace bn::render {
namespace {

struct IntVec2 {
  std::int32_t x, y;
};

IntVec2 ivec2(Offset offset) { return {offset.x, offset.y}; }
IntVec2 ivec2(Extent extent) { return {extent.width, extent.height}; }

// The push constants of the shaders, member by member (std430 has no gaps here).
struct SortPush {
  IntVec2 screen, tile, shift, origin;
  std::int32_t seed_pitch, columns, blocks, mask;
};
struct RetargetPush {
  IntVec2 size, tile, shift;
  std::int32_t motion_range, mask;
};
struct MotionSumPush {
  std::int32_t pixels;
};
struct MotionChoosePush {
  std::int32_t motion_range;
};

constexpr std::uint32_t kMotionLanes = 1024;

std::span<const std::uint32_t> sort_shader(int block) {
  switch (block) {
    case 2:
      return shaders::sort_2;
    case 4:
      return shaders::sort_4;
    case 8:
      return shaders::sort_8;
    case 16:
      return shaders::sort_16;
  }
  throw Error({.code = ErrorCode::invalid_input,
               .what = fmt::format("sort blocks of {} pixels", block),
               .where = "block",
               .limit = "2, 4, 8 or 16",
               .remedy = ""});
}

/// Two 16-bit signed numbers in 32 bits, x below.
std::uint32_t packed(int x, int y) {
  return static_cast<std::uint32_t>(static_cast<std::uint16_t>(x)) |
         static_cast<std::uint32_t>(static_cast<std::uint16_t>(y)) << 16;
}

template <class T>
void upload_all(VulkanDevice& device, const gpu::DeviceBuffer& to, const T& values) {
  device.upload(to, std::as_bytes(std::span(values.data(), values.size())));
}

}  // namespace

TemporalPasses::TemporalPasses(VulkanDevice& device, const TemporalTextures& textures, Extent screen,
                               const Seeds& seeds, int block)
    : device_(device),
      screen_(screen),
      padded_(seeds.size()),
      tile_(textures.size()),
      step_(textures.step),
      masks_(static_cast<int>(textures.masks.size())),
      block_(block),
      motion_range_(textures.motion_range),
      sort_(gpu::shared_pass(device, sort_shader(block), 3, sizeof(SortPush), 64)),
      retarget_(gpu::shared_pass(device, shaders::retarget, 4, sizeof(RetargetPush), 64)),
      motion_sum_(gpu::shared_pass(device, shaders::motion_sum, 2, sizeof(MotionSumPush), 64)),
      motion_choose_(gpu::shared_pass(device, shaders::motion_choose, 2, sizeof(MotionChoosePush), 1)) {
  const auto pixels = static_cast<std::uint64_t>(screen.area());
  const std::vector<std::int32_t> levels = levels_of(textures);
  mask_ = device.make_buffer(levels.size() * 4);
  upload_all(device, mask_, levels);
  std::vector<std::uint32_t> moves;
  for (const Grid<Offset>& tile : textures.moves) {
    // The same move on the torus of the seeds, and shorter than it: the shader wraps only once.
    for (const Offset& move : tile) {
      moves.push_back(packed(wrap_centred(move.x, padded_.width), wrap_centred(move.y, padded_.height)));
    }
  }
  moves_ = device.make_buffer(moves.size() * 4);
  upload_all(device, moves_, moves);
  luminance_ = device.make_buffer(pixels * 4);
  motion_ = device.make_buffer(pixels * 4);
  sums_ = device.make_buffer(kMotionLanes * 16);
  chosen_ = device.make_buffer(8);
  for (gpu::DeviceBuffer& buffer : seeds_) buffer = device.make_buffer(seeds.count() * 4);
  device.upload(seeds_[0], std::as_bytes(std::span(seeds.data(), seeds.count())));
}

void TemporalPasses::record_motion_choice(const vk::raii::CommandBuffer& commands) const {
  motion_sum_->record(commands, {&motion_, &sums_}, MotionSumPush{static_cast<std::int32_t>(screen_.area())},
                      kMotionLanes);
  motion_choose_->record(commands, {&sums_, &chosen_}, MotionChoosePush{motion_range_}, 1);
}

void TemporalPasses::record_retarget(const vk::raii::CommandBuffer& commands, int frame) {
  retarget_->record(commands, {&moves_, &chosen_, &seeds_[current_], &seeds_[1 - current_]},
                    RetargetPush{ivec2(padded_), ivec2(tile_), ivec2(tile_shift(tile_, step_, frame)),
                                 motion_range_, frame % masks_},
                    padded_.width, padded_.height);
  current_ = 1 - current_;
}

void TemporalPasses::record_sort(const vk::raii::CommandBuffer& commands, int frame, Offset origin) const {
  const int columns = (screen_.width + origin.x + block_ - 1) / block_;
  const int rows = (screen_.height + origin.y + block_ - 1) / block_;
  sort_->record(commands, {&luminance_, &mask_, &seeds_[current_]},
                SortPush{ivec2(screen_), ivec2(tile_), ivec2(tile_shift(tile_, step_, frame)), ivec2(origin),
                         padded_.width, columns, columns * rows, frame % masks_},
                std::int64_t{columns} * rows);
}

Seeds TemporalPasses::download_seeds() {
  Seeds result(padded_);
  device_.download(seeds_[current_], std::as_writable_bytes(std::span(result.data(), result.count())));
  return result;
}

Offset TemporalPasses::download_chosen_motion() {
  IntVec2 motion{};
  device_.download(chosen_, std::as_writable_bytes(std::span(&motion, 1)));
  return {motion.x, motion.y};
}

}  // namespace bn::render
