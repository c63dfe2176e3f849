// Protects: no bytes crash the reader, make it hang, make it print, or make it take memory that the
// limits do not allow; and the answer to a bad file is a bn::Error with the right code.
#include <sys/stat.h>

#include "bn/error.h"
#include "bn/random.h"
#include "texture/codec.h"
#include "texture/fixtures.h"

namespace bn::texture {
namespace {

Bytes valid_file(const std::string& name) {
  Metadata metadata;
  metadata.recipe = "x = 1\n";
  const Image image = [&] {
    switch (name[0]) {
      case 'f':
        return random_image({5, 4}, 2, SampleType::f32);
      case 'w':
        return random_image({5, 4}, name.ends_with(".dds") ? 4 : 3, SampleType::u16);
      case 'v':
        return random_image({5, 4, 3}, 2, name.ends_with(".exr") ? SampleType::f32 : SampleType::u8);
      default:
        return random_image({5, 4}, name.ends_with(".dds") ? 4 : 3, SampleType::u8);
    }
  }();
  metadata.pixel_hash = pixel_hash(image);
  return encode(name, image, metadata);
}

const std::vector<std::string> kFiles = {"b.png",  "w.png", "f.exr", "b.tif", "w.tif", "f.tif",  "b.bin",
                                         "f.bin",  "v.bin", "b.h",   "f.h",   "v.h",   "b.ktx2", "f.ktx2",
                                         "v.ktx2", "b.dds", "w.dds", "v.dds", "v.exr"};

/// Decodes; true if an image came out. Anything but a bn::Error fails the test.
bool survives(const Bytes& bytes, const Execution& execution = {.memory_limit_bytes = 64 << 20}) {
  try {
    const Decoded decoded = decode(std::as_bytes(std::span(bytes)), "hostile", execution);
    check_image(decoded.image, "decoded");
    return true;
  } catch (const Error& error) {
    EXPECT_TRUE(error.code() == ErrorCode::invalid_input || error.code() == ErrorCode::over_limit)
        << error.what();
    EXPECT_EQ(error.info().where, "hostile");
    return false;
  }
}

std::optional<ErrorInfo> error_for(const Bytes& bytes, const Execution& execution = {}) {
  return error_of([&] { decode(std::as_bytes(std::span(bytes)), "hostile", execution); });
}

class Hostile : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { testing::internal::CaptureStderr(); }
  void TearDown() override { EXPECT_EQ(testing::internal::GetCapturedStderr(), ""); }
};
INSTANTIATE_TEST_SUITE_P(Files, Hostile, testing::ValuesIn(kFiles), [](const auto& test) {
  std::string name = test.param;
  name[1] = '_';
  return name;
});

TEST_P(Hostile, EveryPrefix) {
  const Bytes whole = valid_file(GetParam());
  ASSERT_TRUE(survives(whole));
  int accepted = 0;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    accepted += survives({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)});
  }
  // PNG and .bin know their end. The last lines of a .h say nothing; EXR and TIFF may end in padding.
  const std::string& name = GetParam();
  const int allowed = name.ends_with(".h") ? 30 : name.ends_with(".tif") ? 8 : 0;
  EXPECT_LE(accepted, allowed);
}

TEST_P(Hostile, EveryByteDamaged) {
  const Bytes whole = valid_file(GetParam());
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int damage : {0xff, 0x01, 0x80, 0x20}) {
      Bytes damaged = whole;
      damaged[at] = static_cast<unsigned char>(damaged[at] ^ damage);
      survives(damaged);
    }
  }
}

TEST_P(Hostile, EveryBitOfTheHeaderFlipped) {
  const Bytes whole = valid_file(GetParam());
  for (std::size_t bit = 0; bit < 8 * std::min<std::size_t>(256, whole.size()); ++bit) {
    Bytes damaged = whole;
    damaged[bit / 8] = static_cast<unsigned char>(damaged[bit / 8] ^ 1u << bit % 8);
    survives(damaged);
  }
}

TEST_P(Hostile, AFewBytesDamagedAtOnce) {
  const Bytes whole = valid_file(GetParam());
  for (std::uint64_t round = 0; round < 300; ++round) {
    Bytes damaged = whole;
    for (std::uint64_t i = 0; i < 4; ++i) {
      const std::uint64_t bits = random_bits(7, 0, round * 4 + i);
      damaged[bits % damaged.size()] = static_cast<unsigned char>(bits >> 56);
    }
    survives(damaged);
  }
}

TEST_P(Hostile, TrailingBytesDoNoHarm) {
  Bytes longer = valid_file(GetParam());
  longer.insert(longer.end(), 1000, 0);
  survives(longer);
}

std::uint32_t png_crc(const unsigned char* bytes, std::size_t count) {
  std::uint32_t crc = ~0u;
  for (std::size_t i = 0; i < count; ++i) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320u : 0u);
  }
  return ~crc;
}

void put_big_endian(Bytes& bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i)
    bytes[at + i] = static_cast<unsigned char>((value >> (24 - 8 * i)) & 0xff);
}

/// A PNG whose header says something else than its data, with a right checksum.
Bytes forged_png(std::uint32_t width, std::uint32_t height) {
  Bytes bytes = valid_file("b.png");
  put_big_endian(bytes, 16, width);
  put_big_endian(bytes, 20, height);
  put_big_endian(bytes, 29, png_crc(bytes.data() + 12, 17));
  return bytes;
}

TEST(HostileHeader, PngSizes) {
  testing::internal::CaptureStderr();
  EXPECT_TRUE(survives(forged_png(5, 4))) << "the forging itself is right";
  for (const auto& [width, height] : {std::pair{0x7fffffffu, 0x7fffffffu},
                                      {0xffffffffu, 4u},
                                      {0u, 4u},
                                      {5u, 0u},
                                      {65537u, 1u},
                                      {1u, 65537u},
                                      {65536u, 65536u},
                                      {5u, 5u}}) {
    const auto error = error_for(forged_png(width, height), {.memory_limit_bytes = std::uint64_t{1} << 40});
    ASSERT_TRUE(error.has_value()) << width << "x" << height;
    EXPECT_EQ(error->code, ErrorCode::invalid_input) << error->what;
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

/// Replaces the 16 or 32 bit value of a tag in the first directory of a little-endian TIFF.
Bytes forged_tiff(std::uint16_t tag, std::uint32_t value) {
  Bytes bytes = valid_file("b.tif");
  const auto u16 = [&](std::size_t at) { return static_cast<unsigned>(bytes[at] | bytes[at + 1] << 8); };
  const std::size_t directory = u16(4) | u16(6) << 16;
  bool found = false;
  for (unsigned i = 0; i < u16(directory); ++i) {
    const std::size_t entry = directory + 2 + 12 * i;
    if (u16(entry) != tag) continue;
    found = true;
    bytes[entry + 2] = 4;  // LONG
    for (std::size_t k = 0; k < 4; ++k) bytes[entry + 8 + k] = static_cast<unsigned char>(value >> 8 * k);
  }
  EXPECT_TRUE(found) << "tag " << tag;
  return bytes;
}

TEST(HostileHeader, TiffSizes) {
  testing::internal::CaptureStderr();
  constexpr std::uint16_t kWidth = 256, kHeight = 257, kRowsPerStrip = 278;
  EXPECT_TRUE(survives(forged_tiff(kWidth, 5)));
  for (const std::uint16_t tag : {kWidth, kHeight}) {
    for (const std::uint32_t value : {0u, 65537u, 0x7fffffffu, 0xffffffffu}) {
      const auto error = error_for(forged_tiff(tag, value));
      ASSERT_TRUE(error.has_value()) << tag << " " << value;
      EXPECT_EQ(error->code, ErrorCode::invalid_input) << error->what;
    }
    survives(forged_tiff(tag, 65536));
  }
  for (const std::uint32_t value : {0u, 1u, 0x7fffffffu, 0xffffffffu})
    survives(forged_tiff(kRowsPerStrip, value));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(HostileHeader, ExrSizes) {
  testing::internal::CaptureStderr();
  const Bytes whole = valid_file("f.exr");
  const std::string_view text(reinterpret_cast<const char*>(whole.data()), whole.size());
  const std::size_t window = text.find(std::string_view("dataWindow\0box2i\0", 17)) + 17 + 4;
  for (const std::uint32_t corner :
       {0u, 65535u, 65536u, 0x7ffffffeu, 0x7fffffffu, 0x80000000u, 0xffffffffu}) {
    for (const std::size_t member : {0u, 4u, 8u, 12u}) {
      Bytes forged = whole;
      std::memcpy(forged.data() + window + member, &corner, 4);
      survives(forged);
      std::memcpy(forged.data() + window + (member ^ 4), &corner, 4);
      survives(forged);
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(HostileHeader, ExrAttributeLengths) {
  const Bytes whole = valid_file("f.exr");
  const std::string_view text(reinterpret_cast<const char*>(whole.data()), whole.size());
  for (const std::string_view attribute :
       {std::string_view("comments\0string\0", 16), std::string_view("channels\0chlist\0", 16),
        std::string_view("pixelAspectRatio\0float\0", 23)}) {
    const std::size_t length = text.find(attribute) + attribute.size();
    for (const std::uint32_t value : {0x7fffffffu, 0xffffffffu, 0x40000000u, 10000u}) {
      Bytes forged = whole;
      std::memcpy(forged.data() + length, &value, 4);
      EXPECT_FALSE(survives(forged));
    }
  }
}

TEST(HostileHeader, ExrTypesThatEndElsewhereThanTheirLength) {
  // OpenEXR reads a box of 16 bytes whatever its length says; what follows would be taken for the next
  // attribute, with a length of gigabytes.
  Bytes forged = valid_file("f.exr");
  const std::string_view text(reinterpret_cast<const char*>(forged.data()), forged.size());
  const std::size_t length = text.find(std::string_view("box2i\0", 6)) + 6;
  forged[length] = 20;
  forged.insert(forged.begin() + static_cast<std::ptrdiff_t>(length) + 4 + 16, 4, 'x');
  const auto error = error_for(forged);
  ASSERT_TRUE(error.has_value());
  EXPECT_NE(error->what.find("header"), std::string::npos) << error->what;
}

TEST(HostileHeader, ExrSampleTypes) {
  // OpenImageIO aborts at a type that OpenEXR does not have.
  const Bytes whole = valid_file("f.exr");
  const std::string_view text(reinterpret_cast<const char*>(whole.data()), whole.size());
  // Behind the value's length the name of the first channel, one letter.
  const std::size_t type = text.find(std::string_view("channels\0chlist\0", 16)) + 16 + 4 + 2;
  for (const std::uint32_t value : {3u, 4u, 0x80000000u, 0xffffffffu}) {
    Bytes forged = whole;
    std::memcpy(forged.data() + type, &value, 4);
    EXPECT_FALSE(survives(forged)) << value;
  }
}

TEST(HostileHeader, BinSizes) {
  for (const std::size_t member : {8u, 12u, 16u, 20u, 24u, 28u, 32u, 36u, 40u, 44u}) {
    for (const std::uint32_t value : {0u, 4u, 7u, 0x7fffffffu, 0xffffffffu}) {
      Bytes forged = valid_file("b.bin");
      std::uint32_t old = 0;
      std::memcpy(&old, forged.data() + member, 4);
      if (old == value) continue;
      std::memcpy(forged.data() + member, &value, 4);
      EXPECT_FALSE(survives(forged)) << member << " " << value;
    }
  }
}

TEST(HostileHeader, CHeaderSizes) {
  const Bytes whole = valid_file("b.h");
  const std::string text(whole.begin(), whole.end());
  for (const char* sizes : {"[4][5][65]", "[0][5][3]", "[65537][5][3]", "[4][5][4]", "[5][5][3]", "[3][5][3]",
                            "[4][5]", "[65536][65536][64]", "[-4][5][3]", "[99999999999][5][3]"}) {
    std::string forged = text;
    forged.replace(forged.find("[4][5][3]"), 9, sizes);
    EXPECT_FALSE(survives({forged.begin(), forged.end()})) << sizes;
  }
}

TEST(HostileFile, WhatIsNoRegularFileIsRefusedAtOnce) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe.png").c_str(), 0600), 0);
  put_bytes(folder / "empty.png", "");
  put_bytes(folder / "text.png", "hello");
  put_bytes(folder / "text.txt", "hello");
  put_bytes(folder / "text.tga", "hello");
  put_bytes(folder / "none", "hello");
  std::filesystem::create_symlink(folder / "loop", folder / "loop");
  for (const char* name : {"pipe.png", "missing.png", "loop", "empty.png/x"}) {
    expect_error(ErrorCode::io, [&] { read_image(folder / name); });
  }
  expect_error(ErrorCode::io, [&] { read_image(folder.path()); });
  expect_error(ErrorCode::io, [] { read_image("/dev/zero"); });
  expect_error(ErrorCode::io, [] { read_image(""); });
  for (const char* name : {"empty.png", "text.png", "text.txt", "text.tga", "none"}) {
    expect_error(ErrorCode::invalid_input, [&] { read_image(folder / name); });
  }
}

TEST(HostileFile, TheMemoryLimitHoldsBeforeDecoding) {
  for (const std::string& name : kFiles) {
    const Bytes bytes = valid_file(name);
    const auto error = error_for(bytes, {.memory_limit_bytes = bytes.size() + 10});
    ASSERT_TRUE(error.has_value()) << name;
    EXPECT_EQ(error->code, ErrorCode::over_limit) << name;
    const std::size_t largest = name == "v.exr" ? 480 : 160;  // samples of such a file
    EXPECT_FALSE(error_for(bytes, {.memory_limit_bytes = bytes.size() + largest}).has_value()) << name;
  }
  const TemporaryFolder folder;
  put_bytes(folder / "a.bin", std::string(1000, 'x'));
  expect_error(ErrorCode::over_limit, [&] { read_image(folder / "a.bin", {.memory_limit_bytes = 999}); });
}

TEST(HostileFile, AStopIsHonoured) {
  std::stop_source source;
  source.request_stop();
  for (const std::string name : {"b.png", "b.tif", "f.exr"}) {
    const auto error = error_for(valid_file(name), {.stop = source.get_token()});
    ASSERT_TRUE(error.has_value()) << name;
    EXPECT_EQ(error->code, ErrorCode::cancelled);
  }
}

}  // namespace
}  // namespace bn::texture
