// Protects: GIF, JPEG and WebP give the samples that are stored, or a refusal that
// says why; nothing is scaled or converted without a word, and no file, cut short or damaged, crashes the
// reader.
#include <cstdio>
// jpeglib.h needs FILE.
#include <gif_lib.h>
#include <jpeglib.h>
#include <webp/encode.h>

#include "texture/rare_formats.h"

namespace bn::texture {
namespace {

// --- GIF -------------------------------------------------------------------------------------------

struct Gif {
  int width = 0, height = 0;
  std::vector<GifColorType> palette;
  std::vector<GifByteType> indices;
  int frames = 1;
  int transparent = NO_TRANSPARENT_COLOR;
  bool interlaced = false;
};

Bytes gif_of(const Gif& gif) {
  Bytes bytes;
  int error = 0;
  GifFileType* const file = EGifOpen(
      &bytes,
      [](GifFileType* to, const GifByteType* data, int count) {
        auto* const out = static_cast<Bytes*>(to->UserData);
        out->insert(out->end(), data, data + count);
        return count;
      },
      &error);
  ColorMapObject* const map = GifMakeMapObject(static_cast<int>(gif.palette.size()), gif.palette.data());
  EXPECT_EQ(EGifPutScreenDesc(file, gif.width, gif.height, 8, 0, map), GIF_OK);
  for (int frame = 0; frame < gif.frames; ++frame) {
    if (gif.transparent != NO_TRANSPARENT_COLOR) {
      const GraphicsControlBlock control{0, false, 0, gif.transparent};
      GifByteType block[4];
      EGifGCBToExtension(&control, block);
      EXPECT_EQ(EGifPutExtension(file, GRAPHICS_EXT_FUNC_CODE, 4, block), GIF_OK);
    }
    EXPECT_EQ(EGifPutImageDesc(file, 0, 0, gif.width, gif.height, gif.interlaced, nullptr), GIF_OK);
    for (int i = 0; i < gif.height; ++i) {
      // The rows in the order of an interlaced file of 8 rows.
      const int y = gif.interlaced ? std::array{0, 4, 2, 6, 1, 3, 5, 7}[static_cast<std::size_t>(i)] : i;
      std::vector<GifByteType> row(gif.indices.begin() + y * gif.width,
                                   gif.indices.begin() + (y + 1) * gif.width);
      EXPECT_EQ(EGifPutLine(file, row.data(), gif.width), GIF_OK);
    }
  }
  EXPECT_EQ(EGifCloseFile(file, &error), GIF_OK);
  GifFreeMapObject(map);
  return bytes;
}

TEST(Gif, GreysAreOneChannelAndColoursThree) {
  const std::vector<GifColorType> greys = {{0, 0, 0}, {90, 90, 90}, {255, 255, 255}, {7, 7, 7}};
  const Image grey = decoded(gif_of({2, 2, greys, {0, 1, 2, 3}})).image;
  EXPECT_EQ(grey.channels, 1);
  expect_samples(grey, SampleType::u8, std::vector<std::uint8_t>{0, 90, 255, 7});
  const std::vector<GifColorType> colours = {{1, 2, 3}, {4, 5, 6}};
  expect_samples(decoded(gif_of({1, 2, colours, {1, 0}})).image, SampleType::u8,
                 std::vector<std::uint8_t>{4, 5, 6, 1, 2, 3});
}

TEST(Gif, InterlacedRowsTransparencyAndAnimations) {
  const std::vector<GifColorType> greys = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3},
                                           {4, 4, 4}, {5, 5, 5}, {6, 6, 6}, {7, 7, 7}};
  const std::vector<GifByteType> rows = {0, 1, 2, 3, 4, 5, 6, 7};
  for (const bool interlaced : {false, true}) {
    expect_samples(
        decoded(
            gif_of({.width = 1, .height = 8, .palette = greys, .indices = rows, .interlaced = interlaced}))
            .image,
        SampleType::u8, std::vector<std::uint8_t>(rows.begin(), rows.end()));
  }
  const Image clear =
      decoded(gif_of({.width = 2, .height = 1, .palette = greys, .indices = {5, 6}, .transparent = 6})).image;
  EXPECT_EQ(clear.channels, 2);
  expect_samples(clear, SampleType::u8, std::vector<std::uint8_t>{5, 255, 6, 0});
  EXPECT_EQ(decoded(gif_of({.width = 2, .height = 1, .palette = greys, .indices = {5, 6}, .transparent = 1}))
                .image.channels,
            1)
      << "a transparent colour that does not occur";
  const Decoded moving =
      decoded(gif_of({.width = 2, .height = 1, .palette = greys, .indices = {5, 6}, .frames = 3}));
  ASSERT_EQ(moving.notes.size(), 1u);
  expect_text(moving.notes[0], "3 pictures");
}

TEST(Gif, HalfAPictureIsNone) {
  Bytes bytes = gif_of({64, 64, {{0, 0, 0}, {9, 9, 9}}, std::vector<GifByteType>(64 * 64, 1)});
  bytes.resize(bytes.size() / 2);
  expect_text(refusal_of(bytes), "not a whole GIF");
}

TEST(Gif, Survives) {
  expect_survival(
      gif_of({5, 4, {{0, 0, 0}, {9, 9, 9}, {1, 2, 3}, {4, 5, 6}}, std::vector<GifByteType>(20, 2), 2}));
}

// --- JPEG ------------------------------------------------------------------------------------------

Bytes jpeg_of(const Image& image, J_COLOR_SPACE from, J_COLOR_SPACE stored, bool progressive = false) {
  jpeg_compress_struct jpeg = {};
  jpeg_error_mgr errors = {};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &memory, &size);
  jpeg.image_width = static_cast<JDIMENSION>(image.size.width);
  jpeg.image_height = static_cast<JDIMENSION>(image.size.height);
  jpeg.input_components = image.channels;
  jpeg.in_color_space = from;
  jpeg_set_defaults(&jpeg);
  jpeg_set_colorspace(&jpeg, stored);
  jpeg_set_quality(&jpeg, 100, TRUE);
  if (progressive) jpeg_simple_progression(&jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  const std::size_t row_bytes = image.samples.size() / jpeg.image_height;
  while (jpeg.next_scanline < jpeg.image_height) {
    auto* row = const_cast<unsigned char*>(reinterpret_cast<const unsigned char*>(image.samples.data())) +
                jpeg.next_scanline * row_bytes;
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  Bytes bytes(memory, memory + size);
  std::free(memory);
  return bytes;
}

void expect_near(const Image& a, const Image& b, int most) {
  ASSERT_EQ(a.size, b.size);
  ASSERT_EQ(a.channels, b.channels);
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    EXPECT_LE(std::abs(std::to_integer<int>(a.samples[i]) - std::to_integer<int>(b.samples[i])), most) << i;
  }
}

TEST(Jpeg, GreyAndColoursAreReadAndSaidToBeLossy) {
  const Image grey = random_image({17, 9}, 1, SampleType::u8);
  for (const bool progressive : {false, true}) {
    const Decoded read = decoded(jpeg_of(grey, JCS_GRAYSCALE, JCS_GRAYSCALE, progressive));
    expect_near(read.image, grey, 3);
    ASSERT_EQ(read.notes.size(), 1u);
    expect_text(read.notes[0], "lossy");
  }
  const Image colours = random_image({17, 9}, 3, SampleType::u8);
  expect_near(decoded(jpeg_of(colours, JCS_RGB, JCS_RGB)).image, colours, 3);
  EXPECT_EQ(decoded(jpeg_of(colours, JCS_RGB, JCS_YCbCr)).image.channels, 3);
}

TEST(Jpeg, CmykIsRefused) {
  const Image inks = random_image({8, 8}, 4, SampleType::u8);
  for (const J_COLOR_SPACE stored : {JCS_CMYK, JCS_YCCK})
    expect_text(refusal_of(jpeg_of(inks, JCS_CMYK, stored)), "CMYK");
}

TEST(Jpeg, HalfAPictureIsNone) {
  Bytes bytes = jpeg_of(random_image({64, 64}, 1, SampleType::u8), JCS_GRAYSCALE, JCS_GRAYSCALE);
  bytes.resize(bytes.size() - 2);
  expect_text(refusal_of(bytes), "not a whole JPEG");
  bytes.resize(bytes.size() / 2);
  expect_text(refusal_of(bytes), "not a whole JPEG");
}

TEST(Jpeg, Survives) {
  expect_survival(jpeg_of(random_image({9, 9}, 1, SampleType::u8), JCS_GRAYSCALE, JCS_GRAYSCALE));
  expect_survival(jpeg_of(random_image({9, 9}, 3, SampleType::u8), JCS_RGB, JCS_YCbCr, true));
}

// --- WebP ------------------------------------------------------------------------------------------

Bytes webp_of(const Image& image, bool lossless) {
  unsigned char* memory = nullptr;
  const auto* samples = reinterpret_cast<const unsigned char*>(image.samples.data());
  const auto [width, height] = image.size;
  const std::size_t size = !lossless ? WebPEncodeRGB(samples, width, height, width * 3, 90.0f, &memory)
                           : image.channels == 4
                               ? WebPEncodeLosslessRGBA(samples, width, height, width * 4, &memory)
                               : WebPEncodeLosslessRGB(samples, width, height, width * 3, &memory);
  Bytes bytes(memory, memory + size);
  WebPFree(memory);
  return bytes;
}

TEST(WebP, LosslessGivesTheStoredSamples) {
  for (const int channels : {3, 4}) {
    Image image = random_image({13, 7}, channels, SampleType::u8);
    // The encoder of this test drops the colours of clear pixels.
    for (std::size_t i = 3; channels == 4 && i < image.samples.size(); i += 4)
      image.samples[i] |= std::byte{1};
    const Decoded read = decoded(webp_of(image, true));
    EXPECT_TRUE(same_picture(read.image, image)) << channels;
    EXPECT_TRUE(read.notes.empty());
  }
  const Decoded lossy = decoded(webp_of(random_image({13, 7}, 3, SampleType::u8), false));
  ASSERT_EQ(lossy.notes.size(), 1u);
  expect_text(lossy.notes[0], "lossy");
}

TEST(WebP, HalfAPictureIsNone) {
  Bytes bytes = webp_of(random_image({64, 64}, 3, SampleType::u8), true);
  bytes.resize(bytes.size() / 2);
  expect_text(refusal_of(bytes), "not a whole WebP");
}

TEST(WebP, Survives) {
  expect_survival(webp_of(random_image({6, 5}, 3, SampleType::u8), true));
  expect_survival(webp_of(random_image({6, 5}, 3, SampleType::u8), false));
}

TEST(CompressedFormats, TheMemoryLimitHolds) {
  const Image grey = random_image({64, 64}, 1, SampleType::u8);
  expect_memory_limit(jpeg_of(grey, JCS_GRAYSCALE, JCS_GRAYSCALE));
  expect_memory_limit(webp_of(random_image({64, 64}, 3, SampleType::u8), true));
  expect_memory_limit(gif_of({64, 64, {{0, 0, 0}, {9, 9, 9}}, std::vector<GifByteType>(64 * 64, 1)}));
}

}  // namespace
}  // namespace bn::texture
