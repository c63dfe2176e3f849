// Protects: PBM, PGM, PPM, PFM, BMP, GIF, JPEG and WebP give the samples that are stored, or a refusal that
// says why; none is scaled or converted without a word, and none of their files, cut short or damaged,
// crashes the reader.
#include <cstdio>
// jpeglib.h needs FILE.
#include <gif_lib.h>
#include <jpeglib.h>
#include <webp/encode.h>

#include "bn/error.h"
#include "bn/volume.h"
#include "texture/codec.h"
#include "texture/fixtures.h"

namespace bn::texture {
namespace {

Bytes bytes_from(std::string_view text) { return {text.begin(), text.end()}; }
Decoded decoded(const Bytes& bytes) { return decode(std::as_bytes(std::span(bytes)), "rare", {}); }
std::string refusal_of(const Bytes& bytes) {
  const auto error = error_of([&] { decoded(bytes); });
  if (!error) return "nothing was thrown";
  EXPECT_EQ(error->code, ErrorCode::invalid_input);
  return error->what;
}

void expect_text(const std::string& text, std::string_view part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

template <class Sample>
void expect_samples(const Image& image, SampleType type, const std::vector<Sample>& samples) {
  EXPECT_EQ(image.type, type);
  EXPECT_EQ(samples_of<Sample>(image), samples);
}

/// Every prefix and every damaged byte: an image or a bn::Error.
void expect_survival(const Bytes& whole) {
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

// --- PBM, PGM, PPM, PFM ----------------------------------------------------------------------------

Bytes pgm16(int maxval, const std::vector<int>& samples) {
  Bytes bytes = bytes_from("P5\n" + std::to_string(samples.size()) + " 1\n" + std::to_string(maxval) + "\n");
  for (const int sample : samples) {
    if (maxval > 255) bytes.push_back(static_cast<unsigned char>(sample >> 8));
    bytes.push_back(static_cast<unsigned char>(sample & 255));
  }
  return bytes;
}

TEST(Pnm, EverySampleOf16BitsIsTheStoredOne) {
  std::vector<int> all;
  for (int i = 0; i < 65536; ++i) all.push_back(i);
  const Decoded read = decoded(pgm16(65535, all));
  expect_samples(read.image, SampleType::u16, std::vector<std::uint16_t>(all.begin(), all.end()));
  EXPECT_TRUE(read.notes.empty());
}

TEST(Pnm, AnyMaxvalLeavesTheSamplesAsTheyAreAndIsNoted) {
  for (const int maxval : {1, 2, 100, 254, 255, 256, 1000, 1023, 4095, 32768, 65534, 65535}) {
    const std::vector<int> samples = {0, 1, maxval / 2, maxval};
    const std::string text = "P2 # a comment\n4 1 #another\n" + std::to_string(maxval) + "\n0 1\n" +
                             std::to_string(maxval / 2) + "\t" + std::to_string(maxval);
    for (const Bytes& bytes : {pgm16(maxval, samples), bytes_from(text)}) {
      SCOPED_TRACE(maxval);
      const Decoded read = decoded(bytes);
      if (maxval < 256) {
        expect_samples(read.image, SampleType::u8, std::vector<std::uint8_t>(samples.begin(), samples.end()));
      } else {
        expect_samples(read.image, SampleType::u16,
                       std::vector<std::uint16_t>(samples.begin(), samples.end()));
      }
      const bool usual = maxval == 255 || maxval == 65535;
      ASSERT_EQ(read.notes.size(), usual ? 0u : 1u);
      if (!usual) expect_text(read.notes[0], "maxval is " + std::to_string(maxval));
    }
  }
}

TEST(Pnm, ColoursBitmapsAndFloats) {
  const Image colours = decoded(bytes_from("P6 2 1 255\nabcdef")).image;
  EXPECT_EQ(colours.channels, 3);
  expect_samples(colours, SampleType::u8, std::vector<std::uint8_t>{'a', 'b', 'c', 'd', 'e', 'f'});
  expect_samples(decoded(bytes_from("P3\n1 1 1000\n1 2 1000")).image, SampleType::u16,
                 std::vector<std::uint16_t>{1, 2, 1000});
  // In a bitmap 1 is black.
  const std::vector<std::uint8_t> bits = {0, 255, 0, 255, 255, 255, 255, 255, 255, 0};
  for (const Bytes& bytes :
       {bytes_from("P1\n10 1\n1010000 00 1"), bytes_from(std::string_view("P4\n10 1\n\xa0\x40"))}) {
    const Decoded read = decoded(bytes);
    expect_samples(read.image, SampleType::u8, bits);
    EXPECT_EQ(read.notes.size(), 1u);
  }
  const std::vector<float> floats = {1.5f, -2.0f, 3e-8f, 4.0f};  // two rows; in the file the last comes first
  for (const bool little : {true, false}) {
    Bytes bytes = bytes_from(little ? "Pf\n2 2\n-1.0\n" : "Pf\n2 2\n2.5\n");
    for (const std::size_t i : {2u, 3u, 0u, 1u}) {
      unsigned char four[4];
      std::memcpy(four, &floats[i], 4);
      if (!little) std::reverse(four, four + 4);
      bytes.insert(bytes.end(), four, four + 4);
    }
    const Decoded read = decoded(bytes);
    expect_samples(read.image, SampleType::f32, floats);
    EXPECT_EQ(read.notes.size(), little ? 0u : 1u) << "a scale other than 1 is noted";
  }
}

TEST(Pnm, WhatIsWrongIsNamed) {
  for (const auto& [text, part] : std::vector<std::pair<std::string, std::string>>{
           {"P5\n", "width is missing"},
           {"P5 4", "height is missing"},
           {"P5 4 4", "maxval is missing"},
           {"P5 4 4 255", "cut short in its header"},
           {"P5 4 4 255\nabc", "3 bytes of samples where its header needs 16"},
           {"P5 0 4 255\n", "0x4"},
           {"P5 65537 1 255\n", "65537x1"},
           {"P5 99999999999999999999 1 255\n", "width is no whole number"},
           {"P5 -4 1 255\n", "width is no whole number"},
           {"P5 2 1 0\nab", "maxval of 0"},
           {"P5 2 1 65536\nabcd", "maxval of 65536"},
           {"P5 2 1 100\n\x01\x65", "sample 1 is 101"},
           {"P2 2 1 100\n1 101", "sample 1 is 101"},
           {"P2 2 1 100\n1 x", "a sample is no whole number"},
           {"P1 2 1\n1 2", "neither 0 nor 1"},
           {"P1 3 1\n10 ", "cut short"},
           {"P2 3 1 9\n1   2", "a sample is missing"},
           {"Pf 1 1 0\nabcd", "scale"},
           {"Pf 1 1 x\nabcd", "scale"},
           {"P6 65535 65535 65535\nab", "2 bytes of samples"}}) {
    expect_text(refusal_of(bytes_from(text)), part);
  }
}

TEST(Pnm, FurtherPicturesAreNoted) {
  const Decoded read = decoded(bytes_from("P5 1 1 255\naP5 1 1 255\nb"));
  expect_samples(read.image, SampleType::u8, std::vector<std::uint8_t>{'a'});
  ASSERT_EQ(read.notes.size(), 1u);
  expect_text(read.notes[0], "further pictures");
}

TEST(Pnm, Survives) {
  expect_survival(pgm16(1000, {1, 2, 3, 1000}));
  expect_survival(bytes_from("P3\n2 1 255\n1 2 3 4 5 6\n"));
  expect_survival(bytes_from("P1\n3 2\n101\n010\n"));
  expect_survival(bytes_from("PF\n1 1\n-1\nabcdefghijkl"));
}

// --- BMP -------------------------------------------------------------------------------------------

void put_number(Bytes& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<unsigned char>(value >> 8 * i & 255));
}

struct Bmp {
  int width = 0, height = 0, bits = 0;
  std::uint32_t compression = 0;
  std::vector<std::array<unsigned char, 4>> palette = {};  ///< blue, green, red, 0
  std::vector<std::uint32_t> masks = {};
  Bytes rows = {};  ///< as in the file
};

Bytes bmp_of(const Bmp& bmp) {
  Bytes bytes = bytes_from("BM");
  const auto header = static_cast<std::uint32_t>(bmp.masks.size() == 4 ? 56 : 40);
  const auto begin =
      static_cast<std::uint32_t>(14 + header + bmp.palette.size() * 4 + (bmp.masks.size() == 3 ? 12 : 0));
  put_number(bytes, begin + static_cast<std::uint32_t>(bmp.rows.size()), 4);
  put_number(bytes, 0, 4);
  put_number(bytes, begin, 4);
  put_number(bytes, header, 4);
  put_number(bytes, static_cast<std::uint32_t>(bmp.width), 4);
  put_number(bytes, static_cast<std::uint32_t>(bmp.height), 4);
  put_number(bytes, 1, 2);
  put_number(bytes, static_cast<std::uint32_t>(bmp.bits), 2);
  put_number(bytes, bmp.compression, 4);
  for (int i = 0; i < 3; ++i) put_number(bytes, 0, 4);
  put_number(bytes, static_cast<std::uint32_t>(bmp.palette.size()), 4);
  put_number(bytes, 0, 4);
  for (const std::uint32_t mask : bmp.masks) put_number(bytes, mask, 4);
  for (const auto& colour : bmp.palette) bytes.insert(bytes.end(), colour.begin(), colour.end());
  bytes.insert(bytes.end(), bmp.rows.begin(), bmp.rows.end());
  return bytes;
}

TEST(Bmp, RowsOfColourFromTheBottomAndFromTheTop) {
  const Bytes rows = {3, 2, 1, 6, 5, 4, 0, 0, 9, 8, 7, 12, 11, 10, 0, 0};
  const std::vector<std::uint8_t> up = {7, 8, 9, 10, 11, 12, 1, 2, 3, 4, 5, 6};
  const std::vector<std::uint8_t> down = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  const Image image = decoded(bmp_of({.width = 2, .height = 2, .bits = 24, .rows = rows})).image;
  EXPECT_EQ(image.channels, 3);
  expect_samples(image, SampleType::u8, up);
  expect_samples(decoded(bmp_of({.width = 2, .height = -2, .bits = 24, .rows = rows})).image, SampleType::u8,
                 down);
}

TEST(Bmp, APaletteOfGreysIsOneChannel) {
  std::vector<std::array<unsigned char, 4>> greys, colours = {{3, 2, 1, 0}, {6, 5, 4, 0}};
  for (int i = 0; i < 256; ++i) {
    const auto grey = static_cast<unsigned char>(i);
    greys.push_back({grey, grey, grey, 0});
  }
  const Image grey =
      decoded(bmp_of({.width = 3, .height = 1, .bits = 8, .palette = greys, .rows = {0, 7, 255, 0}})).image;
  EXPECT_EQ(grey.channels, 1);
  expect_samples(grey, SampleType::u8, std::vector<std::uint8_t>{0, 7, 255});
  const Image two =
      decoded(bmp_of({.width = 3, .height = 1, .bits = 1, .palette = colours, .rows = {0x40, 0, 0, 0}}))
          .image;
  expect_samples(two, SampleType::u8, std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 1, 2, 3});
  expect_text(
      refusal_of(bmp_of({.width = 3, .height = 1, .bits = 8, .palette = colours, .rows = {0, 1, 2, 0}})),
      "colour 2 of a palette of 2");
}

TEST(Bmp, AlphaIsReadWhereTheHeaderSaysSo) {
  const Bytes rows = {3, 2, 1, 99, 6, 5, 4, 200};
  const Decoded plain = decoded(bmp_of({.width = 2, .height = 1, .bits = 32, .rows = rows}));
  expect_samples(plain.image, SampleType::u8, std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6});
  EXPECT_EQ(plain.notes.size(), 1u) << "a byte that is left out is noted";
  const std::vector<std::uint32_t> masks = {0xff0000, 0xff00, 0xff, 0xff000000};
  const Image alpha =
      decoded(bmp_of({.width = 2, .height = 1, .bits = 32, .compression = 3, .masks = masks, .rows = rows}))
          .image;
  expect_samples(alpha, SampleType::u8, std::vector<std::uint8_t>{1, 2, 3, 99, 4, 5, 6, 200});
}

TEST(Bmp, WhatIsNotReadIsNamed) {
  const Bytes rows(64, 0);
  expect_text(refusal_of(bmp_of({.width = 4, .height = 4, .bits = 8, .compression = 1, .rows = rows})),
              "compression 1");
  expect_text(refusal_of(bmp_of({.width = 4, .height = 4, .bits = 16, .rows = rows})), "16 bits a pixel");
  expect_text(refusal_of(bmp_of({.width = 4,
                                 .height = 4,
                                 .bits = 32,
                                 .compression = 3,
                                 .masks = {0xff, 0xff00, 0xff0000},
                                 .rows = rows})),
              "no whole bytes");
  expect_text(refusal_of(bmp_of({.width = 4, .height = 6, .bits = 24, .rows = rows})), "cut short");
  expect_text(refusal_of(bmp_of({.width = 0, .height = 6, .bits = 24, .rows = rows})), "0x6");
  expect_text(
      refusal_of(bmp_of({.width = 4, .height = std::numeric_limits<int>::min(), .bits = 24, .rows = rows})),
      "an image of");
}

TEST(Bmp, Survives) {
  expect_survival(bmp_of({.width = 2, .height = 2, .bits = 24, .rows = Bytes(16, 1)}));
  expect_survival(
      bmp_of({.width = 9, .height = 1, .bits = 4, .palette = {{1, 1, 1, 0}}, .rows = Bytes(8, 0)}));
}

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

TEST(RareFormats, TheMemoryLimitHolds) {
  const Image grey = random_image({64, 64}, 1, SampleType::u8);
  const Image colours = random_image({64, 64}, 3, SampleType::u8);
  const std::vector<Bytes> files = {
      jpeg_of(grey, JCS_GRAYSCALE, JCS_GRAYSCALE), webp_of(colours, true),
      gif_of({64, 64, {{0, 0, 0}, {9, 9, 9}}, std::vector<GifByteType>(64 * 64, 1)}),
      bmp_of({.width = 64, .height = 64, .bits = 24, .rows = Bytes(64 * 64 * 3, 1)}),
      bytes_from("P5 64 64 255\n" + std::string(64 * 64, 'x'))};
  for (const Bytes& bytes : files) {
    const auto error = error_of([&] {
      decode(std::as_bytes(std::span(bytes)), "rare", {.memory_limit_bytes = bytes.size() + 1000});
    });
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->code, ErrorCode::over_limit) << error->what;
  }
}

TEST(RareFormats, AFolderOfThemIsAVolume) {
  const TemporaryFolder folder;
  for (const char* name : {"s_1.pgm", "s_0.pgm", "s_2.pgm"})
    put_bytes(folder / name, "P5 1 1 255\n" + std::string(name));
  const Volume volume = read_volume(folder.path());
  EXPECT_EQ(volume.image.depth, 3);
  for (const char* name : {"a.bmp", "a.gif", "a.jpg", "a.webp", "a.pbm", "a.txt"})
    put_bytes(folder / name, "");
  EXPECT_EQ(image_files(folder.path()).size(), 8u);
}

}  // namespace
}  // namespace bn::texture
