// Protects: textures/shaders/example.comp, the shader that engine programmers start from, runs as it stands:
// on a Vulkan device it moves every seed as retarget_seeds() does, loses none, and writes colours that are
// one of the neighbouring codes and right in the mean.
#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

#include "bn/noise.h"
#include "bn/render.h"
#include "bn/retarget.h"
#include "bn/texture.h"
#include "gpu/pass.h"
#include "quantise.h"

// Drivers keep memory to the end of the process.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libvulkan_lvp\nleak:libLLVM\nleak:libVkLayer\nleak:libvulkan.so\nleak:libdbus\n";
}

namespace bn::test {
using namespace gpu;
namespace {

constexpr std::uint32_t kExample[] =
#include "shaders/example.inc"
    ;

/// The push constants, member by member.
struct Push {
  Extent screen, size, tile;
  Offset shift;
};
struct Light {
  float r, g, b, a;
};

constexpr Extent kScreen{150, 70};
constexpr Extent kTile{64, 64};

struct Frame {
  Grid<std::int32_t> mask{kTile};
  Grid<Offset> moves{kTile};
  Offset step;
  Seeds seeds, next;
  std::vector<Light> light;
  std::vector<std::uint32_t> colours;
};

template <class T>
DeviceBuffer uploaded(VulkanDevice& device, const T& values) {
  const auto bytes = std::as_bytes(std::span(values.data(), values.size()));
  DeviceBuffer buffer = device.make_buffer(bytes.size());
  device.upload(buffer, bytes);
  return buffer;
}

template <class T>
void download(VulkanDevice& device, const DeviceBuffer& buffer, T& values) {
  device.download(buffer, std::as_writable_bytes(std::span(values.data(), values.size())));
}

/// Runs frame t on lavapipe: what a renderer would do with our two textures.
void run(Frame& frame, int t) {
  // Never closed: the driver stays loaded, so that what it keeps can be told by its name, above.
  static VulkanDevice& device = *new VulkanDevice("lavapipe", true);
  const std::vector<std::int32_t> mask(frame.mask.begin(), frame.mask.end());
  const std::vector<Offset> moves(frame.moves.begin(), frame.moves.end());
  std::vector<std::uint32_t> seeds(frame.seeds.begin(), frame.seeds.end());
  frame.colours.assign(static_cast<std::size_t>(kScreen.area()), 0);
  const DeviceBuffer light = uploaded(device, frame.light), levels = uploaded(device, mask),
                     retarget = uploaded(device, moves), now = uploaded(device, seeds),
                     next = uploaded(device, seeds), target = uploaded(device, frame.colours);
  const Push push{kScreen, frame.seeds.size(), kTile, tile_shift(kTile, frame.step, t)};
  const Pass pass(device, kExample, 6, sizeof push, 64);
  device.run([&](const vk::raii::CommandBuffer& commands) {
    pass.record(commands, {&light, &levels, &retarget, &now, &next, &target}, push,
                frame.seeds.size().area());
  });
  frame.next = Seeds(frame.seeds.size());
  download(device, next, seeds);
  std::copy(seeds.begin(), seeds.end(), frame.next.begin());
  download(device, target, frame.colours);
  EXPECT_TRUE(device.complaints().empty()) << device.complaints().front();
}

Frame some_frame() {
  Frame frame;
  const Image image = encode_mask(void_and_cluster({.size = kTile, .seed = 5}), SampleType::u8);
  frame.mask = levels_of_channel(image, 0).value;
  frame.step = auto_step(kTile).step;
  frame.moves = solve_retarget(frame.mask, {.step = frame.step}).move;
  frame.seeds = initial_seeds(padded_extent(kScreen, kTile), 9);
  for (std::int64_t i = 0; i < kScreen.area(); ++i) {
    // A ramp down the screen, dark in red, all of it in green, and a constant.
    const float row = static_cast<float>(i / kScreen.width) / static_cast<float>(kScreen.height - 1);
    frame.light.push_back({0.01f * row, row, 0.2f, 1.0f});
  }
  return frame;
}

double light_of(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

TEST(Example, MovesEverySeedAsRetargetingDoes) {
  Frame frame = some_frame();
  for (const int t : {0, 1, 7}) {
    run(frame, t);
    EXPECT_EQ(frame.next, retarget_seeds(frame.seeds, frame.moves, tile_shift(kTile, frame.step, t))) << t;
    EXPECT_EQ(multiset_digest(frame.next), multiset_digest(frame.seeds));
  }
}

TEST(Example, ShowsTheRightLightInTheMean) {
  Frame frame = some_frame();
  run(frame, 3);
  Quantise plain;
  const Offset shift = tile_shift(kTile, frame.step, 3);
  double blue = 0.0, red = 0.0, wanted_red = 0.0;
  int differ = 0;
  for (int y = 0; y < kScreen.height; ++y) {
    for (int x = 0; x < kScreen.width; ++x) {
      const auto i = static_cast<std::size_t>(y * kScreen.width + x);
      const Light light = frame.light[i];
      const float value[3] = {light.r, light.g, light.b};
      for (int channel = 0; channel < 3; ++channel) {
        const auto code = static_cast<int>(frame.colours[i] >> (8 * channel) & 255);
        const int apart = channel * (64 / 3 + 1);
        const int level = frame.mask.torus(x + shift.x + apart, y + shift.y + apart);
        const float noise = (static_cast<float>(level) + 0.5f) / 256.0f;
        const auto expected = static_cast<int>(
            std::lround(255.0f * plain.bn_dither_srgb_triangular(value[channel], 255.0f, noise)));
        // Devices round pow() differently, which decides where noise and probability are all but equal.
        EXPECT_LE(std::abs(code - expected), 1);
        differ += code != expected;
      }
      red += light_of((frame.colours[i] & 255) / 255.0);
      wanted_red += static_cast<double>(light.r);
      blue += light_of((frame.colours[i] >> 16 & 255) / 255.0);
    }
  }
  EXPECT_LT(differ, kScreen.area() / 500);
  const auto pixels = static_cast<double>(kScreen.area());
  EXPECT_NEAR(blue / pixels, 0.2, 2e-5);
  EXPECT_NEAR(red / wanted_red, 1.0, 2e-3) << "in the dark";
}

}  // namespace
}  // namespace bn::test
