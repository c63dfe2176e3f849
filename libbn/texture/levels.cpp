// One channel as numbers: as it is stored, and as integer levels. Energies are sums of level differences, so
// they are exact integers whatever the file held; for float samples the distance to the nearest level is
// stated.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "bn/texture.h"
#include "texture/error.h"
#include "texture/half.h"
#include "texture/image.h"

namespace bn {
namespace {

using texture::fail_input;

constexpr int kFloatLevels = 65536;

template <class Sample>
std::vector<Sample> samples_of(const Image& image, int channel) {
  std::vector<Sample> samples(static_cast<std::size_t>(image.shape().count()));
  const std::size_t pixel = static_cast<std::size_t>(image.channels) * sizeof(Sample);
  const std::byte* from = image.samples.data() + static_cast<std::size_t>(channel) * sizeof(Sample);
  for (std::size_t i = 0; i < samples.size(); ++i) std::memcpy(&samples[i], from + i * pixel, sizeof(Sample));
  return samples;
}

/// The samples of a float or half channel.
std::vector<float> floats_of(const Image& image, int channel) {
  if (image.type == SampleType::f32) return samples_of<float>(image, channel);
  const std::vector<std::uint16_t> bits = samples_of<std::uint16_t>(image, channel);
  std::vector<float> samples(bits.size());
  std::transform(bits.begin(), bits.end(), samples.begin(), texture::half_value);
  return samples;
}

/// How often each level occurs.
std::vector<std::int64_t> histogram(const Grid<std::int32_t>& value, int levels) {
  std::vector<std::int64_t> count(static_cast<std::size_t>(levels));
  for (const std::int32_t level : value) ++count[static_cast<std::size_t>(level)];
  return count;
}

int occupied(const std::vector<std::int64_t>& count) {
  return static_cast<int>(std::count_if(count.begin(), count.end(), [](std::int64_t c) { return c > 0; }));
}

template <class Sample>
Levels integer_levels(const Image& image, int channel) {
  constexpr int kLevels = 1 << (8 * sizeof(Sample));
  const std::vector<Sample> samples = samples_of<Sample>(image, channel);
  Levels levels{.value = Grid<std::int32_t>(image.shape())};
  std::copy(samples.begin(), samples.end(), levels.value.begin());

  const std::vector<std::int64_t> count = histogram(levels.value, kLevels);
  levels.distinct = occupied(count);
  const auto pixels = static_cast<std::int64_t>(samples.size());
  const std::int64_t wanted = std::min<std::int64_t>(pixels, kLevels);
  const std::int64_t least = pixels / wanted;
  levels.is_permutation = levels.distinct == wanted &&
                          std::all_of(count.begin(), count.end(),
                                      [&](std::int64_t c) { return c == 0 || c == least || c == least + 1; });
  return levels;
}

void check_finite(const std::vector<float>& samples, const Image& image, int channel) {
  const auto is_bad = [](float s) { return !std::isfinite(s); };
  const auto first = std::find_if(samples.begin(), samples.end(), is_bad);
  if (first == samples.end()) return;
  const auto index = first - samples.begin();
  const auto [width, height] = image.size;
  fail_input(fmt::format("channel {}", channel),
             fmt::format("{} of {} pixels are NaN or infinite, the first at x {}, y {}{}",
                         std::count_if(first, samples.end(), is_bad), samples.size(), index % width,
                         index / width % height,
                         image.depth > 1 ? fmt::format(", slice {}", index / image.size.area()) : ""),
             "finite samples");
}

/// Sample number i in increasing order of a baked mask of n samples.
float mask_sample(std::size_t i, double n, SampleType type) {
  const double value = (static_cast<double>(i) + 0.5) / n;
  return type == SampleType::f16 ? texture::half_value(texture::half_bits(value)) : static_cast<float>(value);
}

bool spread_like_a_mask(std::vector<float> samples, SampleType type) {
  std::sort(samples.begin(), samples.end());
  if (std::adjacent_find(samples.begin(), samples.end()) == samples.end()) return true;
  // Beyond 2^24 pixels neighbouring ranks share a float, beyond 2^11 a half float; a baked mask is known by
  // its exact samples.
  const auto n = static_cast<double>(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i] != mask_sample(i, n, type)) return false;
  }
  return true;
}

Levels float_levels(const Image& image, int channel) {
  std::vector<float> samples = floats_of(image, channel);
  check_finite(samples, image, channel);
  const auto [least, greatest] = std::minmax_element(samples.begin(), samples.end());
  Levels levels{.value = Grid<std::int32_t>(image.shape()), .offset = *least};
  const double range = double{*greatest} - double{*least};
  if (range > 0.0) levels.unit = range / (kFloatLevels - 1);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double level = std::floor((samples[i] - levels.offset) / levels.unit + 0.5);
    levels.value[i] = static_cast<std::int32_t>(std::clamp(level, 0.0, double{kFloatLevels - 1}));
    levels.rounding_error = std::max(levels.rounding_error,
                                     std::fabs(samples[i] - (levels.offset + levels.unit * levels.value[i])));
  }
  levels.distinct = occupied(histogram(levels.value, kFloatLevels));
  levels.is_permutation = spread_like_a_mask(std::move(samples), image.type);
  return levels;
}

void check_channel(const Image& image, int channel, std::string_view where) {
  texture::check_image(image, where);
  if (channel < 0 || channel >= image.channels) {
    fail_input("channel", fmt::format("the image has no channel {}", channel),
               fmt::format("0..{}", image.channels - 1));
  }
}

template <class Sample>
std::vector<double> doubles_of(const Image& image, int channel) {
  const std::vector<Sample> samples = samples_of<Sample>(image, channel);
  return {samples.begin(), samples.end()};
}

}  // namespace

ChannelSamples samples_of_channel(const Image& image, int channel) {
  check_channel(image, channel, "samples_of_channel");
  switch (image.type) {
    case SampleType::u8:
      return {doubles_of<std::uint8_t>(image, channel), 0.0, 256.0};
    case SampleType::u16:
      return {doubles_of<std::uint16_t>(image, channel), 0.0, 65536.0};
    case SampleType::f32:
    case SampleType::f16:
      break;
  }
  const std::vector<float> floats = floats_of(image, channel);
  ChannelSamples samples{{floats.begin(), floats.end()}};
  const auto [least, greatest] = std::minmax_element(samples.value.begin(), samples.value.end());
  if (*least < 0.0 || *greatest > 1.0) {
    samples.low = *least;
    samples.high = *greatest;
  }
  return samples;
}

void append_samples(ChannelSamples& stack, const ChannelSamples& next) {
  if (stack.value.empty()) {
    stack = next;
    return;
  }
  stack.value.insert(stack.value.end(), next.value.begin(), next.value.end());
  stack.low = std::min(stack.low, next.low);
  stack.high = std::max(stack.high, next.high);
}

Levels levels_of_channel(const Image& image, int channel) {
  check_channel(image, channel, "levels_of_channel");
  switch (image.type) {
    case SampleType::u8:
      return integer_levels<std::uint8_t>(image, channel);
    case SampleType::u16:
      return integer_levels<std::uint16_t>(image, channel);
    case SampleType::f32:
    case SampleType::f16:
      break;
  }
  return float_levels(image, channel);
}

}  // namespace bn
