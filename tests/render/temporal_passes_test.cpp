// Protects: the shaders of sort, retarget and motion choice equal the plain functions bit for bit, on
// screens that fit the tile and screens that do not, and the validation layers (with synchronisation
// checks) have nothing to say.
#include <gtest/gtest.h>

#include <array>

#include "bn/error.h"
#include "bn/random.h"
#include "bn/render.h"
#include "render/temporal_passes.h"

// Drivers keep memory to the end of the process.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libvulkan_lvp\nleak:libLLVM\nleak:libVkLayer\nleak:libvulkan.so\nleak:libdbus\n";
}

namespace bn {
using namespace render;
namespace {

VulkanDevice& device() {
  // Never closed: the driver stays loaded, so that what it keeps can be told by its name, above.
  static VulkanDevice& device = *new VulkanDevice("lavapipe", true);
  return device;
}

std::string first_complaint() { return device().complaints().empty() ? "" : device().complaints().front(); }

TemporalTextures some_textures(Extent size, int range, int masks) {
  TemporalTextures textures{.masks = {}, .step = {5, 3}, .motion_range = range};
  for (std::uint64_t mask = 0; mask < static_cast<std::uint64_t>(masks); ++mask) {
    Grid<std::int32_t>& levels = textures.masks.emplace_back(size);
    for (std::size_t i = 0; i < levels.count(); ++i)
      levels[i] = static_cast<std::int32_t>(random_bits(5 + mask, 1, i) & 255);
    for (int y = -range; y <= range; ++y) {
      for (int x = -range; x <= range; ++x) {
        Grid<Offset> move(size, {x, y});
        for (std::size_t i = 0; i + 1 < move.count(); i += 2) {
          if ((random_bits(6 + mask, static_cast<std::uint32_t>(y * 9 + x + 100), i) & 1) == 0) continue;
          move[i].x += 1;  // an even side: i and i + 1 share a row
          move[i + 1].x -= 1;
        }
        textures.moves.push_back(std::move(move));
      }
    }
  }
  textures.check();
  return textures;
}

void expect_equal_runs(Extent screen, int block, bool jitter, int frames, int masks = 1) {
  SCOPED_TRACE(std::to_string(screen.width) + "x" + std::to_string(screen.height) + ", block " +
               std::to_string(block));
  const TemporalTextures textures = some_textures({16, 8}, 2, masks);
  Seeds seeds = initial_seeds(padded_extent(screen, textures.size()), 3);
  const std::uint64_t digest = multiset_digest(seeds);
  TemporalPasses temporal(device(), textures, screen, seeds, block);
  Grid<float> luminance(screen);
  Grid<PixelMotion> motion(screen);
  for (int frame = 0; frame < frames; ++frame) {
    for (std::size_t i = 0; i < luminance.count(); ++i) {
      const auto pixel = static_cast<std::uint32_t>(i);
      // Few levels, so that ties are common; sometimes negative.
      luminance[i] =
          static_cast<float>(static_cast<int>(sample(pixel, static_cast<std::uint32_t>(frame)) * 64.0f) - 2);
      const bool known = sample(pixel, 1000) > 0.3f;
      motion[i] = known ? PixelMotion{static_cast<std::int16_t>(frame * 200 - 600),
                                      static_cast<std::int16_t>(300 - frame * 128)}
                        : PixelMotion{kNoMotion, kNoMotion};
    }
    const Offset shift = textures.shift(frame);
    const SortBlocks blocks = sort_blocks(block, jitter, 4, frame);
    const Offset moved = choose_motion(motion, textures.motion_range);
    sort_seeds(seeds, luminance, textures.mask(frame), shift, blocks);
    seeds = retarget_seeds(seeds, textures.move(moved, frame), shift);

    device().upload(temporal.luminance(), std::as_bytes(std::span(luminance.data(), luminance.count())));
    device().upload(temporal.motion(), std::as_bytes(std::span(motion.data(), motion.count())));
    device().run([&](const vk::raii::CommandBuffer& commands) {
      temporal.record_sort(commands, frame, blocks.origin);
      temporal.record_motion_choice(commands);
      temporal.record_retarget(commands, frame);
    });
    ASSERT_EQ(temporal.download_chosen_motion(), moved) << "frame " << frame;
    ASSERT_EQ(temporal.download_seeds(), seeds) << "frame " << frame;
  }
  EXPECT_EQ(multiset_digest(seeds), digest);
  EXPECT_EQ(first_complaint(), "");
}

TEST(TemporalPasses, EqualThePlainFunctions) {
  for (const int block : {2, 4, 8, 16}) expect_equal_runs({131, 77}, block, true, 6);
}

TEST(TemporalPasses, EqualOnStacks) {
  // Three masks, six frames: the stack comes around.
  for (const int block : {2, 8}) expect_equal_runs({131, 77}, block, true, 6, 3);
}

TEST(TemporalPasses, EqualOnOddScreens) {
  for (const Extent screen : {Extent{1, 1}, {64, 64}, {257, 131}}) expect_equal_runs(screen, 8, false, 3);
}

}  // namespace
}  // namespace bn
