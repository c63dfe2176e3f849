// Protects: files that other programs wrote give the samples that are stored in them, whatever their
// layout; and what is not a flat picture is refused.
#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <png.h>

#include <array>
#include <map>

#include "bn/error.h"
#include "texture/codec.h"
#include "texture/fixtures.h"

namespace bn::texture {
namespace {

using OIIO::ImageSpec;
using OIIO::TypeDesc;

Image decoded(const Bytes& bytes, const std::string& name = "foreign") {
  return decode(std::as_bytes(std::span(bytes)), name, {}).image;
}

template <class Sample>
constexpr auto kType = OIIO::BaseTypeFromC<Sample>::value;
template <>
constexpr auto kType<std::int8_t> = TypeDesc::INT8;

/// A file as OpenImageIO writes it for others.
template <class Sample>
Bytes written(const std::string& format, const ImageSpec& spec, const std::vector<Sample>& samples) {
  Bytes bytes;
  OIIO::Filesystem::IOVecOutput proxy(bytes);
  const auto output = OIIO::ImageOutput::create(format);
  output->set_ioproxy(&proxy);
  EXPECT_TRUE(output->open("a." + format, spec)) << output->geterror();
  EXPECT_TRUE(output->write_image(kType<Sample>, samples.data())) << output->geterror();
  EXPECT_TRUE(output->close()) << output->geterror();
  return bytes;
}

template <class Sample>
void expect_values(const Image& image, const std::vector<Sample>& samples) {
  ASSERT_EQ(image.type, SampleType::f32);
  const std::vector<float> read = samples_of<float>(image);
  ASSERT_EQ(read.size(), samples.size());
  for (std::size_t i = 0; i < read.size(); ++i) EXPECT_EQ(read[i], static_cast<float>(samples[i])) << i;
}

TEST(ForeignTiff, SignedAndWideSamplesKeepTheirValues) {
  const auto check = [](auto example, std::initializer_list<double> values) {
    using Sample = decltype(example);
    std::vector<Sample> samples;
    for (const double value : values) samples.push_back(static_cast<Sample>(value));
    const ImageSpec spec(static_cast<int>(samples.size()), 1, 1, kType<Sample>);
    expect_values(decoded(written("tiff", spec, samples)), samples);
  };
  check(std::int8_t{}, {-128, -1, 0, 1, 127});
  check(std::int16_t{}, {-32768, -1, 0, 1, 32767});
  check(std::int32_t{}, {-2147483648.0, -1, 0, 1, 2147483647.0});
  check(std::uint32_t{}, {0, 1, 16777216, 4294967295.0});
}

TEST(ForeignTiff, DoublesAreRefusedAndNotReadAsZeros) {
  const Bytes bytes = written("tiff", ImageSpec(3, 1, 1, TypeDesc::DOUBLE), std::vector<double>{1, 2, 3});
  expect_error(ErrorCode::invalid_input, [&] { decoded(bytes); });
}

TEST(ForeignTiff, HalfIsWidenedExactly) {
  const std::vector<float> samples = {0.0f, -0.5f, 65504.0f, 1.0f};
  expect_values(decoded(written("tiff", ImageSpec(2, 2, 1, TypeDesc::HALF), samples)), samples);
}

TEST(ForeignTiff, LayoutsAndCompressions) {
  const Image image = random_image({37, 21}, 3, SampleType::u8);
  const auto samples = samples_of<std::uint8_t>(image);
  for (const char* compression : {"none", "lzw", "zip", "packbits"}) {
    for (const bool separate : {false, true}) {
      for (const bool tiled : {false, true}) {
        ImageSpec spec(37, 21, 3, TypeDesc::UINT8);
        spec.attribute("compression", compression);
        spec.attribute("planarconfig", separate ? "separate" : "contig");
        if (tiled) spec.tile_width = spec.tile_height = 16;
        EXPECT_TRUE(same_picture(decoded(written("tiff", spec, samples)), image))
            << compression << separate << tiled;
      }
    }
  }
}

TEST(ForeignTiff, AlphaIsNotMultiplied) {
  const Image image = random_image({8, 8}, 4, SampleType::u8);
  ImageSpec spec(8, 8, 4, TypeDesc::UINT8);  // the fourth channel is alpha
  for (const int unassociated : {0, 1}) {
    spec.attribute("oiio:UnassociatedAlpha", unassociated);
    EXPECT_TRUE(same_picture(decoded(written("tiff", spec, samples_of<std::uint8_t>(image))), image));
  }
}

TEST(ForeignExr, HalfIsWidenedExactly) {
  const std::vector<float> samples = {0.0f, -0.5f, 1.0f / 3, 65504.0f, 6e-8f, 1.0f};
  ImageSpec spec(3, 2, 1, TypeDesc::HALF);
  for (const char* compression : {"none", "rle", "zip", "zips", "piz"}) {
    spec.attribute("compression", compression);
    const Image image = decoded(written("openexr", spec, samples));
    ASSERT_EQ(image.type, SampleType::f32);
    EXPECT_EQ(samples_of<float>(image),
              (std::vector<float>{0.0f, -0.5f, 0.33325195f, 65504.0f, 5.9604645e-8f, 1.0f}));
  }
}

TEST(ForeignExr, TiledMipMappedAndMultiPartFilesGiveTheirFirstPicture) {
  const Image image = random_image({32, 32}, 3, SampleType::f32);
  const auto samples = samples_of<float>(image);
  ImageSpec tiled(32, 32, 3, TypeDesc::FLOAT);
  tiled.tile_width = tiled.tile_height = 16;
  EXPECT_TRUE(same_picture(decoded(written("openexr", tiled, samples)), image));

  // OpenImageIO writes files of several pictures only by path.
  const TemporaryFolder folder;
  const auto levels = OIIO::ImageOutput::create("openexr");
  ImageSpec level = tiled;
  level.attribute("textureformat", "Plain Texture");
  ASSERT_TRUE(levels->open(folder / "levels.exr", level)) << levels->geterror();
  ASSERT_TRUE(levels->write_image(TypeDesc::FLOAT, samples.data()));
  for (int side = 16; side >= 1; side /= 2) {
    level.width = level.height = level.full_width = level.full_height = side;
    ASSERT_TRUE(levels->open(folder / "levels.exr", level, OIIO::ImageOutput::AppendMIPLevel));
    ASSERT_TRUE(levels->write_image(TypeDesc::FLOAT, samples.data()));
  }
  ASSERT_TRUE(levels->close());
  EXPECT_TRUE(same_picture(read_image(folder / "levels.exr").image, image));

  const auto parts = OIIO::ImageOutput::create("openexr");
  const ImageSpec specs[2] = {ImageSpec(32, 32, 3, TypeDesc::FLOAT), ImageSpec(32, 32, 1, TypeDesc::FLOAT)};
  ASSERT_TRUE(parts->open(folder / "parts.exr", 2, specs)) << parts->geterror();
  ASSERT_TRUE(parts->write_image(TypeDesc::FLOAT, samples.data()));
  ASSERT_TRUE(parts->open(folder / "parts.exr", specs[1], OIIO::ImageOutput::AppendSubimage));
  ASSERT_TRUE(parts->write_image(TypeDesc::FLOAT, samples.data()));
  ASSERT_TRUE(parts->close());
  EXPECT_TRUE(same_picture(read_image(folder / "parts.exr").image, image));
}

TEST(ForeignExr, DeepImagesAreRefused) {
  const TemporaryFolder folder;
  const auto output = OIIO::ImageOutput::create("openexr");
  ImageSpec spec(4, 4, 5, TypeDesc::FLOAT);
  spec.channelnames = {"R", "G", "B", "A", "Z"};
  spec.deep = true;
  OIIO::DeepData deep(spec);
  for (std::int64_t pixel = 0; pixel < 16; ++pixel) deep.set_samples(pixel, 2);
  ASSERT_TRUE(output->open(folder / "a.exr", spec)) << output->geterror();
  ASSERT_TRUE(output->write_deep_image(deep)) << output->geterror();
  ASSERT_TRUE(output->close());
  const auto error = error_of([&] { read_image(folder / "a.exr"); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->what, "a deep image");
}

TEST(ForeignFile, MoreThan64ChannelsAreRefused) {
  for (const char* format : {"tiff", "openexr"}) {
    const ImageSpec spec(2, 2, 65, TypeDesc::FLOAT);
    const Bytes bytes = written(format, spec, std::vector<float>(4 * 65));
    expect_error(ErrorCode::invalid_input, [&] { decoded(bytes); });
  }
}

TEST(ForeignFile, OtherFormatsAreKnownByTheirExtension) {
  const Image image = random_image({9, 7}, 3, SampleType::u8);
  for (const char* name : {"tga", "ppm"}) {
    const Bytes bytes = written(name, ImageSpec(9, 7, 3, TypeDesc::UINT8), samples_of<std::uint8_t>(image));
    EXPECT_TRUE(same_picture(decoded(bytes, std::string("a.") + name), image)) << name;
  }
  // A damaged BMP can crash OpenImageIO 2.4: not read.
  const Bytes bmp = written("bmp", ImageSpec(9, 7, 3, TypeDesc::UINT8), samples_of<std::uint8_t>(image));
  expect_error(ErrorCode::invalid_input, [&] { decoded(bmp, "a.bmp"); });
}

/// A PNG made with libpng, as the test says.
struct PngRecipe {
  int width, height, depth, type;
  bool interlaced = false;
  std::vector<png_color> palette = {};
  std::vector<png_byte> palette_alpha = {};
  bool text_at_end = false;
};

Bytes png_of(const PngRecipe& recipe, const std::vector<std::uint8_t>& packed, int row_bytes) {
  Bytes bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_structp p, png_bytep data, std::size_t count) {
        auto* const to = static_cast<Bytes*>(png_get_io_ptr(p));
        to->insert(to->end(), data, data + count);
      },
      nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(recipe.width), static_cast<png_uint_32>(recipe.height),
               recipe.depth, recipe.type, recipe.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
  if (!recipe.palette.empty())
    png_set_PLTE(png, info, recipe.palette.data(), static_cast<int>(recipe.palette.size()));
  if (!recipe.palette_alpha.empty()) {
    png_set_tRNS(png, info, recipe.palette_alpha.data(), static_cast<int>(recipe.palette_alpha.size()),
                 nullptr);
  }
  png_set_gAMA(png, info, 0.45455);
  png_write_info(png, info);
  std::vector<png_bytep> rows;
  for (int y = 0; y < recipe.height; ++y)
    rows.push_back(const_cast<png_bytep>(packed.data()) + y * row_bytes);
  png_write_image(png, rows.data());
  if (recipe.text_at_end) {
    std::string key = "Description", json = to_json(full_metadata());
    png_text text = {};
    text.compression = PNG_TEXT_COMPRESSION_zTXt;
    text.key = key.data();
    text.text = json.data();
    text.text_length = json.size();
    png_set_text(png, info, &text, 1);
  }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

TEST(ForeignPng, SmallDepthsAreExpanded) {
  for (const int depth : {1, 2, 4}) {
    // Every value of the depth in one row, packed from the left.
    const int values = 1 << depth;
    std::vector<std::uint8_t> packed(static_cast<std::size_t>(values * depth + 7) / 8, 0);
    std::vector<std::uint8_t> expected;
    for (int v = 0; v < values; ++v) {
      const int bit = v * depth;
      packed[static_cast<std::size_t>(bit / 8)] |= static_cast<std::uint8_t>(v << (8 - depth - bit % 8));
      expected.push_back(static_cast<std::uint8_t>(v * 255 / (values - 1)));
    }
    const Image image = decoded(png_of({values, 1, depth, PNG_COLOR_TYPE_GRAY}, packed, 0));
    EXPECT_EQ(image.type, SampleType::u8);
    EXPECT_EQ(image.channels, 1);
    EXPECT_EQ(samples_of<std::uint8_t>(image), expected) << depth;
  }
}

TEST(ForeignPng, PalettesAreExpanded) {
  const std::vector<png_color> palette = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  const std::vector<std::uint8_t> indices = {0, 1, 2, 2};
  const Image colours = decoded(png_of({2, 2, 8, PNG_COLOR_TYPE_PALETTE, false, palette}, indices, 2));
  EXPECT_EQ(colours.channels, 3);
  EXPECT_EQ(samples_of<std::uint8_t>(colours),
            (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8, 9, 7, 8, 9}));
  const Image with_alpha =
      decoded(png_of({2, 2, 8, PNG_COLOR_TYPE_PALETTE, false, palette, {10, 20}}, indices, 2));
  EXPECT_EQ(with_alpha.channels, 4);
  EXPECT_EQ(samples_of<std::uint8_t>(with_alpha),
            (std::vector<std::uint8_t>{1, 2, 3, 10, 4, 5, 6, 20, 7, 8, 9, 255, 7, 8, 9, 255}));
}

TEST(ForeignPng, InterlacedAndAlphaAndGammaGiveTheStoredSamples) {
  for (const auto& [type, channels] : {std::pair{PNG_COLOR_TYPE_GRAY, 1},
                                       {PNG_COLOR_TYPE_GRAY_ALPHA, 2},
                                       {PNG_COLOR_TYPE_RGB, 3},
                                       {PNG_COLOR_TYPE_RGB_ALPHA, 4}}) {
    const Image image = random_image({13, 11}, channels, SampleType::u8);
    for (const bool interlaced : {false, true}) {
      EXPECT_TRUE(same_picture(
          decoded(png_of({13, 11, 8, type, interlaced}, samples_of<std::uint8_t>(image), 13 * channels)),
          image));
    }
  }
}

TEST(ForeignPng, CompressedMetadataAfterThePictureAreFound) {
  const Bytes bytes =
      png_of({.width = 2, .height = 2, .depth = 8, .type = PNG_COLOR_TYPE_GRAY, .text_at_end = true},
             {1, 2, 3, 4}, 2);
  const TemporaryFolder folder;
  put_bytes(folder / "a.png", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  EXPECT_EQ(read_image(folder / "a.png").metadata, full_metadata());
}

std::filesystem::path reference(const char* name) { return std::filesystem::path(BN_TEST_DATA) / name; }

TEST(Reference, EveryChannelOfAnRgbaMaskIsFlat) {
  const FileContent content = read_image(reference("peters_cc0_64_LDR_RGBA_0.png"));
  EXPECT_FALSE(content.metadata.has_value());
  EXPECT_EQ(content.metadata_fault, "");
  ASSERT_EQ(content.image.channels, 4);
  for (int channel = 0; channel < 4; ++channel) {
    const Levels levels = levels_of_channel(content.image, channel);
    std::map<int, int> count;
    for (const int level : levels.value) ++count[level];
    ASSERT_EQ(count.size(), 256u) << channel;
    for (const auto& [level, times] : count)
      EXPECT_EQ(times, 16) << "channel " << channel << " level " << level;
    EXPECT_TRUE(levels.is_permutation);
  }
}

TEST(Reference, A16BitMaskHasEveryRankOnce) {
  for (const char* name : {"peters_cc0_64_HDR_L_0.png", "peters_cc0_128_HDR_L_0.png"}) {
    const Image image = read_image(reference(name)).image;
    EXPECT_EQ(image.type, SampleType::u16);
    const Levels levels = levels_of_channel(image, 0);
    EXPECT_EQ(levels.distinct, image.size.area());
    EXPECT_TRUE(levels.is_permutation);
  }
}

}  // namespace
}  // namespace bn::texture
