// Protects: what is written is read back sample for sample with its metadata, in every format, type,
// number of channels and of slices; and writing twice gives the same bytes.
#include "texture/fixtures.h"

#include "bn/error.h"
#include "bn/volume.h"

namespace bn::texture {
namespace {

struct Case {
  const char* extension;
  SampleType type;
  int channels;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const SampleType type : {SampleType::u8, SampleType::u16, SampleType::f32, SampleType::f16}) {
    for (const int channels : {1, 2, 3, 4, 5, 12, 64}) {
      const bool is_float = type == SampleType::f32, is_half = type == SampleType::f16;
      all.push_back({".bin", type, channels});
      if (channels <= 4) all.push_back({".ktx2", type, channels});
      if (channels <= 4 && (channels != 3 || is_float)) all.push_back({".dds", type, channels});
      if (is_float || is_half) all.push_back({".exr", type, channels});
      if (is_half) continue;
      if (!is_float && channels <= 4) all.push_back({".png", type, channels});
      for (const char* extension : {".tif", ".TIFF", ".h"}) all.push_back({extension, type, channels});
    }
  }
  return all;
}

bool holds_volumes(std::string_view extension) {
  return extension == ".bin" || extension == ".h" || extension == ".ktx2" || extension == ".dds" ||
         extension == ".exr";
}

class RoundTrip : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip, testing::ValuesIn(cases()), [](const auto& test) {
  return std::string(test.param.extension + 1) + "_" + std::string(name_of(test.param.type)) + "_" +
         std::to_string(test.param.channels);
});

TEST_P(RoundTrip, PictureAndMetadataSurvive) {
  const TemporaryFolder folder;
  for (const Extent size : {Extent{1, 1}, Extent{1, 7}, Extent{7, 1}, Extent{37, 19}}) {
    const Image image = random_image(size, GetParam().channels, GetParam().type);
    const auto path = folder / (std::string("a") + GetParam().extension);
    write_image(path, image, full_metadata());
    const FileContent content = read_image(path);
    EXPECT_TRUE(same_picture(content.image, image)) << size.width << "x" << size.height;
    Metadata expected = full_metadata();
    expected.pixel_hash = pixel_hash(image);
    EXPECT_EQ(content.metadata_fault, "");
    EXPECT_EQ(content.metadata, expected);

    const std::string first = bytes_of(path);
    write_image(path, image, full_metadata());
    EXPECT_TRUE(bytes_of(path) == first) << "the second file differs from the first";
    const bool beside = std::string_view(GetParam().extension) == ".dds";
    EXPECT_EQ(folder.names().size(), beside ? 2u : 1u);
  }
}

TEST_P(RoundTrip, VolumesSurviveWhereTheFormatHoldsThem) {
  const TemporaryFolder folder;
  const auto path = folder / (std::string("a") + GetParam().extension);
  const Image volume = random_image({7, 5, 3}, GetParam().channels, GetParam().type);
  if (!holds_volumes(GetParam().extension)) {
    expect_error(ErrorCode::invalid_input, [&] { write_image(path, volume, {}); });
    EXPECT_TRUE(folder.names().empty());
    return;
  }
  for (const SliceKind kind : {SliceKind::layers, SliceKind::depth}) {
    write_image(path, volume, full_metadata(), kind);
    const Volume back = read_volume(path);
    EXPECT_TRUE(same_picture(back.image, volume));
    EXPECT_EQ(back.metadata_fault, "");
    ASSERT_TRUE(back.metadata.has_value());
    EXPECT_EQ(back.metadata->pixel_hash, pixel_hash(volume));
    EXPECT_TRUE(back.as_recorded);
    const auto error = error_of([&] { read_image(path); });
    ASSERT_TRUE(error.has_value()) << "a volume was taken for a picture";
    EXPECT_EQ(error->code, ErrorCode::invalid_input);
  }
}

TEST(RoundTrip, LargeEnoughForStripsTilesAndChunks) {
  const TemporaryFolder folder;
  const Image bytes = random_image({515, 300}, 3, SampleType::u8);
  for (const char* name : {"a.png", "a.tif", "a.bin", "a.h", "a.ktx2"}) {
    write_image(folder / name, bytes, {});
    EXPECT_TRUE(same_picture(read_image(folder / name).image, bytes)) << name;
  }
  const Image floats = random_image({515, 300}, 2, SampleType::f32);
  for (const char* name : {"b.exr", "b.tif", "b.bin", "b.h", "b.ktx2", "b.dds"}) {
    write_image(folder / name, floats, {});
    EXPECT_TRUE(same_picture(read_image(folder / name).image, floats)) << name;
  }
}

TEST(RoundTrip, NotANumberSurvivesWhereTheFormatHasIt) {
  const TemporaryFolder folder;
  const Image image = image_of<std::uint32_t>({2, 2}, 1, SampleType::f32,
                                              {0x7fc00001u, 0x7f800000u, 0xff800000u, 0x80000000u});
  for (const char* name : {"a.exr", "a.tif", "a.bin", "a.ktx2", "a.dds"}) {
    write_image(folder / name, image, {});
    EXPECT_TRUE(same_picture(read_image(folder / name).image, image)) << name;
  }
  expect_error(ErrorCode::invalid_input, [&] { write_image(folder / "a.h", image, {}); });
  EXPECT_FALSE(std::filesystem::exists(folder / "a.h"));
}

TEST(PixelHash, IsTheSameInEveryFormatAndSensitiveToEverything) {
  const Image image = random_image({6, 4}, 1, SampleType::u8);
  const std::string hash = pixel_hash(image);
  EXPECT_EQ(hash.size(), 9u + 32u);
  Image other = image;
  other.size = {4, 6};
  EXPECT_NE(pixel_hash(other), hash);
  other = image;
  other.size = {6, 2};
  other.channels = 2;
  EXPECT_NE(pixel_hash(other), hash);
  other.size = {6, 2};
  other.channels = 1;
  other.type = SampleType::u16;
  EXPECT_NE(pixel_hash(other), hash);
  other = image;
  other.samples[23] ^= std::byte{1};
  EXPECT_NE(pixel_hash(other), hash);
}

TEST(PixelHash, TellsAVolumeFromAPictureOfTheSameSamples) {
  const Image volume = random_image({6, 4, 2}, 1, SampleType::u8);
  Image picture = volume;
  picture.size.height = 8;
  picture.depth = 1;
  EXPECT_NE(pixel_hash(picture), pixel_hash(volume));
  Image turned = volume;
  turned.size = {2, 4};
  turned.depth = 6;
  EXPECT_NE(pixel_hash(turned), pixel_hash(volume));
}

TEST(PixelHash, Golden) {
  // Files carry this hash: it may never change.
  EXPECT_EQ(pixel_hash(image_of<std::uint16_t>({2, 1}, 1, SampleType::u16, {1, 0xabcd})),
            "xxh3-128:7254161f9f10251ae9161b0b0b0fc779");
}

TEST(EncodePng, IsAPngOfTheSameSamplesAndAlwaysOfTheSameBytes) {
  const TemporaryFolder folder;
  for (const SampleType type : {SampleType::u8, SampleType::u16}) {
    for (const int channels : {1, 2, 3, 4}) {
      const Image image = random_image({7, 5}, channels, type);
      const auto bytes = encode_png(image);
      EXPECT_EQ(bytes, encode_png(image));
      put_bytes(folder / "a.png", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
      const FileContent content = read_image(folder / "a.png");
      EXPECT_EQ(content.image.samples, image.samples);
      EXPECT_FALSE(content.metadata);
      EXPECT_EQ(content.metadata_fault, "");
    }
  }
}

TEST(EncodePng, RefusesWhatPngCannotHold) {
  EXPECT_THROW(encode_png(random_image({2, 2}, 5, SampleType::u8)), Error);
  EXPECT_THROW(encode_png(random_image({2, 2, 2}, 1, SampleType::u8)), Error);
  EXPECT_THROW(encode_png(random_image({2, 2}, 1, SampleType::f16)), Error);
  EXPECT_THROW(encode_png(random_image({2, 2}, 1, SampleType::f32)), Error);
  EXPECT_THROW(encode_png(Image{}), Error);
}

}  // namespace
}  // namespace bn::texture
