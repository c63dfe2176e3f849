// A texture as a C header: a constant array for programs that have no image reader, valid as C99 and
// C++. A comment says what the channels mean and holds the metadata. What is written here is also read here,
// so that `bn verify` reaches every file; other C is not understood.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string>

#include "texture/codec.h"
#include "texture/error.h"
#include "texture/image.h"

namespace bn::texture {
namespace {

constexpr std::string_view kOpening = "/* Texture written by libbn ";
constexpr std::string_view kMetadataMark = "\nbn-metadata: ";
constexpr std::string_view kCommentEnd = "\n*/\n";
constexpr std::string_view kArrayMark = "\nstatic const ";
constexpr std::string_view kDepthMacro = "_DEPTH ";  // no name of ours ends so but that macro
constexpr std::size_t kLineWidth = 100;

std::string_view c_type(SampleType type) {
  return type == SampleType::u8 ? "uint8_t" : type == SampleType::u16 ? "uint16_t" : "float";
}

/// A C identifier; the prefix keeps it from being a keyword, reserved, or beginning with a digit.
std::string identifier(const std::string& stem) {
  std::string name = fmt::format("bn_{}", stem);
  for (char& c : name) {
    const bool fits = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (!fits) c = '_';
  }
  return name;
}

std::string upper(std::string text) {
  for (char& c : text) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return text;
}

/// JSON that can neither end nor open a comment: a star may be written \u002a.
std::string comment_safe(const std::string& json) {
  std::string safe;
  for (const char c : json) {
    if (c == '*') {
      safe += "\\u002a";
    } else {
      safe += c;
    }
  }
  return safe;
}

template <class Sample>
Sample sample_at(const Image& image, std::size_t index) {
  Sample sample;
  std::memcpy(&sample, image.samples.data() + index * sizeof sample, sizeof sample);
  return sample;
}

/// The literal of sample number `index`; a float reads back as the same float.
std::string_view literal(const Image& image, std::size_t index, std::array<char, 32>& buffer) {
  char* end = buffer.data();
  if (image.type != SampleType::f32) {
    const unsigned value = image.type == SampleType::u8 ? sample_at<std::uint8_t>(image, index)
                                                        : sample_at<std::uint16_t>(image, index);
    end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  } else {
    const auto value = sample_at<float>(image, index);
    end = std::to_chars(buffer.data(), buffer.data() + buffer.size() - 3, value).ptr;
    const bool integer =
        std::all_of(buffer.data(), end, [](char c) { return c == '-' || (c >= '0' && c <= '9'); });
    if (integer) {
      *end++ = '.';
      *end++ = '0';
    }
    *end++ = 'f';
  }
  return {buffer.data(), end};
}

void append_slice(std::string& text, const Image& image, int z) {
  const auto channels = static_cast<std::size_t>(image.channels);
  const auto width = static_cast<std::size_t>(image.size.width);
  const auto height = static_cast<std::size_t>(image.size.height);
  std::array<char, 32> buffer;
  std::string pixel;
  const std::size_t first = static_cast<std::size_t>(z) * height;
  for (std::size_t y = first; y < first + height; ++y) {
    text += "  {";
    std::size_t line_start = text.size() - 3;
    for (std::size_t x = 0; x < width; ++x) {
      pixel.clear();
      if (channels > 1) pixel += '{';
      for (std::size_t c = 0; c < channels; ++c) {
        if (c > 0) pixel += ',';
        pixel += literal(image, (y * width + x) * channels + c, buffer);
      }
      if (channels > 1) pixel += '}';
      if (x > 0) text += ',';
      if (text.size() - line_start + pixel.size() > kLineWidth) {
        text += "\n   ";
        line_start = text.size() - 3;
      }
      text += pixel;
    }
    text += "},\n";
  }
}

/// Reads the array's text: names, numbers and the punctuation between them.
class Scanner {
 public:
  Scanner(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  [[noreturn]] void fail() const { fail_input(name_, "not a .h as libbn writes them: cut short or edited"); }

  void expect(std::string_view token) {
    if (!text_.starts_with(token)) fail();
    text_.remove_prefix(token.size());
  }
  bool skip(std::string_view token) {
    const bool found = text_.starts_with(token);
    if (found) text_.remove_prefix(token.size());
    return found;
  }
  /// Passes everything up to and with `token`, and returns what was before it.
  std::string_view through(std::string_view token) {
    const std::size_t at = text_.find(token);
    if (at == std::string_view::npos) fail();
    const std::string_view before = text_.substr(0, at);
    text_.remove_prefix(at + token.size());
    return before;
  }
  template <class Number>
  Number number() {
    Number value{};
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
    if (error != std::errc{}) fail();
    text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
    return value;
  }
  void skip_punctuation() {
    const std::size_t next = text_.find_first_not_of("{},\n ");
    text_.remove_prefix(next == std::string_view::npos ? text_.size() : next);
  }
  std::size_t left() const { return text_.size(); }

 private:
  std::string_view text_;
  const std::string& name_;
};

template <class Sample>
void read_samples(Scanner& scanner, Image& image) {
  for (std::size_t i = 0; i < image.samples.size() / sizeof(Sample); ++i) {
    scanner.skip_punctuation();
    const auto sample = scanner.number<Sample>();
    if constexpr (std::is_same_v<Sample, float>) {
      scanner.expect("f");
      if (!std::isfinite(sample)) scanner.fail();
    }
    std::memcpy(image.samples.data() + i * sizeof sample, &sample, sizeof sample);
  }
}

}  // namespace

bool is_c_header(ByteView bytes) {
  return bytes.size() >= kOpening.size() && std::memcmp(bytes.data(), kOpening.data(), kOpening.size()) == 0;
}

Bytes encode_c_header(const std::string& stem, const Image& image, const Metadata& metadata) {
  if (image.type == SampleType::f32) {
    for (std::size_t i = 0; i < image.samples.size() / sizeof(float); ++i) {
      if (!std::isfinite(sample_at<float>(image, i))) {
        fail_input(stem + ".h", "NaN or infinite samples, which C has no numbers for", "finite samples",
                   "write .exr, .tif or .bin");
      }
    }
  }
  const std::string name = identifier(stem);
  const std::string macro = upper(name);
  std::string text =
      fmt::format("{}{}: {}x{}{} pixels, channels: {}, {}.\n", kOpening, metadata.tool_version,
                  image.size.width, image.size.height, image.depth > 1 ? fmt::format("x{}", image.depth) : "",
                  image.channels, name_of(image.type));
  text += fmt::format("Origin top-left; {}{}[y][x]{}.\n", name, image.depth > 1 ? "[z]" : "",
                      image.channels > 1 ? "[channel]" : "");
  for (const std::string& sentence : content_description(image, metadata)) text += sentence + "\n";
  text += kMetadataMark;
  text += comment_safe(to_json(metadata, 2));
  text += kCommentEnd;
  text += fmt::format("#ifndef {0}_H\n#define {0}_H\n\n#include <stdint.h>\n\n", macro);
  text += fmt::format("#define {0}_WIDTH {1}\n#define {0}_HEIGHT {2}\n#define {0}_CHANNELS {3}\n", macro,
                      image.size.width, image.size.height, image.channels);
  if (image.depth > 1) text += fmt::format("#define {}{}{}\n", macro, kDepthMacro, image.depth);
  text += kArrayMark;
  text += fmt::format("{} {}", c_type(image.type), name);
  if (image.depth > 1) text += fmt::format("[{}]", image.depth);
  text += fmt::format("[{}][{}]", image.size.height, image.size.width);
  if (image.channels > 1) text += fmt::format("[{}]", image.channels);
  text += " = {\n";
  for (int z = 0; z < image.depth; ++z) {
    if (image.depth > 1) text += " {\n";
    append_slice(text, image, z);
    if (image.depth > 1) text += " },\n";
  }
  text += fmt::format("}};\n\n#endif /* {}_H */\n", macro);
  return {text.begin(), text.end()};
}

Decoded decode_c_header(ByteView bytes, const std::string& name, const Execution& execution) {
  Scanner scanner({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name);
  Decoded decoded;
  scanner.through(kMetadataMark);
  decoded.description = scanner.through(kCommentEnd);

  Image& image = decoded.image;
  const bool volume = scanner.through(kArrayMark).find(kDepthMacro) != std::string_view::npos;
  const std::string_view type = scanner.through(" ");
  for (const SampleType candidate : {SampleType::u8, SampleType::u16, SampleType::f32}) {
    if (type == c_type(candidate)) image.type = candidate;
  }
  if (type != c_type(image.type)) scanner.fail();
  scanner.through("[");
  const auto depth = volume ? scanner.number<std::uint32_t>() : 1u;
  if (volume) scanner.expect("][");
  const auto height = scanner.number<std::uint32_t>();
  scanner.expect("][");
  const auto width = scanner.number<std::uint32_t>();
  scanner.expect("]");
  const auto channels = scanner.skip("[") ? scanner.number<std::uint32_t>() : 1u;
  if (channels > 1) scanner.expect("]");
  scanner.expect(" = {\n");
  check_shape(width, height, channels, name);
  check_depth(depth, name);
  if (volume && depth == 1) scanner.fail();
  image.size = {static_cast<int>(width), static_cast<int>(height)};
  image.depth = static_cast<int>(depth);
  image.channels = static_cast<int>(channels);

  const std::uint64_t samples_bytes = sample_bytes(image.shape(), image.channels, image.type);
  // A sample takes a digit and a comma at least.
  if (samples_bytes / bytes_per_sample(image.type) > scanner.left() / 2) scanner.fail();
  check_memory(execution, bytes.size() + samples_bytes, name);
  image.samples.resize(samples_bytes);
  switch (image.type) {
    case SampleType::u8:
      read_samples<std::uint8_t>(scanner, image);
      break;
    case SampleType::u16:
      read_samples<std::uint16_t>(scanner, image);
      break;
    case SampleType::f32:
      read_samples<float>(scanner, image);
      break;
    case SampleType::f16:
      scanner.fail();  // C has no such type
  }
  if (image.channels > 1) scanner.expect("}");
  scanner.expect("},\n");
  if (volume) scanner.expect(" },\n");
  scanner.expect("};\n");
  return decoded;
}

}  // namespace bn::texture
