// Protects: BMP gives the samples that are stored, or a refusal that
// says why; nothing is scaled or converted without a word, and no file, cut short or damaged, crashes the
// reader.
#include "texture/rare_formats.h"

namespace bn::texture {
namespace {

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

TEST(Bmp, TheMemoryLimitHolds) {
  expect_memory_limit(bmp_of({.width = 64, .height = 64, .bits = 24, .rows = Bytes(64 * 64 * 3, 1)}));
}

}  // namespace
}  // namespace bn::texture
