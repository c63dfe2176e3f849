// PBM, PGM, PPM and PFM, read as they are stored.
//
// In PGM and PPM a sample is a whole number 0..maxval, and maxval is what the writer calls white: 255, 65535,
// or any other number below 65536. A sample up to 255 is read as 8 bit and a larger range as 16 bit, always
// with the number that is in the file: a reader that spreads 0..100 over 0..255 changes the distances between
// levels, and with them every energy. The note of such a file says its maxval. In PBM the bit 1 means black,
// so it is read as 0, and white as 255. PFM holds floats, the last row first; its scale is noted and not
// applied.
//
// Own code, because the formats are simple and OpenImageIO 2.4 scales the samples of PGM, by a product that
// overflows.

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

#include "texture/codec.h"
#include "texture/error.h"
#include "texture/image.h"

namespace bn::texture {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// What stands between spaces and comments.
class Words {
 public:
  Words(ByteView bytes, const std::string& name)
      : text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()), name_(name) {}

  std::string_view word(const char* what) {
    skip();
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_]) && text_[at_] != '#') ++at_;
    if (at_ == begin) fail_input(name_, fmt::format("cut short: {} is missing", what));
    return text_.substr(begin, at_ - begin);
  }

  std::int64_t number(const char* what) {
    const std::string_view digits = word(what);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size() || value < 0)
      fail_input(name_, fmt::format("{} is no whole number", what));
    return value;
  }

  /// '0' or '1'; no space need stand between two.
  bool bit() {
    skip();
    if (at_ == text_.size()) fail_input(name_, "cut short in its samples");
    const char c = text_[at_++];
    if (c != '0' && c != '1') fail_input(name_, "a sample that is neither 0 nor 1");
    return c == '1';
  }

  /// The place behind the one space that ends a header.
  std::size_t begin_of_samples() {
    if (at_ == text_.size() || !is_space(text_[at_])) fail_input(name_, "cut short in its header");
    return at_ + 1;
  }

 private:
  void skip() {
    while (at_ < text_.size()) {
      if (text_[at_] == '#') {
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      } else if (is_space(text_[at_])) {
        ++at_;
      } else {
        return;
      }
    }
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 2;  // behind the signature
};

/// What the letter or digit of the signature says.
struct Variant {
  int channels = 1;
  bool plain = false;  ///< numbers as text
  bool bits = false;
  bool floats = false;
};

std::optional<Variant> variant_of(char c) {
  switch (c) {
    case '1':
      return Variant{.plain = true, .bits = true};
    case '2':
      return Variant{.plain = true};
    case '3':
      return Variant{.channels = 3, .plain = true};
    case '4':
      return Variant{.bits = true};
    case '5':
      return Variant{};
    case '6':
      return Variant{.channels = 3};
    case 'f':
      return Variant{.floats = true};
    case 'F':
      return Variant{.channels = 3, .floats = true};
    default:
      return std::nullopt;
  }
}

struct Header {
  Variant variant;
  std::int64_t maxval = 1;
  double scale = 1.0;  ///< of PFM; below 0: little-endian
};

template <class Sample>
void put(Image& image, std::size_t i, Sample sample) {
  std::memcpy(image.samples.data() + i * sizeof sample, &sample, sizeof sample);
}

void put_checked(Image& image, std::size_t i, std::int64_t sample, std::int64_t maxval,
                 const std::string& name) {
  if (sample > maxval) {
    fail_input(name, fmt::format("sample {} is {}", i, sample), fmt::format("0..{}, its maxval", maxval),
               "the file is corrupt");
  }
  if (image.type == SampleType::u8) {
    put(image, i, static_cast<std::uint8_t>(sample));
  } else {
    put(image, i, static_cast<std::uint16_t>(sample));
  }
}

void read_plain(const Header& header, Words& words, Image& image, const std::string& name) {
  const std::size_t count = image.samples.size() / bytes_per_sample(image.type);
  for (std::size_t i = 0; i < count; ++i) {
    if (header.variant.bits) {
      put(image, i, static_cast<std::uint8_t>(words.bit() ? 0 : 255));
    } else {
      put_checked(image, i, words.number("a sample"), header.maxval, name);
    }
  }
}

void read_bits(ByteView bytes, Image& image) {
  const auto width = static_cast<std::size_t>(image.size.width);
  const std::size_t row = (width + 7) / 8;
  for (std::size_t i = 0; i < image.samples.size(); ++i) {
    const std::size_t x = i % width, y = i / width;
    const bool black = (bytes[y * row + x / 8] & std::byte{0x80} >> static_cast<int>(x % 8)) != std::byte{0};
    put(image, i, static_cast<std::uint8_t>(black ? 0 : 255));
  }
}

void read_integers(ByteView bytes, std::int64_t maxval, Image& image, const std::string& name) {
  const std::size_t size = bytes_per_sample(image.type);
  for (std::size_t i = 0; i < image.samples.size() / size; ++i) {
    std::int64_t sample = std::to_integer<std::int64_t>(bytes[i * size]);
    if (size == 2) sample = sample << 8 | std::to_integer<std::int64_t>(bytes[i * size + 1]);
    put_checked(image, i, sample, maxval, name);
  }
}

void read_floats(ByteView bytes, bool little_endian, Image& image) {
  const std::size_t row = static_cast<std::size_t>(image.size.width * image.channels) * sizeof(float);
  for (std::size_t y = 0; y < static_cast<std::size_t>(image.size.height); ++y) {
    std::memcpy(image.samples.data() + y * row,
                bytes.data() + (static_cast<std::size_t>(image.size.height) - 1 - y) * row, row);
  }
  static_assert(std::endian::native == std::endian::little);
  if (little_endian) return;
  for (std::size_t i = 0; i < image.samples.size(); i += sizeof(float)) {
    std::reverse(image.samples.begin() + static_cast<std::ptrdiff_t>(i),
                 image.samples.begin() + static_cast<std::ptrdiff_t>(i + sizeof(float)));
  }
}

double scale_of(Words& words, const std::string& name) {
  const std::string text(words.word("its scale"));
  char* end = nullptr;
  const double scale = std::strtod(text.c_str(), &end);
  if (*end != '\0' || !std::isfinite(scale) || scale == 0.0) {
    fail_input(name, "its scale is no number but 0");
  }
  return scale;
}

/// Bytes that the samples take in the file, at the least.
std::uint64_t stored_bytes(const Variant& variant, const Image& image) {
  const std::uint64_t samples = sample_bytes(image.size, image.channels, SampleType::u8);
  if (variant.plain) return variant.bits ? samples : 2 * samples - 1;
  if (variant.bits) {
    return static_cast<std::uint64_t>((image.size.width + 7) / 8) *
           static_cast<std::uint64_t>(image.size.height);
  }
  return samples * bytes_per_sample(image.type);
}

void add_notes(const Header& header, Decoded& decoded) {
  if (header.variant.bits) {
    decoded.notes.emplace_back("a bitmap: black is read as 0 and white as 255");
  } else if (header.variant.floats) {
    if (std::abs(header.scale) != 1.0) {
      decoded.notes.push_back(fmt::format(
          "its scale is {}; the samples are read as they are stored, without it", std::abs(header.scale)));
    }
  } else if (header.maxval != 255 && header.maxval != 65535) {
    decoded.notes.push_back(
        fmt::format("its maxval is {}, so the samples are 0..{} of {}, as they are stored", header.maxval,
                    header.maxval, decoded.image.type == SampleType::u8 ? "0..255" : "0..65535"));
  }
}

}  // namespace

bool is_pnm(ByteView bytes) {
  if (bytes.size() < 3 || bytes[0] != std::byte{'P'}) return false;
  const char after = static_cast<char>(bytes[2]);
  return variant_of(static_cast<char>(bytes[1])).has_value() && (is_space(after) || after == '#');
}

Decoded decode_pnm(ByteView bytes, const std::string& name, const Execution& execution) {
  Header header{.variant = *variant_of(static_cast<char>(bytes[1]))};
  const Variant& variant = header.variant;
  Words words(bytes, name);
  const std::int64_t width = words.number("its width"), height = words.number("its height");
  check_shape(width, height, variant.channels, name);
  if (variant.floats) {
    header.scale = scale_of(words, name);
  } else if (!variant.bits) {
    header.maxval = words.number("its maxval");
    if (header.maxval < 1 || header.maxval > 65535)
      fail_input(name, fmt::format("a maxval of {}", header.maxval), "1..65535");
  }
  Decoded decoded;
  Image& image = decoded.image;
  image.size = {static_cast<int>(width), static_cast<int>(height)};
  image.channels = variant.channels;
  image.type = variant.floats ? SampleType::f32 : header.maxval < 256 ? SampleType::u8 : SampleType::u16;
  const std::size_t begin = words.begin_of_samples();
  const std::uint64_t stored = stored_bytes(variant, image), there = bytes.size() - begin;
  if (there < stored) {
    fail_input(name, fmt::format("cut short: {} bytes of samples where its header needs {}{}", there,
                                 variant.plain ? "at least " : "", stored));
  }
  const std::uint64_t ours = sample_bytes(image.size, image.channels, image.type);
  check_memory(execution, ours + bytes.size(), name);
  throw_if_stopped(execution);
  image.samples.resize(ours);
  const ByteView samples = bytes.subspan(begin);
  if (variant.plain) {
    read_plain(header, words, image, name);
  } else if (variant.bits) {
    read_bits(samples, image);
  } else if (variant.floats) {
    read_floats(samples, header.scale < 0, image);
  } else {
    read_integers(samples, header.maxval, image, name);
  }
  add_notes(header, decoded);
  if (!variant.plain && is_pnm(samples.subspan(stored)))
    decoded.notes.emplace_back("it holds further pictures; the first is read");
  return decoded;
}

}  // namespace bn::texture
