// Protects: what the Texture view shows of masks, stacks and retarget tiles is what the library says of them,
// through the real program without a display.

#include "ui/inspector.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cstring>

#include "bn/bake.h"
#include "bn/random.h"
#include "bn/spectrum.h"

namespace bn::ui {
namespace {

TEST(TextureView, ShowsATextureItsVerdictAndTheLibrarysFigures) {
  const Workplace here;
  here.write_mask("mask.png", 64);
  const FileContent content = read_image(here / "mask.png");
  const ChannelSamples samples = samples_of_channel(content.image, 0);
  const FiguresOfMerit figures = analyse(samples.value, {64, 64}, samples.low, samples.high).figures;
  char band[32];
  std::snprintf(band, sizeof band, "%.3g", figures.bands.mean[3]);
  expect_success(here.script(R"s(
open mask.png
wait-for Verified contains pass
expect Size = "64 × 64"
expect Kind = mask
expect Seed = 1
wait-for Check = pass
expect Grade contains "of 100"
expect "Power, f 0.1875…0.25" = )s" +
                             std::string(band) + R"s(
expect Picture = "64 × 64"
expect Spectrum = "64 × 64"
screenshot shot.png
)s"));
  const Image shot = read_image(here / "shot.png").image;
  ASSERT_EQ(shot.size, (Extent{1280, 800}));
  EXPECT_GT(contrast(shot, {0.05, 0.2, 0.40, 0.8}), 50.0) << "the mask";
  EXPECT_GT(contrast(shot, {0.47, 0.1, 0.69, 0.45}), 20.0) << "its spectrum";
  EXPECT_GT(contrast(shot, {0.73, 0.1, 0.98, 0.5}), 10.0) << "its facts";
  EXPECT_GT(contrast(shot, {0.0, 0.0, 0.2, 0.07}), 5.0) << "menu and tabs";
}

TEST(TextureView, ShowsAStackOfSlicesAsAVolume) {
  const Workplace here;
  for (int i = 0; i < 16; ++i)
    here.write_mask("stack/slice_" + std::to_string(i) + ".png", 32, static_cast<std::uint64_t>(i));
  const Outcome outcome = here.script(R"s(
open stack
wait-for Size = "32 × 32, 16 slices"
expect Slice = 0
set Slice 9
wait-for Slice = 9
hover Picture 0.5 0.5
wait 3
print Pixel
click "Cut: XZ"
wait-for Picture = "32 × 16"
click "Cut: XY"
wait-for Picture = "32 × 32"
key space
wait 30
expect Slice != 9
click Pause
wait-for "Power in time at 0" > 0.3      # independent masks are white in time
expect Check = FAIL
wait-for Verified = "pass, 64 of 64 checks"
)s");
  expect_success(outcome);
  const Image slice = read_image(here / "stack/slice_9.png").image;
  int x = -1, y = -1, level = -1;
  const std::size_t pixel = outcome.output.find("Pixel: ");
  ASSERT_NE(pixel, std::string::npos) << outcome.output;
  ASSERT_EQ(std::sscanf(outcome.output.c_str() + pixel, "Pixel: (%d, %d) %d", &x, &y, &level), 3)
      << outcome.output;
  EXPECT_NEAR(x, 16, 1);
  EXPECT_NEAR(y, 16, 1);
  EXPECT_EQ(level, static_cast<int>(slice.samples[static_cast<std::size_t>(y * 32 + x)]));
}

TEST(TextureView, ShowsMotionsOfARetargetAtlasAndNoFiguresOfNoise) {
  const Workplace here;
  here.write_mask("mask.png", 32);
  RetargetEntry entry;
  entry.name = "atlas";
  entry.image = here.path("mask.png");
  entry.problem.radius = 4;
  entry.motion = 1;
  entry.outputs = {{.path = here.path("atlas.png"), .kind = RetargetOutput::Kind::atlas}};
  make_entry(entry);
  const Metadata metadata = read_image(here / "atlas.png").metadata.value();
  const auto energy = [&](std::size_t tile) { return std::to_string(metadata.tiles.at(tile).energy); };
  expect_success(here.script(R"s(
open atlas.png
wait-for Motion = "(0, 0)"
expect Energy = )s" + energy(4) +
                             R"s(
expect "Energy map" = "9 cells"
set "Motion x" 1
wait-for Motion = "(1, 0)"
expect Energy = )s" + energy(5) +
                             R"s(
set "Motion y" -1
wait-for Motion = "(1, -1)"
expect Energy = )s" + energy(2) +
                             R"s(
expect Hues = "5.66 px"
expect "Radial power" gone
expect "Peak power" gone
expect Slice gone
expect Play gone
screenshot atlas.png.shot.png
open mask.png
wait-for "Peak power" > 1
expect Columns gone
expect Hues gone
)s"));
  EXPECT_GT(contrast(read_image(here / "atlas.png.shot.png").image, {0.47, 0.4, 0.66, 0.7}), 10.0)
      << "the energy map";
}

TEST(TextureView, NamesTheChannelThatFiguresAreOfAndCombinesChannels) {
  const Workplace here;
  MaskEntry mask;
  mask.name = "mask";
  mask.void_and_cluster = {.size = {32, 32}};
  mask.channels = 4;
  mask.outputs = {{.path = here.path("rgba.png")}};
  make_entry(mask);
  expect_success(here.script(R"s(
open rgba.png
wait-for "Figures of channel" = "of channel R"
expect "Channel: All" = on
click "Channel: G"
wait-for "Figures of channel" = "of channel G"
expect "Spectrum of channel" = "of channel G"
ctrl-click "Channel: B"
wait-for "Channel: B" = on
expect "Channel: G" = on
screenshot gb.png
ctrl-click "Channel: G"
wait-for "Figures of channel" = "of channel B"
expect "Channel: G" = off
click "Channel: All"
wait-for "Figures of channel" = "of channel R"
)s"));
  const Image shot = read_image(here / "gb.png").image;
  std::int64_t red = 0, green = 0;
  for (int y = 300; y < 600; ++y) {
    for (int x = 100; x < 450; ++x) {
      const auto at = static_cast<std::size_t>(y * shot.size.width + x) * 3;
      red += static_cast<int>(shot.samples[at]);
      green += static_cast<int>(shot.samples[at + 1]);
    }
  }
  EXPECT_LT(red, green / 20) << "red is switched off";
}

TEST(TextureView, ShowsValuesInTexelsAndTheRangeAsNumbers) {
  const Workplace here;
  here.write_mask("mask.png", 64);
  const Image mask = read_image(here / "mask.png").image;
  const int level = static_cast<int>(mask.samples[7 * 64 + 5]);
  expect_success(here.script(fmt::format(R"s(
open mask.png
wait-for "Peak power" > 0
expect "Picture values" gone                # too small
expect Range = "0..255"
set Black 10
set White 200
wait-for Range = "10..200"
set White 999
wait-for White = 255
expect "Not taken" contains "allowed: 10..255"
click Auto
wait-for Range = "0..255"
set "Go to" "5, 7"
wait-for "Picture values" = decimal
expect Pixel = "(5, 7)  {0}, pinned"
screenshot values.png
click Hex
wait-for "Picture values" = hexadecimal
expect Pixel = "(5, 7)  {0:02X}, pinned"
set "Go to" "64, 0"
wait-for "No such pixel" contains "0..63"
set "Go to" ""
wait-for "No such pixel" gone
expect Pixel gone
)s",
                                         level)));
}

TEST(TextureView, OpensAStackThatBnBaked) {
  const Workplace here;
  for (const char* path : {"stack.ktx2", "stack/slice_%03d.png"}) {
    std::filesystem::create_directory(here / "stack");
    SpatiotemporalEntry entry;
    entry.name = "stack";
    entry.mask.size = {32, 32, 16};
    entry.outputs = {{.path = here.path(path)}};
    make_entry(entry);
  }
  for (const char* path : {"stack.ktx2", "stack"}) {
    expect_success(here.script(fmt::format(R"s(
open {}
wait-for Size = "32 × 32, 16 slices"
expect Kind = spatiotemporal-mask
wait-for "Power in time at 0" < 0.2
expect "Radial power" contains "2 curves"
expect "Radial power: in a slice (mean)" = on
click "Spectrum of: This one"
wait-for "Radial power" contains "1 curves"
set Slice 9
wait-for Slice = 9
expect "Power, f 0…0.0625" < 0.1
wait-for Verified contains pass 60
)s",
                                           path)));
  }
}

TEST(TextureView, ShowsALargeTextureAndItsSpectrumWithinItsMemory) {
  const Workplace here;
  constexpr int kSide = 4096;
  Image noise{.size = {kSide, kSide}, .channels = 1, .type = SampleType::u16, .samples = {}};
  noise.samples.resize(std::size_t{2} * kSide * kSide);
  for (std::size_t i = 0; i < noise.samples.size(); i += 8) {
    const std::uint64_t bits = random_bits(1, 0, i);
    std::memcpy(&noise.samples[i], &bits, sizeof bits);
  }
  write_image(here / "noise.bin", noise, {});
  expect_success(here.script(R"s(
open noise.bin
wait-for Size = "4096 × 4096"
wait-for Spectrum = "4096 × 4096" 60
expect "Power, f 0…0.0625" > 0.98
expect "Power, f 0…0.0625" < 1.02
wait-for "Picture shown" = yes 60
wait-for "Spectrum shown" = yes 60
hover Picture 0.5 0.5
wait 2
print Pixel
screenshot shot.png
)s"));
  // Its samples are 32 MiB, as doubles 128; 1.1 GiB in all are measured.
  rusage children{};
  getrusage(RUSAGE_CHILDREN, &children);
  EXPECT_LT(children.ru_maxrss, 2'000'000) << "KiB at most in memory";
  const Image shot = read_image(here / "shot.png").image;
  EXPECT_GT(contrast(shot, {0.05, 0.35, 0.40, 0.6}), 1.0) << "the noise, reduced";
  EXPECT_GT(contrast(shot, {0.47, 0.1, 0.69, 0.45}), 1.0) << "its spectrum";
}

}  // namespace
}  // namespace bn::ui
