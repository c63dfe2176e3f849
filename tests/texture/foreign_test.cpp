// Protects: files that other programs wrote give the samples that are stored in them, whatever their
// layout; and what is not a flat picture is refused.
#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "bn/error.h"
#include "bn/volume.h"
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

/// A TIFF of one strip, plain, as its tags say.
struct TiffRecipe {
  int width, height, channels, bits, photometric;
  bool floats = false;
  std::vector<std::uint32_t> pages_after = {};  ///< offsets of further directories
};

Bytes tiff_of(const TiffRecipe& recipe, const Bytes& strip) {
  Bytes bytes = {'I', 'I', 42, 0, 8, 0, 0, 0};
  const auto put = [&](std::uint32_t value, int count) {
    for (int i = 0; i < count; ++i) bytes.push_back(static_cast<unsigned char>(value >> 8 * i & 255));
  };
  constexpr std::uint32_t kTags = 10, kLong = 4, kShort = 3, kAfter = 8 + 2 + 12 * kTags + 4;
  const auto tag = [&](std::uint32_t number, std::uint32_t type, std::uint32_t value) {
    put(number, 2), put(type, 2), put(1, 4), put(value, 4);
  };
  const auto as_number = [](int value) { return static_cast<std::uint32_t>(value); };
  put(kTags, 2);
  tag(256, kLong, as_number(recipe.width));
  tag(257, kLong, as_number(recipe.height));
  const auto bits = as_number(recipe.bits);
  if (recipe.channels == 1) {
    tag(258, kShort, bits);
  } else {  // a list behind the directory
    put(258, 2), put(kShort, 2), put(as_number(recipe.channels), 4), put(kAfter, 4);
  }
  tag(259, kShort, 1);
  tag(262, kShort, as_number(recipe.photometric));
  tag(273, kLong, kAfter + 16);
  tag(277, kShort, as_number(recipe.channels));
  tag(278, kLong, as_number(recipe.height));
  tag(279, kLong, static_cast<std::uint32_t>(strip.size()));
  tag(339, kShort, recipe.floats ? 3 : 1);
  put(recipe.pages_after.empty() ? 0 : recipe.pages_after[0], 4);
  for (int i = 0; i < 8; ++i) put(bits, 2);
  bytes.insert(bytes.end(), strip.begin(), strip.end());
  return bytes;
}

constexpr int kWhiteIsZero = 0, kBlackIsZero = 1, kRgb = 2, kInks = 5, kYcbcr = 6, kLab = 8;

Bytes counting(std::size_t count) {
  Bytes bytes;
  for (std::size_t i = 0; i < count; ++i) bytes.push_back(static_cast<unsigned char>(7 * i + 1));
  return bytes;
}

TEST(ForeignTiff, SamplesAreAsStoredOrRefusedAlikeAtEveryDepth) {
  for (const auto& [bits, floats] :
       {std::pair{1, false}, {4, false}, {8, false}, {16, false}, {32, false}, {32, true}}) {
    const Bytes strip = counting(static_cast<std::size_t>(8 * bits));  // 8x8 pixels of one channel
    const auto of = [&](int channels, int photometric) {
      return tiff_of({8, 8 / channels, channels, bits, photometric, floats}, strip);
    };
    SCOPED_TRACE(bits);
    const Image grey = decoded(of(1, kBlackIsZero));
    EXPECT_EQ(grey.channels, 1);
    if (bits == 8 || bits == 16) {
      EXPECT_EQ(0, std::memcmp(grey.samples.data(), strip.data(), strip.size()));
    }
    const auto refused = error_of([&] { decoded(of(1, kWhiteIsZero)); });
    ASSERT_TRUE(refused.has_value());
    EXPECT_NE(refused->what.find("from white to black"), std::string::npos) << refused->what;
    EXPECT_NE(refused->remedy, "");
    if (bits < 8) continue;
    for (const int photometric : {kYcbcr, kLab, 32844, 4, 9, 32803}) {
      SCOPED_TRACE(photometric);
      const Bytes other = tiff_of({2, 2, 3, bits, photometric, floats}, counting(48));
      expect_error(ErrorCode::invalid_input, [&] { decoded(other); });
    }
    const Image inks = decoded(of(4, kInks));
    ASSERT_EQ(inks.channels, 4);
    if (bits <= 16 || floats) {
      EXPECT_EQ(0,
                std::memcmp(inks.samples.data(), strip.data(), std::min(strip.size(), inks.samples.size())));
    }
    EXPECT_EQ(decoded(tiff_of({2, 2, 3, bits, kRgb, floats}, counting(48))).channels, 3);
  }
  // OpenImageIO would stretch these to 16 bits.
  for (const int bits : {3, 6, 10, 12, 14, 24}) {
    SCOPED_TRACE(bits);
    const Bytes odd = tiff_of({8, 8, 1, bits, kBlackIsZero}, counting(256));
    expect_error(ErrorCode::invalid_input, [&] { decoded(odd); });
  }
}

TEST(ForeignTiff, HalfIsReadAsItIs) {
  // 0, -0.5, 65504, 1
  const Image image =
      decoded(tiff_of({2, 2, 1, 16, kBlackIsZero, true}, {0x00, 0x00, 0x00, 0xb8, 0xff, 0x7b, 0x00, 0x3c}));
  ASSERT_EQ(image.type, SampleType::f16);
  expect_values(to_float(image), std::vector<float>{0.0f, -0.5f, 65504.0f, 1.0f});
}

TEST(ForeignTiff, AChainOfPagesThatGoesRoundIsRefused) {
  const auto error = error_of([&] { decoded(tiff_of({2, 2, 1, 8, kBlackIsZero, false, {8}}, counting(4))); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code, ErrorCode::invalid_input);
  EXPECT_NE(error->what.find("pages"), std::string::npos) << error->what;
}

/// A file of several pictures, as OpenImageIO writes it, which it does only by path.
void write_parts(const std::filesystem::path& path, const char* format, const std::vector<ImageSpec>& specs,
                 const std::vector<Image>& parts) {
  const auto output = OIIO::ImageOutput::create(format);
  if (std::string_view(format) == "openexr") {
    ASSERT_TRUE(output->open(path, static_cast<int>(specs.size()), specs.data())) << output->geterror();
  } else {
    ASSERT_TRUE(output->open(path, specs[0])) << output->geterror();
  }
  for (std::size_t i = 0; i < specs.size(); ++i) {
    if (i > 0) {
      ASSERT_TRUE(output->open(path, specs[i], OIIO::ImageOutput::AppendSubimage)) << output->geterror();
    }
    ASSERT_TRUE(output->write_image(TypeDesc::FLOAT, parts[i].samples.data())) << output->geterror();
  }
  ASSERT_TRUE(output->close());
}

TEST(ForeignFile, PartsAndPagesThatAreAlikeAreSlices) {
  const TemporaryFolder folder;
  std::vector<Image> parts;
  for (std::uint64_t i = 0; i < 5; ++i) parts.push_back(random_image({6, 4}, 2, SampleType::f32, i));
  const std::vector<ImageSpec> specs(5, ImageSpec(6, 4, 2, TypeDesc::FLOAT));
  for (const char* format : {"openexr", "tiff"}) {
    const std::filesystem::path path = folder / (std::string("parts.") + (format[0] == 'o' ? "exr" : "tif"));
    write_parts(path, format, specs, parts);
    const Volume volume = read_volume(path);
    EXPECT_TRUE(same_picture(volume.image, stack_slices(parts))) << format;
    ASSERT_EQ(volume.notes.size(), 1u);
    EXPECT_NE(volume.notes[0].find("it has 5 pa"), std::string::npos) << volume.notes[0];
    const auto error = error_of([&] { read_image(path); });
    ASSERT_TRUE(error.has_value());
    EXPECT_NE(error->what.find("5 slices"), std::string::npos);
  }
}

TEST(ForeignFile, OfPartsThatDifferTheFirstIsReadAndTheirNumberNoted) {
  const TemporaryFolder folder;
  const Image first = random_image({6, 4}, 3, SampleType::f32),
              smaller = random_image({5, 4}, 3, SampleType::f32),
              fewer = random_image({6, 4}, 1, SampleType::f32);
  for (const Image& other : {smaller, fewer}) {
    ImageSpec spec(other.size.width, other.size.height, other.channels, TypeDesc::FLOAT);
    spec.full_width = 6;  // one for all parts
    write_parts(folder / "a.exr", "openexr", {ImageSpec(6, 4, 3, TypeDesc::FLOAT), spec}, {first, other});
    write_parts(folder / "a.tif", "tiff", {ImageSpec(6, 4, 3, TypeDesc::FLOAT), spec}, {first, other});
    for (const char* name : {"a.exr", "a.tif"}) {
      const FileContent content = read_image(folder / name);
      EXPECT_TRUE(same_picture(content.image, first));
      ASSERT_EQ(content.notes.size(), 1u);
      EXPECT_NE(content.notes[0].find("it has 2 pa"), std::string::npos) << content.notes[0];
    }
  }
}

TEST(ForeignExr, ChannelNamesAreThoseOfTheFile) {
  ImageSpec spec(2, 2, 3, TypeDesc::FLOAT);
  spec.channelnames = {"Z", "noise.x", "A"};
  spec.alpha_channel = -1;
  const Bytes bytes = written("openexr", spec, std::vector<float>{1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3});
  const Decoded read = decode(std::as_bytes(std::span(bytes)), "foreign", {});
  ASSERT_EQ(read.channel_names.size(), 3u);
  for (std::size_t c = 0; c < 3; ++c) {
    const float expected = read.channel_names[c] == "Z"         ? 1.0f
                           : read.channel_names[c] == "noise.x" ? 2.0f
                                                                : 3.0f;
    EXPECT_EQ(samples_of<float>(read.image)[c], expected) << read.channel_names[c];
  }
}

TEST(ForeignExr, HalfIsReadAsItIs) {
  const std::vector<float> samples = {0.0f, -0.5f, 1.0f / 3, 65504.0f, 6e-8f, 1.0f};
  ImageSpec spec(3, 2, 1, TypeDesc::HALF);
  for (const char* compression : {"none", "rle", "zip", "zips", "piz"}) {
    spec.attribute("compression", compression);
    const Image image = decoded(written("openexr", spec, samples));
    ASSERT_EQ(image.type, SampleType::f16);
    EXPECT_EQ(samples_of<float>(to_float(image)),
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

TEST(ForeignFile, OtherFormatsAreKnownByTheirContentAndTgaByItsExtension) {
  const Image image = random_image({9, 7}, 3, SampleType::u8);
  const auto as = [&](const char* format) {
    return written(format, ImageSpec(9, 7, 3, TypeDesc::UINT8), samples_of<std::uint8_t>(image));
  };
  EXPECT_TRUE(same_picture(decoded(as("tga"), "a.tga"), image));
  for (const char* name : {"ppm", "bmp"}) EXPECT_TRUE(same_picture(decoded(as(name)), image)) << name;
}

}  // namespace
}  // namespace bn::texture
