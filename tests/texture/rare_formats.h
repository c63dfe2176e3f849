// What the tests of formats that other programs write have alike.

#pragma once

#include "bn/error.h"
#include "texture/codec.h"
#include "texture/fixtures.h"

namespace bn::texture {

inline Bytes bytes_from(std::string_view text) { return {text.begin(), text.end()}; }
inline Decoded decoded(const Bytes& bytes) { return decode(std::as_bytes(std::span(bytes)), "rare", {}); }
inline std::string refusal_of(const Bytes& bytes) {
  const auto error = error_of([&] { decoded(bytes); });
  if (!error) return "nothing was thrown";
  EXPECT_EQ(error->code, ErrorCode::invalid_input);
  return error->what;
}

inline void expect_text(const std::string& text, std::string_view part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

template <class Sample>
void expect_samples(const Image& image, SampleType type, const std::vector<Sample>& samples) {
  EXPECT_EQ(image.type, type);
  EXPECT_EQ(samples_of<Sample>(image), samples);
}

/// Every prefix and every damaged byte: an image or a bn::Error.
inline void expect_survival(const Bytes& whole) {
  const auto try_it = [](const Bytes& bytes) {
    try {
      const Decoded read = decode(std::as_bytes(std::span(bytes)), "rare", {.memory_limit_bytes = 64 << 20});
      check_image(read.image, "decoded");
      return true;
    } catch (const Error& error) {
      EXPECT_TRUE(error.code() == ErrorCode::invalid_input || error.code() == ErrorCode::over_limit)
          << error.what();
      return false;
    }
  };
  ASSERT_TRUE(try_it(whole));
  for (std::size_t length = 0; length < whole.size(); ++length)
    try_it({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)});
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int damage : {0xff, 0x01, 0x80}) {
      Bytes damaged = whole;
      damaged[at] = static_cast<unsigned char>(damaged[at] ^ damage);
      try_it(damaged);
    }
  }
}

/// A file whose samples are 64x64 pixels.
inline void expect_memory_limit(const Bytes& file) {
  const auto error = error_of(
      [&] { decode(std::as_bytes(std::span(file)), "rare", {.memory_limit_bytes = file.size() + 1000}); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code, ErrorCode::over_limit) << error->what;
}

}  // namespace bn::texture
