// Protects: DDS files are those of Microsoft's documentation, and another reader sees the same samples; old
// headers are read where they describe plain samples; metadata stay with the file; what a header claims
// falsely is refused.
#include <OpenImageIO/imageio.h>

#include <cstdlib>

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
void set_word(Bytes& bytes, std::size_t at, std::uint32_t value) {
  std::memcpy(bytes.data() + at, &value, 4);
}

Bytes file(const Image& image, SliceKind kind = SliceKind::layers) {
  return encode("a.dds", image, {}, kind);
}

Decoded decoded(const Bytes& bytes) { return decode(std::as_bytes(std::span(bytes)), "a.dds", {}); }

std::optional<ErrorInfo> error_for(const Bytes& bytes) {
  return error_of([&] { decoded(bytes); });
}

constexpr std::size_t kSize = 4, kHeight = 12, kWidth = 16, kDepth = 24, kLevels = 28, kFormatFlags = 80,
                      kFourLetters = 84, kBits = 88, kRed = 92, kCaps2 = 112, kDxgi = 128, kDimension = 132,
                      kMisc = 136, kLayers = 140, kAlpha = 144, kSamples = 148;

TEST(Dds, GoldenBytes) {
  const Image image = image_of<std::uint16_t>({2, 1}, 2, SampleType::u16, {1, 2, 3, 0xabcd});
  Bytes expected(kSamples + 8);
  std::memcpy(expected.data(), "DDS ", 4);
  set_word(expected, kSize, 124);
  set_word(expected, 8, 0x100f);  // caps, height, width, pitch, pixel format
  set_word(expected, kHeight, 1);
  set_word(expected, kWidth, 2);
  set_word(expected, 20, 8);  // bytes of a row
  set_word(expected, kLevels, 1);
  set_word(expected, 76, 32);
  set_word(expected, kFormatFlags, 4);
  std::memcpy(expected.data() + kFourLetters, "DX10", 4);
  set_word(expected, 108, 0x1000);  // a texture
  set_word(expected, kDxgi, 35);    // DXGI_FORMAT_R16G16_UNORM
  set_word(expected, kDimension, 3);
  set_word(expected, kLayers, 1);
  std::memcpy(expected.data() + kSamples, image.samples.data(), 8);
  EXPECT_EQ(file(image), expected);
}

TEST(Dds, EveryFormatIsTheDxgiOneAndNeverSrgb) {
  const std::uint32_t expected[4][4] = {{61, 49, 0, 28}, {56, 35, 0, 11}, {41, 16, 6, 2}, {54, 34, 0, 10}};
  for (const SampleType type : {SampleType::u8, SampleType::u16, SampleType::f32, SampleType::f16}) {
    for (int channels = 1; channels <= 4; ++channels) {
      const std::uint32_t format = expected[static_cast<int>(type)][channels - 1];
      const Image image = random_image({3, 5}, channels, type);
      if (format == 0) {
        expect_error(ErrorCode::invalid_input, [&] { file(image); });
        continue;
      }
      const Bytes bytes = file(image);
      EXPECT_EQ(word(bytes, kDxgi), format);
      EXPECT_EQ(word(bytes, kAlpha), channels == 4 ? 1u : 0u) << "straight alpha";
    }
  }
}

TEST(Dds, SlicesAreLayersOrDepthAsAsked) {
  const Image volume = random_image({3, 2, 5}, 1, SampleType::u8);
  const Bytes array = file(volume, SliceKind::layers), solid = file(volume, SliceKind::depth);
  EXPECT_EQ(word(array, kDimension), 3u);
  EXPECT_EQ(word(array, kLayers), 5u);
  EXPECT_EQ(word(array, kDepth), 0u);
  EXPECT_EQ(word(solid, kDimension), 4u);
  EXPECT_EQ(word(solid, kLayers), 1u);
  EXPECT_EQ(word(solid, kDepth), 5u);
  EXPECT_EQ(word(solid, kCaps2), 0x200000u);
  EXPECT_EQ(decoded(array).slices, SliceKind::layers);
  EXPECT_EQ(decoded(solid).slices, SliceKind::depth);
  EXPECT_TRUE(same_picture(decoded(array).image, volume));
  EXPECT_TRUE(same_picture(decoded(solid).image, volume));
}

TEST(Dds, MetadataLieBesideAndFaultsOfTheirsAreNoneOfThePicture) {
  const TemporaryFolder folder;
  const Image image = random_image({4, 3}, 1, SampleType::u8);
  write_image(folder / "a.dds", image, full_metadata());
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.dds", "a.dds.json"}));
  EXPECT_EQ(read_image(folder / "a.dds").metadata->pixel_hash, pixel_hash(image));

  put_bytes(folder / "a.dds.json", "{\"bn_metadata\":1");
  FileContent content = read_image(folder / "a.dds");
  EXPECT_FALSE(content.metadata.has_value());
  EXPECT_NE(content.metadata_fault, "");
  EXPECT_TRUE(same_picture(content.image, image));
  put_bytes(folder / "a.dds.json", std::string(20u << 20, ' ') + "\"bn_metadata\"");
  EXPECT_NE(read_image(folder / "a.dds").metadata_fault, "") << "too long to be ours";
  std::filesystem::remove(folder / "a.dds.json");
  content = read_image(folder / "a.dds");
  EXPECT_FALSE(content.metadata.has_value());
  EXPECT_EQ(content.metadata_fault, "");
}

TEST(Dds, NothingIsWrittenWhereTheMetadataCannotBe) {
  const TemporaryFolder folder;
  const Image image = random_image({4, 3}, 1, SampleType::u8);
  std::filesystem::create_directory(folder / "a.dds.json");
  expect_error(ErrorCode::io, [&] { write_image(folder / "a.dds", image, {}); });
  expect_error(ErrorCode::io, [&] { check_writable(folder / "a.dds", SampleType::u8, 1); });
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.dds.json"}));
}

/// A file as tools of the time of Direct3D 9 write it.
Bytes legacy(std::uint32_t flags, std::uint32_t bits, std::array<std::uint32_t, 4> masks,
             const std::vector<unsigned char>& samples, std::uint32_t width) {
  Bytes bytes(128 + samples.size());
  std::memcpy(bytes.data(), "DDS ", 4);
  set_word(bytes, kSize, 124);
  set_word(bytes, 8, 0x1007);  // caps, height, width, pixel format
  set_word(bytes, kHeight, 1);
  set_word(bytes, kWidth, width);
  set_word(bytes, 76, 32);
  set_word(bytes, 108, 0x1000);  // a texture
  set_word(bytes, kFormatFlags, flags);
  set_word(bytes, kBits, bits);
  for (std::size_t i = 0; i < 4; ++i) set_word(bytes, kRed + 4 * i, masks[i]);
  std::copy(samples.begin(), samples.end(), bytes.begin() + 128);
  return bytes;
}

TEST(Dds, OldHeadersOfPlainSamples) {
  const auto samples = [](const Bytes& bytes) { return samples_of<std::uint8_t>(decoded(bytes).image); };
  using List = std::vector<std::uint8_t>;
  EXPECT_EQ(samples(legacy(0x20000, 8, {0xff, 0, 0, 0}, {1, 2}, 2)), (List{1, 2}));
  EXPECT_EQ(samples(legacy(0x20000, 8, {0xff, 0xff, 0xff, 0}, {1, 2}, 2)), (List{1, 2}));
  EXPECT_EQ(samples(legacy(0x20001, 16, {0xff, 0, 0, 0xff00}, {1, 2}, 1)), (List{1, 2}));
  EXPECT_EQ(samples(legacy(0x40, 24, {0xff0000, 0xff00, 0xff, 0}, {1, 2, 3}, 1)), (List{3, 2, 1}));
  EXPECT_EQ(samples(legacy(0x41, 32, {0xff0000, 0xff00, 0xff, 0xff000000}, {1, 2, 3, 4}, 1)),
            (List{3, 2, 1, 4}));
  EXPECT_EQ(samples(legacy(0x41, 32, {0xff, 0xff00, 0xff0000, 0xff000000}, {1, 2, 3, 4}, 1)),
            (List{1, 2, 3, 4}));
  // Without alpha the fourth byte has no meaning.
  EXPECT_EQ(samples(legacy(0x40, 32, {0xff0000, 0xff00, 0xff, 0xff000000}, {1, 2, 3, 4}, 1)),
            (List{3, 2, 1}));
  const Image wide = decoded(legacy(0x20000, 16, {0xffff, 0, 0, 0}, {1, 2}, 1)).image;
  EXPECT_EQ(samples_of<std::uint16_t>(wide), (std::vector<std::uint16_t>{0x201}));
  Bytes half = legacy(4, 0, {}, {1, 2}, 1);
  set_word(half, kFourLetters, 111);
  EXPECT_EQ(decoded(half).image.type, SampleType::f16);

  Bytes dxt1 = legacy(4, 0, {}, std::vector<unsigned char>(8), 1);
  std::memcpy(dxt1.data() + kFourLetters, "DXT1", 4);
  ASSERT_TRUE(error_for(dxt1).has_value());
  EXPECT_NE(error_for(dxt1)->what.find("DXT1"), std::string::npos);
  EXPECT_TRUE(error_for(legacy(0x40, 16, {0xf800, 0x7e0, 0x1f, 0}, {1, 2}, 1)).has_value());
}

TEST(Dds, OpenImageIoSeesTheSameSamplesUnderOldHeaders) {
  // OpenImageIO 2.4 reads no uncompressed format under a DX10 header.
  const TemporaryFolder folder;
  const std::vector<unsigned char> samples = {10, 20, 30, 40, 50, 60, 70, 80, 90, 100, 110, 120};
  for (const Bytes& bytes : {legacy(0x20000, 8, {0xff, 0, 0, 0}, samples, 12),
                             legacy(0x40, 24, {0xff0000, 0xff00, 0xff, 0}, samples, 4),
                             legacy(0x41, 32, {0xff0000, 0xff00, 0xff, 0xff000000}, samples, 3),
                             legacy(0x41, 32, {0xff, 0xff00, 0xff0000, 0xff000000}, samples, 3)}) {
    put_bytes(folder / "a.dds", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    OIIO::ImageSpec wishes;
    wishes.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open((folder / "a.dds").string(), &wishes);
    ASSERT_TRUE(input) << OIIO::geterror();
    const Image ours = read_image(folder / "a.dds").image;
    ASSERT_EQ(input->spec().nchannels, ours.channels);
    std::vector<std::uint8_t> theirs(ours.samples.size());
    ASSERT_TRUE(input->read_image(0, 0, 0, ours.channels, OIIO::TypeDesc::UINT8, theirs.data()));
    EXPECT_EQ(samples_of<std::uint8_t>(ours), theirs);
  }
}

TEST(Dds, AstcencSeesTheSameSamples) {
  // It reads our DX10 headers. Blocks of one colour are the ones that ASTC keeps exactly.
  if (std::system("astcenc -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "astcenc is not installed";
  const TemporaryFolder folder;
  for (const int channels : {1, 4}) {
    Image image = random_image({12, 8}, channels, SampleType::u8);
    const auto pixel = static_cast<std::size_t>(channels);
    for (std::size_t y = 0; y < 8; ++y) {
      for (std::size_t x = 0; x < 12; ++x) {
        const std::byte* const block = image.samples.data() + (y / 4 * 4 * 12 + x / 4 * 4) * pixel;
        std::memmove(image.samples.data() + (y * 12 + x) * pixel, block, pixel);
      }
    }
    write_image(folder / "a.dds", image, {});
    const std::string command =
        "cd " + folder.path().string() + " && astcenc -tl a.dds a.png 4x4 -medium > /dev/null 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0);
    const Image seen = read_image(folder / "a.png").image;
    ASSERT_EQ(seen.size, image.size);
    for (int c = 0; c < std::min(seen.channels, channels); ++c) {
      EXPECT_EQ(samples_of_channel(seen, c).value, samples_of_channel(image, c).value)
          << channels << " " << c;
    }
  }
}

TEST(Dds, LayersWithMipLevelsGiveTheLargestOfEach) {
  Bytes bytes = file(random_image({2, 2, 2}, 1, SampleType::u8));
  set_word(bytes, kLevels, 2);
  bytes.resize(kSamples);
  for (const int sample : {1, 2, 3, 4, 99, 5, 6, 7, 8, 99})
    bytes.push_back(static_cast<unsigned char>(sample));
  const Decoded read = decoded(bytes);
  EXPECT_EQ(samples_of<std::uint8_t>(read.image), (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8}));
  ASSERT_EQ(read.notes.size(), 1u);
}

TEST(Dds, FalseClaimsAreRefused) {
  const Bytes whole = file(random_image({4, 4, 2}, 4, SampleType::u8));
  for (const auto& [at, value, expected] :
       std::vector<std::tuple<std::size_t, std::uint32_t, std::string>>{{kSize, 123, "headers of 123"},
                                                                        {kWidth, 0, "0x4"},
                                                                        {kWidth, 65537, "65537x4"},
                                                                        {kWidth, 5, "cut short"},
                                                                        {kWidth, 65536, "cut short"},
                                                                        {kHeight, 0xffffffffu, "4294967295"},
                                                                        {kLevels, 0xffffffffu, "mip levels"},
                                                                        {kLevels, 17, "cut short"},
                                                                        {kLayers, 0, "0 slices"},
                                                                        {kLayers, 3, "cut short"},
                                                                        {kLayers, 0xffffffffu, "slices"},
                                                                        {kDxgi, 71, "format 71"},  // BC1
                                                                        {kDxgi, 0, "format 0"},
                                                                        {kDimension, 2, "dimension 2"},
                                                                        {kMisc, 4, "cube"}}) {
    Bytes bytes = whole;
    set_word(bytes, at, value);
    const auto error = error_for(bytes);
    ASSERT_TRUE(error.has_value()) << at << " " << value;
    EXPECT_EQ(error->code, ErrorCode::invalid_input);
    EXPECT_NE(error->what.find(expected), std::string::npos) << error->what;
  }
  Bytes solid = file(random_image({4, 4, 2}, 4, SampleType::u8), SliceKind::depth);
  for (const std::uint32_t depth : {0u, 3u, 65536u, 0xffffffffu}) {
    set_word(solid, kDepth, depth);
    EXPECT_TRUE(error_for(solid).has_value()) << depth;
  }
}

}  // namespace
}  // namespace bn::texture
