#include <array>
#include <utility>

#include "bn/noise.h"
#include "bn/offsets.h"
#include "bn/random.h"
#include "bn/spatiotemporal.h"
#include "bn_study/convergence_study.h"

namespace bn {
namespace {

constexpr std::uint32_t kWhiteStream = 90;  // of random_bits, and the next

Grid<float> white_noise(Shape shape, std::uint64_t seed, std::uint32_t stream) {
  Grid<float> samples(shape);
  for (std::size_t i = 0; i < samples.count(); ++i)
    samples[i] = static_cast<float>(random_bits(seed, stream, i) >> 40) * 0x1p-24f;
  return samples;
}

Grid<float> blue_mask(Extent size, std::uint64_t seed, const Execution& execution) {
  return samples_of_ranks(void_and_cluster({.size = size, .seed = seed}, execution));
}

/// value(x, y, frame) everywhere.
template <class Value>
Grid<float> volume_of(Shape shape, const Value& value) {
  Grid<float> samples(shape);
  for (int frame = 0; frame < shape.depth; ++frame) {
    float* to = samples.slice(frame).data();
    for (int y = 0; y < shape.height; ++y) {
      for (int x = 0; x < shape.width; ++x) *to++ = value(x, y, frame);
    }
  }
  return samples;
}

/// A mask moved on by an offset a frame.
template <class OffsetOf>
Grid<float> rotated_by(const Grid<float>& mask, int frames, const OffsetOf& offset_of) {
  return volume_of({mask.width(), mask.height(), frames}, [&](int x, int y, int frame) {
    return rotated(mask(x, y), offset_of(static_cast<std::uint32_t>(frame)));
  });
}

Grid<float> shifted_by_frame(const Grid<float>& mask, int frames) {
  return volume_of({mask.width(), mask.height(), frames}, [&](int x, int y, int frame) {
    const Offset by = r2_shift(static_cast<std::uint32_t>(frame), mask.size());
    return mask(wrap(x + by.x, mask.width()), wrap(y + by.y, mask.height()));
  });
}

std::uint32_t radical_inverse(std::uint32_t i, std::uint32_t base) {
  double value = 0.0, digit = 1.0 / base;
  for (; i > 0; i /= base, digit /= base) value += digit * (i % base);
  return static_cast<std::uint32_t>(value * 0x1p32);
}

/// The second dimension of Sobol's sequence: its direction numbers are the rows of Pascal's triangle
/// modulo 2.
std::uint32_t sobol_second(std::uint32_t i) {
  std::uint32_t value = 0;
  for (std::uint32_t direction = 1u << 31; i > 0; i >>= 1, direction ^= direction >> 1)
    value ^= (i & 1) != 0 ? direction : 0;
  return value;
}

}  // namespace

SampleSource source_of_stack(std::string name, Grid<float> samples) {
  const Offset far = sample_shifts(2, samples.size())[1];
  Grid<float> second = volume_of(samples.shape(), [&](int x, int y, int frame) {
    const int at = wrap(x + far.x, samples.width()), row = wrap(y + far.y, samples.height());
    return samples.slice(frame)[static_cast<std::size_t>(row * samples.width() + at)];
  });
  return {std::move(name), std::move(samples), std::move(second)};
}

std::vector<SampleSource> sample_sources(Shape size, std::uint64_t seed, const Execution& execution) {
  std::vector<SampleSource> sources{
      {"white noise", white_noise(size, seed, kWhiteStream), white_noise(size, seed, kWhiteStream + 1)}};
  const Grid<float> mask = blue_mask(size.slice(), seed, execution);
  const Grid<float> other = blue_mask(size.slice(), seed + 1, execution);
  const int frames = size.depth;
  sources.push_back({"shifted mask", shifted_by_frame(mask, frames), shifted_by_frame(other, frames)});
  sources.push_back({"golden-ratio mask", rotated_by(mask, frames, golden_offset),
                     rotated_by(other, frames, sqrt2_offset)});
  const auto add = [&](const char* name, auto first, auto second) {
    sources.push_back({name, rotated_by(mask, frames, first), rotated_by(other, frames, second)});
  };
  add(
      "rotated R2", [](auto i) { return r2_offset(i)[0]; }, [](auto i) { return r2_offset(i)[1]; });
  add(
      "rotated Halton", [](auto i) { return radical_inverse(i, 2); },
      [](auto i) { return radical_inverse(i, 3); });
  add(
      "rotated Sobol", [](auto i) { return radical_inverse(i, 2); }, sobol_second);
  for (const auto preset :
       {SpatiotemporalPreset::stbn, SpatiotemporalPreset::filtered, SpatiotemporalPreset::both}) {
    sources.push_back(source_of_stack(
        std::string(name_of(preset)),
        samples_of_ranks(spatiotemporal_mask({.size = size, .preset = preset, .seed = seed}, execution))));
  }
  return sources;
}

}  // namespace bn
