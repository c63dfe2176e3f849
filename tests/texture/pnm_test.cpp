// Protects: PBM, PGM, PPM and PFM give the samples that are stored, or a refusal that
// says why; nothing is scaled or converted without a word, and no file, cut short or damaged, crashes the
// reader.
#include "bn/volume.h"
#include "texture/rare_formats.h"

namespace bn::texture {
namespace {

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

TEST(Pnm, TheMemoryLimitHolds) {
  expect_memory_limit(bytes_from("P5 64 64 255\n" + std::string(64 * 64, 'x')));
}

TEST(Pnm, AFolderOfThemIsAVolume) {
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
