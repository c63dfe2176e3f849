// Pictures, metadata and folders that the texture tests share.

#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bn/error.h"
#include "bn/random.h"
#include "bn/texture.h"
#include "texture/image.h"

namespace bn::texture {

/// An empty folder of the test's own, gone with it. In memory where there is such a file system: on a
/// disk the flushing of hundreds of small files takes most of the time.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    const std::filesystem::path memory = "/dev/shm", base = ::access(memory.c_str(), W_OK | X_OK) == 0
                                                                ? memory
                                                                : std::filesystem::temp_directory_path();
    std::string name = (base / "bn-texture-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }
  /// Names in it, sorted.
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
      names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  std::filesystem::path path_;
};

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void put_bytes(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// A picture of random samples; the floats are of every size and sign, and finite.
inline Image random_image(Shape shape, int channels, SampleType type, std::uint64_t seed = 1) {
  Image image{.size = shape.slice(),
              .depth = shape.depth,
              .channels = channels,
              .type = type,
              .samples = std::vector<std::byte>(sample_bytes(shape, channels, type))};
  for (std::size_t i = 0; i < image.samples.size(); ++i) {
    image.samples[i] = static_cast<std::byte>(random_bits(seed, 0, i) & 0xff);
  }
  if (type == SampleType::f32) {
    for (std::size_t i = 3; i < image.samples.size(); i += 4) {
      // An exponent below 255: finite.
      if ((image.samples[i] & std::byte{0x7f}) == std::byte{0x7f}) image.samples[i] &= std::byte{0xbf};
    }
  }
  if (type == SampleType::f16) {
    for (std::size_t i = 1; i < image.samples.size(); i += 2) {
      if ((image.samples[i] & std::byte{0x7c}) == std::byte{0x7c}) image.samples[i] &= std::byte{0xbf};
    }
  }
  return image;
}

template <class Sample>
Image image_of(Extent size, int channels, SampleType type, const std::vector<Sample>& samples) {
  Image image{.size = size,
              .channels = channels,
              .type = type,
              .samples = std::vector<std::byte>(samples.size() * sizeof(Sample))};
  std::memcpy(image.samples.data(), samples.data(), image.samples.size());
  return image;
}

template <class Sample>
std::vector<Sample> samples_of(const Image& image) {
  std::vector<Sample> samples(image.samples.size() / sizeof(Sample));
  std::memcpy(samples.data(), image.samples.data(), image.samples.size());
  return samples;
}

inline bool same_picture(const Image& a, const Image& b) {
  return a.shape() == b.shape() && a.channels == b.channels && a.type == b.type && a.samples == b.samples;
}

/// Every member in use, and every character that a container could spoil.
inline Metadata full_metadata() {
  Metadata metadata;
  metadata.algorithm = "retarget-exact";
  metadata.algorithm_version = 3;
  metadata.kind = "retarget-atlas";
  metadata.recipe =
      "# two\nlines,\t\"quotes\" \\ back */ /* // \r\n and \u00e4\u00f6 \u2713 \U0001F600 \x01\x7f ?\?/ %s\n";
  metadata.facts.add("seed", std::numeric_limits<std::int64_t>::max());
  metadata.facts.add("step", Offset{49, -37});
  metadata.facts.add("radius", 6);
  metadata.facts.add("reach", "chebyshev");
  metadata.facts.add("metric", "l1");
  metadata.facts.add("wrap", Value(false));
  metadata.facts.add("form", "gather");
  metadata.facts.add("source", "masks/a b.png");
  metadata.facts.add("source_channel", 2);
  metadata.facts.add("source_hash", "xxh3-128:00112233445566778899aabbccddeeff");
  for (int y = -4; y <= 4; ++y) {
    for (int x = -4; x <= 4; ++x) {
      metadata.tiles.push_back(
          {.motion = {x, y}, .start_energy = 348180 + x, .energy = std::int64_t{1} << 60, .lower_bound = -y});
    }
  }
  return metadata;
}

/// What `function` throws, or nothing.
template <class Function>
std::optional<ErrorInfo> error_of(Function function) {
  try {
    function();
  } catch (const Error& error) {
    return error.info();
  }
  return std::nullopt;
}

template <class Function>
void expect_error(ErrorCode code, Function function) {
  const auto info = error_of(function);
  ASSERT_TRUE(info.has_value()) << "nothing was thrown";
  EXPECT_EQ(static_cast<int>(info->code), static_cast<int>(code)) << info->what;
}

}  // namespace bn::texture
