// Protects: the integers that energies are made of, and the notes about the picture that come with them.
#include <cmath>
#include <limits>

#include "bn/error.h"
#include "texture/fixtures.h"

namespace bn::texture {
namespace {

TEST(Levels, IntegersAreTakenAsTheyAre) {
  const Image u8 = random_image({9, 5}, 3, SampleType::u8);
  const Image u16 = random_image({9, 5}, 3, SampleType::u16);
  for (int channel = 0; channel < 3; ++channel) {
    const Levels small = levels_of_channel(u8, channel), large = levels_of_channel(u16, channel);
    for (std::size_t i = 0; i < 45; ++i) {
      EXPECT_EQ(small.value[i], samples_of<std::uint8_t>(u8)[3 * i + static_cast<std::size_t>(channel)]);
      EXPECT_EQ(large.value[i], samples_of<std::uint16_t>(u16)[3 * i + static_cast<std::size_t>(channel)]);
    }
    EXPECT_EQ(small.unit, 1.0);
    EXPECT_EQ(small.offset, 0.0);
    EXPECT_EQ(small.rounding_error, 0.0);
  }
}

TEST(Samples, AreAsStoredWithTheRangeOfAnEvenSpread) {
  const Image u16 = random_image({9, 5}, 3, SampleType::u16);
  const ChannelSamples blue = samples_of_channel(u16, 2);
  ASSERT_EQ(blue.value.size(), 45u);
  for (std::size_t i = 0; i < 45; ++i) EXPECT_EQ(blue.value[i], samples_of<std::uint16_t>(u16)[3 * i + 2]);
  EXPECT_EQ(blue.high, 65536.0);
  EXPECT_EQ(samples_of_channel(random_image({9, 5}, 1, SampleType::u8), 0).high, 256.0);

  const auto of = [](std::vector<float> samples) {
    return samples_of_channel(image_of<float>({3, 1}, 1, SampleType::f32, samples), 0);
  };
  EXPECT_EQ(of({0.25f, 0.5f, 0.75f}).low, 0.0);
  EXPECT_EQ(of({0.25f, 0.5f, 0.75f}).high, 1.0);
  EXPECT_EQ(of({-1.0f, 0.5f, 0.75f}).low, -1.0);
  EXPECT_EQ(of({-1.0f, 0.5f, 0.75f}).high, 0.75);
  EXPECT_TRUE(std::isnan(of({0.5f, std::nanf(""), 0.75f}).value[1]));
  ChannelSamples stack = of({0.25f, 0.5f, 0.75f});
  append_samples(stack, of({-1.0f, 0.5f, 2.0f}));
  EXPECT_EQ(stack.value, (std::vector<double>{0.25, 0.5, 0.75, -1.0, 0.5, 2.0}));
  EXPECT_EQ(stack.low, -1.0);
  EXPECT_EQ(stack.high, 2.0);
  EXPECT_THROW(samples_of_channel(u16, 3), Error);
  EXPECT_THROW(samples_of_channel(u16, -1), Error);
}

TEST(Levels, FloatsSpanTheirRangeWithTheStatedError) {
  const std::vector<float> samples = {-2.5f, 7.25f, 0.0f, 1e-3f, 6.999f, 3.14159f};
  const Levels levels = levels_of_channel(image_of<float>({3, 2}, 1, SampleType::f32, samples), 0);
  EXPECT_EQ(levels.offset, -2.5);
  EXPECT_EQ(levels.unit, 9.75 / 65535);
  EXPECT_EQ(levels.value[0], 0);
  EXPECT_EQ(levels.value[1], 65535);
  double worst = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    worst = std::max(worst, std::fabs(samples[i] - (levels.offset + levels.unit * levels.value[i])));
  }
  EXPECT_EQ(levels.rounding_error, worst);
  EXPECT_LE(levels.rounding_error, levels.unit / 2 * (1 + 1e-9));
}

TEST(Levels, ExtremeFloatsDoNotOverflow) {
  constexpr float kMax = std::numeric_limits<float>::max(), kTiny = std::numeric_limits<float>::denorm_min();
  const Levels wide = levels_of_channel(image_of<float>({3, 1}, 1, SampleType::f32, {-kMax, kMax, 0.0f}), 0);
  EXPECT_EQ(wide.value[0], 0);
  EXPECT_EQ(wide.value[1], 65535);
  EXPECT_EQ(wide.value[2], 32768);
  const Levels narrow = levels_of_channel(image_of<float>({2, 1}, 1, SampleType::f32, {0.0f, kTiny}), 0);
  EXPECT_EQ(narrow.value[1], 65535);
}

TEST(Levels, AFloatMaskGivesItsRanksBack) {
  Grid<std::uint32_t> rank({256, 256});
  for (std::uint32_t i = 0; i < 65536; ++i) rank[i] = (i * 40503u) & 0xffff;
  const Levels levels = levels_of_channel(encode_mask(rank, SampleType::f32), 0);
  for (std::size_t i = 0; i < rank.count(); ++i)
    ASSERT_EQ(levels.value[i], static_cast<std::int32_t>(rank[i]));
  EXPECT_EQ(levels.distinct, 65536);
  EXPECT_TRUE(levels.is_permutation);
}

TEST(Levels, NotFiniteSamplesAreCountedAndLocated) {
  std::vector<float> samples(20, 0.5f);
  samples[2 * 7 + 1] = NAN;
  samples[2 * 9 + 1] = -INFINITY;
  const Image image = image_of<float>({5, 2}, 2, SampleType::f32, samples);
  EXPECT_NO_THROW(levels_of_channel(image, 0));
  const auto error = error_of([&] { levels_of_channel(image, 1); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code, ErrorCode::invalid_input);
  EXPECT_EQ(error->what, "2 of 10 pixels are NaN or infinite, the first at x 2, y 1");
}

TEST(Levels, MissingChannelsAreRefused) {
  const Image image = random_image({2, 2}, 3, SampleType::u8);
  for (const int channel : {-1, 3, 64}) {
    expect_error(ErrorCode::invalid_input, [&] { levels_of_channel(image, channel); });
  }
}

TEST(Levels, ConstantAndTwoLevelImagesAreAllowedAndKnown) {
  for (const SampleType type : {SampleType::u8, SampleType::u16, SampleType::f32}) {
    const Image constant{.size = {4, 4},
                         .channels = 1,
                         .type = type,
                         .samples = std::vector<std::byte>(16 * bytes_per_sample(type), std::byte{61})};
    const Levels levels = levels_of_channel(constant, 0);
    EXPECT_EQ(levels.distinct, 1);
    EXPECT_FALSE(levels.is_permutation);
    EXPECT_EQ(levels.rounding_error, 0.0);
    EXPECT_GT(levels.unit, 0.0);
  }
  std::vector<std::uint8_t> samples(16, 0);
  for (std::size_t i = 0; i < 8; ++i) samples[i] = 255;
  const Levels levels = levels_of_channel(image_of({4, 4}, 1, SampleType::u8, samples), 0);
  EXPECT_EQ(levels.distinct, 2);
  EXPECT_FALSE(levels.is_permutation);
}

TEST(Levels, EveryBakedMaskIsAPermutationAndADamagedOneIsNone) {
  for (const Extent size : {Extent{2, 1}, Extent{3, 5}, Extent{16, 16}, Extent{17, 31}, Extent{300, 300}}) {
    Grid<std::uint32_t> rank(size);
    for (std::size_t i = 0; i < rank.count(); ++i) rank[i] = static_cast<std::uint32_t>(i);
    for (const SampleType type : {SampleType::u8, SampleType::u16, SampleType::f32}) {
      Image image = encode_mask(rank, type);
      EXPECT_TRUE(levels_of_channel(image, 0).is_permutation) << size.width << " " << name_of(type);
      // Half of the pixels become like the last one.
      const auto half = static_cast<std::size_t>(std::max<std::int64_t>(1, size.area() / 2));
      const std::size_t sample = bytes_per_sample(type);
      for (std::size_t i = 0; i < half; ++i) {
        std::copy_n(image.samples.end() - static_cast<std::ptrdiff_t>(sample), sample,
                    image.samples.begin() + static_cast<std::ptrdiff_t>(i * sample));
      }
      EXPECT_FALSE(levels_of_channel(image, 0).is_permutation) << size.width << " " << name_of(type);
    }
  }
}

}  // namespace
}  // namespace bn::texture
