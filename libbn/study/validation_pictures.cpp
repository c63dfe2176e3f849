// The study's pictures: crops of the error side by side, each over its power spectrum, as in the figures of
// Heitz and Belcour 2019.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bn/spectrum.h"
#include "bn/texture.h"
#include "report/sheet.h"
#include "study/validation.h"

namespace bn::study {
namespace {

using Pixel = std::array<std::uint8_t, 3>;
constexpr int kScale = report::kSheetScale, kGap = report::kSheetGap;

std::uint8_t grey(double value) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

/// Squares of one size in rows; what is between them is transparent.
class Sheet {
 public:
  Sheet(int side, int columns, int rows)
      : side_(side), pitch_(side * kScale + kGap), pixels_({columns * pitch_ + kGap, rows * pitch_ + kGap}) {}

  template <class Value>
  void put(int column, int row, const Value& pixel_at) {
    for (int y = 0; y < side_ * kScale; ++y) {
      for (int x = 0; x < side_ * kScale; ++x)
        pixels_(column * pitch_ + kGap + x, row * pitch_ + kGap + y) = pixel_at(x / kScale, y / kScale);
    }
  }

  /// An error, mid grey where there is none; `unit` is its white noise's RMS.
  void put_error(int column, int row, const Grid<float>& error, double unit) {
    put(column, row, [&](int x, int y) {
      const std::uint8_t value = grey(0.5 + error(x, y) / (4.0 * std::max(unit, 1e-12)));
      return Pixel{value, value, value};
    });
  }

  /// Its spectrum, DC in the middle: amplitudes, so that what is dark in it is dark to the eye.
  void put_spectrum(int column, int row, const Grid<float>& error) {
    const std::vector<double> values(error.begin(), error.end());
    const Grid<double> power =
        centred_power(power_spectrum(values, {error.width(), error.height(), 1}, {.threads = 1}));
    put(column, row, [&](int x, int y) {
      const std::uint8_t value = grey(0.5 * std::sqrt(power(x, y)));
      return Pixel{value, value, value};
    });
  }

  void write(const std::filesystem::path& path) const {
    Image image{.size = pixels_.size(), .channels = 4, .type = SampleType::u8, .samples = {}};
    for (const std::optional<Pixel>& pixel : pixels_) {
      for (const std::uint8_t channel : pixel.value_or(Pixel{}))
        image.samples.push_back(static_cast<std::byte>(channel));
      image.samples.push_back(static_cast<std::byte>(pixel ? 255 : 0));
    }
    Metadata metadata;
    metadata.algorithm = "validate";
    metadata.kind = "picture";
    write_image(path, image, metadata);
  }

 private:
  int side_, pitch_;
  Grid<std::optional<Pixel>> pixels_;
};

Pixel unpacked(std::uint32_t shown) {
  return {static_cast<std::uint8_t>(shown & 255u), static_cast<std::uint8_t>(shown >> 8 & 255u),
          static_cast<std::uint8_t>(shown >> 16 & 255u)};
}

void write_frame(const Grid<std::uint32_t>& shown, const std::filesystem::path& path) {
  Image image{.size = shown.size(), .channels = 3, .type = SampleType::u8, .samples = {}};
  for (const std::uint32_t pixel : shown) {
    for (const std::uint8_t channel : unpacked(pixel))
      image.samples.push_back(static_cast<std::byte>(channel));
  }
  Metadata metadata;
  metadata.algorithm = "validate";
  metadata.kind = "picture";
  write_image(path, image, metadata);
}

}  // namespace

void write_pictures(const SceneResult& result, const std::filesystem::path& folder) {
  if (result.sequences.empty()) return;
  const Sequence& first = result.sequences.front();
  const int side = first.last_error.width();
  const double unit = blurred_rms(first.first_errors.front(), 0.0);

  // The first frames, a method two rows.
  std::vector<const Sequence*> temporal;
  for (const Method method : {Method::sort, Method::retarget, Method::reproject}) {
    if (const Sequence* sequence = result.find(name_of(method))) temporal.push_back(sequence);
  }
  if (!temporal.empty()) {
    const auto frames = temporal.front()->first_errors.size();
    Sheet sheet(side, static_cast<int>(frames), 2 * static_cast<int>(temporal.size()));
    for (std::size_t row = 0; row < temporal.size(); ++row) {
      for (std::size_t frame = 0; frame < frames; ++frame) {
        const Grid<float>& error = temporal[row]->first_errors[frame];
        sheet.put_error(static_cast<int>(frame), 2 * static_cast<int>(row), error, unit);
        sheet.put_spectrum(static_cast<int>(frame), 2 * static_cast<int>(row) + 1, error);
      }
    }
    sheet.write(folder / "first-frames.png");
  }

  // The last frame of every method, then of the block sizes: picture, error, spectrum.
  const auto last_frames = [&](const std::vector<const Sequence*>& sequences, const std::string& name) {
    if (sequences.empty()) return;
    Sheet sheet(side, static_cast<int>(sequences.size()), 3);
    for (std::size_t i = 0; i < sequences.size(); ++i) {
      const int column = static_cast<int>(i);
      const Grid<std::uint32_t>& shown = sequences[i]->last_crop;
      sheet.put(column, 0, [&](int x, int y) { return unpacked(shown(x, y)); });
      sheet.put_error(column, 1, sequences[i]->last_error, unit);
      sheet.put_spectrum(column, 2, sequences[i]->last_error);
    }
    sheet.write(folder / name);
  };
  std::vector<const Sequence*> methods, blocks;
  for (const Sequence& sequence : result.sequences) {
    const bool other_block = sequence.variant.name.find("-block-") != std::string::npos;
    if (!other_block) methods.push_back(&sequence);
    if (sequence.variant.method.name() == "retarget" && !sequence.variant.sort_by_light)
      blocks.push_back(&sequence);
  }
  std::sort(blocks.begin(), blocks.end(),
            [](const Sequence* a, const Sequence* b) { return a->variant.block < b->variant.block; });
  last_frames(methods, "methods.png");
  if (blocks.size() > 1) last_frames(blocks, "blocks.png");
  for (const Sequence& sequence : result.sequences)
    write_frame(sequence.last_shown, folder / fmt::format("{}.png", sequence.variant.name));
}

}  // namespace bn::study
