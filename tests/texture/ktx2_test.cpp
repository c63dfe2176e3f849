// Protects: KTX2 files are those of the specification, byte by byte, so every engine's loader takes them; a
// file of another tool is read; and what a header claims falsely is refused before anything is done with it.
#include <bit>

#include "bn/volume.h"
#include "texture/codec.h"
#include "texture/fixtures.h"

namespace bn::texture {
namespace {

std::uint32_t word(const Bytes& bytes, std::size_t at) {
  std::uint32_t value;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}
std::uint64_t long_word(const Bytes& bytes, std::size_t at) {
  return word(bytes, at) | std::uint64_t{word(bytes, at + 4)} << 32;
}
void set_word(Bytes& bytes, std::size_t at, std::uint32_t value) {
  std::memcpy(bytes.data() + at, &value, 4);
}

Bytes file(const Image& image, SliceKind kind = SliceKind::layers) {
  Metadata metadata;
  metadata.tool_version = "1.2.3";
  metadata.pixel_hash = pixel_hash(image);
  return encode("a.ktx2", image, metadata, kind);
}

Decoded decoded(const Bytes& bytes) { return decode(std::as_bytes(std::span(bytes)), "a.ktx2", {}); }

std::optional<ErrorInfo> error_for(const Bytes& bytes) {
  return error_of([&] { decoded(bytes); });
}

// Offsets in the header, from the specification's section 2 and 3.
constexpr std::size_t kVkFormat = 12, kTypeSize = 16, kWidth = 20, kHeight = 24, kDepth = 28, kLayers = 32,
                      kFaces = 36, kLevels = 40, kScheme = 44, kDfdOffset = 48, kDfdLength = 52,
                      kKvdOffset = 56, kKvdLength = 60, kSgdOffset = 64, kSgdLength = 72, kLevelOffset = 80,
                      kLevelLength = 88, kUncompressed = 96, kDfd = 104;

TEST(Ktx2, GoldenBytes) {
  // Two texels of two channels of 16 bits, worked out by hand from the specification.
  const Image image = image_of<std::uint16_t>({2, 1}, 2, SampleType::u16, {1, 2, 3, 0xabcd});
  const Bytes bytes = file(image);
  const unsigned char head[] = {0xAB, 0x4B, 0x54, 0x58, 0x20, 0x32, 0x30, 0xBB,
                                0x0D, 0x0A, 0x1A, 0x0A,                       // the identifier
                                77,   0,    0,    0,                          // VK_FORMAT_R16G16_UNORM
                                2,    0,    0,    0,                          // typeSize
                                2,    0,    0,    0,    1,    0,    0,    0,  // pixelWidth, pixelHeight
                                0,    0,    0,    0,    0,    0,    0,    0,  // pixelDepth, layerCount
                                1,    0,    0,    0,    1,    0,    0,    0,  // faceCount, levelCount
                                0,    0,    0,    0,                          // supercompressionScheme
                                104,  0,    0,    0,    60,   0,    0,    0,  // dfdByteOffset, dfdByteLength
                                164,  0,    0,    0};                         // kvdByteOffset
  ASSERT_GT(bytes.size(), sizeof head);
  EXPECT_EQ(std::memcmp(bytes.data(), head, sizeof head), 0);
  EXPECT_EQ(long_word(bytes, kSgdOffset), 0u);
  EXPECT_EQ(long_word(bytes, kSgdLength), 0u);
  EXPECT_EQ(long_word(bytes, kLevelLength), 8u);
  EXPECT_EQ(long_word(bytes, kUncompressed), 8u);
  const unsigned char descriptor[] = {
      60, 0, 0,  0,              // dfdTotalSize
      0,  0, 0,  0,              // Khronos, basic format
      2,  0, 56, 0,              // version 1.3, size of the block
      1,  0, 1,  0,              // RGBSDA, primaries unspecified, linear, straight alpha
      0,  0, 0,  0,              // blocks of one texel
      4,  0, 0,  0, 0, 0, 0, 0,  // bytes of plane 0
      0,  0, 15, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 0, 0,   // 16 bits from bit 0, red, 0..65535
      16, 0, 15, 1, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 0, 0};  // 16 bits from bit 16, green
  EXPECT_EQ(std::memcmp(bytes.data() + kDfd, descriptor, sizeof descriptor), 0);
  const unsigned char keys[] =
      "\x12\0\0\0KTXorientation\0rd\0\0\0"
      "\x16\0\0\0KTXwriter\0libbn 1.2.3\0\0\0";
  EXPECT_EQ(std::memcmp(bytes.data() + 164, keys, sizeof keys - 1), 0);
  const std::size_t samples = long_word(bytes, kLevelOffset);
  EXPECT_EQ(samples % 4, 0u);
  EXPECT_EQ(samples + 8, bytes.size());
  EXPECT_EQ(std::memcmp(bytes.data() + samples, image.samples.data(), 8), 0);
}

TEST(Ktx2, EveryFormatIsTheVulkanOneAndItsDescriptorSaysTheSame) {
  const std::uint32_t expected[4][4] = {
      {9, 16, 23, 37}, {70, 77, 84, 91}, {100, 103, 106, 109}, {76, 83, 90, 97}};
  for (const SampleType type : {SampleType::u8, SampleType::u16, SampleType::f32, SampleType::f16}) {
    const auto size = static_cast<std::uint32_t>(bytes_per_sample(type));
    const bool is_float = type == SampleType::f32 || type == SampleType::f16;
    for (std::uint32_t channels = 1; channels <= 4; ++channels) {
      const Bytes bytes = file(random_image({3, 5}, static_cast<int>(channels), type));
      EXPECT_EQ(word(bytes, kVkFormat), expected[static_cast<int>(type)][channels - 1]);
      EXPECT_EQ(word(bytes, kTypeSize), size);
      EXPECT_EQ(word(bytes, kDfdLength), 28 + 16 * channels);
      EXPECT_EQ(word(bytes, kDfd), 28 + 16 * channels);
      EXPECT_EQ(word(bytes, kDfd + 20), size * channels) << "bytes of plane 0";
      for (std::uint32_t c = 0; c < channels; ++c) {
        const std::size_t sample = kDfd + 28 + 16 * c;
        const std::uint32_t id = c == 3 ? 15 : c;
        EXPECT_EQ(word(bytes, sample),
                  8 * size * c | (8 * size - 1) << 16 | (id | (is_float ? 0xc0 : 0)) << 24);
        EXPECT_EQ(word(bytes, sample + 8), is_float ? 0xbf800000u : 0u);
        EXPECT_EQ(word(bytes, sample + 12), is_float ? 0x3f800000u : size == 1 ? 255u : 65535u);
      }
      // The samples begin at a multiple of the texel's size and of 4.
      EXPECT_EQ(long_word(bytes, kLevelOffset) % (size * channels), 0u);
      EXPECT_EQ(long_word(bytes, kLevelOffset) % 4, 0u);
    }
  }
}

TEST(Ktx2, SlicesAreLayersOrDepthAsAsked) {
  const Image volume = random_image({3, 2, 5}, 1, SampleType::u8);
  const Bytes array = file(volume, SliceKind::layers), solid = file(volume, SliceKind::depth);
  EXPECT_EQ(word(array, kDepth), 0u);
  EXPECT_EQ(word(array, kLayers), 5u);
  EXPECT_EQ(word(solid, kDepth), 5u);
  EXPECT_EQ(word(solid, kLayers), 0u);
  EXPECT_EQ(decoded(array).slices, SliceKind::layers);
  EXPECT_EQ(decoded(solid).slices, SliceKind::depth);
  EXPECT_TRUE(same_picture(decoded(array).image, volume));
  EXPECT_TRUE(same_picture(decoded(solid).image, volume));
}

TEST(Ktx2, AFileOfAnotherToolIsRead) {
  const std::filesystem::path path =
      std::filesystem::path(BN_REFERENCE) / "ktx2" / "array_rgb8_128x128x32.ktx2";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no reference file";
  const Volume volume = read_volume(path);
  EXPECT_EQ(volume.image.shape(), (Shape{128, 128, 32}));
  EXPECT_EQ(volume.image.channels, 3);
  EXPECT_EQ(volume.image.type, SampleType::u8);
  EXPECT_EQ(volume.slices, SliceKind::layers);
  EXPECT_FALSE(volume.metadata.has_value());
  EXPECT_TRUE(volume.notes.empty());
  const std::string bytes = bytes_of(path);
  EXPECT_EQ(std::memcmp(volume.image.samples.data(), bytes.data() + 228, volume.image.samples.size()), 0);
  // Written again by us, what engines go by is the same but for the colour primaries.
  const Bytes ours = file(volume.image);
  for (std::size_t at = 12; at < 56; at += 4) {
    EXPECT_EQ(word(ours, at), word(Bytes(bytes.begin(), bytes.end()), at)) << at;
  }
}

TEST(Ktx2, WhatOtherToolsWriteIsReadOrRefusedByName) {
  const Image rgba = random_image({4, 4}, 4, SampleType::u8);
  Bytes blue_first = file(rgba);
  set_word(blue_first, kVkFormat, 44);  // B8G8R8A8_UNORM
  const auto swapped = samples_of<std::uint8_t>(decoded(blue_first).image);
  const auto original = samples_of<std::uint8_t>(rgba);
  for (std::size_t i = 0; i < original.size(); i += 4) {
    EXPECT_EQ(swapped[i], original[i + 2]);
    EXPECT_EQ(swapped[i + 1], original[i + 1]);
    EXPECT_EQ(swapped[i + 2], original[i]);
    EXPECT_EQ(swapped[i + 3], original[i + 3]);
  }
  Bytes srgb = file(rgba);
  set_word(srgb, kVkFormat, 43);
  const Decoded as_stored = decoded(srgb);
  EXPECT_TRUE(same_picture(as_stored.image, rgba));
  ASSERT_EQ(as_stored.notes.size(), 1u);
  EXPECT_NE(as_stored.notes[0].find("sRGB"), std::string::npos);

  for (const auto& [at, value, expected] : std::vector<std::tuple<std::size_t, std::uint32_t, std::string>>{
           {kVkFormat, 0, "format 0"},      // Basis Universal
           {kVkFormat, 131, "format 131"},  // BC1
           {kVkFormat, 100, "type of 1"},   // R32_SFLOAT, with another typeSize
           {kScheme, 2, "scheme 2"},        // Zstandard
           {kFaces, 6, "6 faces"},
           {kFaces, 0, "0 faces"},
           {kHeight, 0, "1D"},
           {kLevels, 4, "4 mip levels"},
           {kWidth, 0, "0x4"},
           {kWidth, 70000, "70000x4"},
           {kDepth, 0xffffffffu, "4294967295 slices"},
           {kLayers, 65537, "65537 slices"}}) {
    Bytes bytes = file(rgba);
    set_word(bytes, at, value);
    const auto error = error_for(bytes);
    ASSERT_TRUE(error.has_value()) << at << " " << value;
    EXPECT_EQ(error->code, ErrorCode::invalid_input);
    EXPECT_NE(error->what.find(expected), std::string::npos) << error->what;
  }
  Bytes both = file(rgba);
  set_word(both, kDepth, 1);
  set_word(both, kLayers, 1);
  EXPECT_TRUE(error_for(both).has_value());
}

TEST(Ktx2, MipLevelsBesideTheLargestAreLeftOut) {
  // Levels lie smallest first; the index begins with the largest.
  const Image image = random_image({2, 2}, 1, SampleType::u8);
  Bytes bytes = file(image);
  const std::size_t old_samples = long_word(bytes, kLevelOffset);
  set_word(bytes, kLevels, 2);
  Bytes second(24);
  set_word(second, 0, static_cast<std::uint32_t>(old_samples) + 24);
  second[8] = second[16] = 1;
  bytes.insert(bytes.begin() + kDfd, second.begin(), second.end());
  set_word(bytes, kDfdOffset, word(bytes, kDfdOffset) + 24);
  set_word(bytes, kKvdOffset, word(bytes, kKvdOffset) + 24);
  bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(old_samples) + 24, 4, 0);
  set_word(bytes, kLevelOffset, static_cast<std::uint32_t>(old_samples) + 28);
  const Decoded read = decoded(bytes);
  EXPECT_TRUE(same_picture(read.image, image));
  ASSERT_EQ(read.notes.size(), 1u);
  EXPECT_NE(read.notes[0].find("2 mip levels"), std::string::npos);
}

TEST(Ktx2, OffsetsAndLengthsBeyondTheFileAreRefused) {
  const Bytes whole = file(random_image({4, 4, 2}, 3, SampleType::u8));
  for (const std::size_t at : {kDfdOffset, kDfdLength, kKvdOffset, kKvdLength, kLevelOffset, kLevelOffset + 4,
                               kLevelLength, kLevelLength + 4, kUncompressed, kUncompressed + 4}) {
    for (const std::uint32_t value : {1u, 79u, 0x7fffffffu, 0xfffffffcu, 0xffffffffu}) {
      Bytes bytes = whole;
      set_word(bytes, at, value);
      const auto error = error_for(bytes);
      ASSERT_TRUE(error.has_value()) << at << " " << value;
      EXPECT_EQ(error->code, ErrorCode::invalid_input) << error->what;
    }
  }
  // The first key's length.
  for (const std::uint32_t value : {0u, 1u, 0x7fffffffu, 0xffffffffu}) {
    Bytes bytes = whole;
    set_word(bytes, word(whole, kKvdOffset), value);
    EXPECT_TRUE(error_for(bytes).has_value()) << value;
  }
  // A descriptor of other texels.
  for (const std::size_t at : {kDfd, kDfd + 4, kDfd + 8, kDfd + 12, kDfd + 20, kDfd + 28}) {
    Bytes bytes = whole;
    set_word(bytes, at, word(whole, at) + 0x00010001u);
    EXPECT_TRUE(error_for(bytes).has_value()) << at;
  }
}

TEST(Ktx2, TheMemoryLimitHoldsBeforeMemoryIsTaken) {
  const Bytes bytes = file(random_image({64, 64}, 4, SampleType::u8));
  const auto error = error_of([&] {
    decode(std::as_bytes(std::span(bytes)), "a.ktx2", {.memory_limit_bytes = bytes.size() + 64 * 64 * 4 - 1});
  });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code, ErrorCode::over_limit);
}

}  // namespace
}  // namespace bn::texture
