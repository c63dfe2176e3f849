// Protects: a .h is C99 and C++ without a warning, whatever the recipe in its comment says, and a
// program that includes it sees the samples.
#include <cstdlib>

#include "texture/fixtures.h"

namespace bn::texture {
namespace {

int run(const std::string& command) { return std::system((command + " > /dev/null").c_str()); }

TEST(CHeader, CompilesAndHoldsTheSamples) {
  const TemporaryFolder folder;
  const Image moves = random_image({7, 5}, 3, SampleType::u8);
  const Image ranks = random_image({6, 4}, 1, SampleType::u16);
  const Image floats = image_of<float>({5, 1}, 1, SampleType::f32, {0.5f, -1.0f, 3e38f, 1e-45f, 0.1f});
  Metadata metadata = full_metadata();
  metadata.recipe += "*/ #error \"out of the comment\"\n/* // \\\n";
  write_image(folder / "1 tile-a.h", moves, metadata);
  write_image(folder / "int.h", ranks, metadata);
  write_image(folder / "floats.h", floats, metadata);

  std::string program =
      "#include \"1 tile-a.h\"\n#include \"int.h\"\n#include \"floats.h\"\n#include \"int.h\"\nint "
      "main(void) {\n"
      "  return !(sizeof bn_1_tile_a == 7 * 5 * 3 && BN_1_TILE_A_CHANNELS == 3 && BN_1_TILE_A_WIDTH == 7 &&\n"
      "    BN_1_TILE_A_HEIGHT == 5 && sizeof bn_int == 2 * 6 * 4 && BN_INT_CHANNELS == 1";
  const auto add = [&](const std::string& sample, auto value) {
    program += " &&\n    " + sample + " == " + value;
  };
  const auto text = [](int i) { return std::to_string(i); };
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 7; ++x) {
      for (int c = 0; c < 3; ++c) {
        add("bn_1_tile_a[" + text(y) + "][" + text(x) + "][" + text(c) + "]",
            text(samples_of<std::uint8_t>(moves)[static_cast<std::size_t>((y * 7 + x) * 3 + c)]));
      }
    }
  }
  add("bn_int[3][1]", text(samples_of<std::uint16_t>(ranks)[19]));
  const char* const exact[5] = {"0x1p-1f", "-1.0f", "3e38f", "0x1p-149f", "0.1f"};
  for (int x = 0; x < 5; ++x) add("bn_floats[0][" + text(x) + "]", std::string(exact[x]));
  program += ");\n}\n";
  put_bytes(folder / "program.c", program);

  const std::string source = "'" + (folder / "program.c").string() + "'",
                    binary = "'" + (folder / "program").string() + "'";
  if (run("gcc --version") != 0) GTEST_SKIP() << "no gcc";
  ASSERT_EQ(run("gcc -std=c99 -pedantic -Wall -Wextra -Werror " + source + " -o " + binary), 0);
  EXPECT_EQ(run(binary), 0) << "the program sees other samples";
  EXPECT_EQ(run("g++ -std=c++17 -pedantic -Wall -Wextra -Werror -fsyntax-only -x c++ " + source), 0);
}

TEST(CHeader, Golden) {
  // The layout that docs/files.md shows; readers of .h depend on it.
  const TemporaryFolder folder;
  Metadata metadata;
  metadata.tool_version = "1.2.3";
  metadata.kind = "mask";
  write_image(folder / "small.h", image_of<std::uint8_t>({3, 2}, 1, SampleType::u8, {0, 1, 2, 253, 254, 255}),
              metadata);
  const std::string text = bytes_of(folder / "small.h");
  EXPECT_EQ(text.substr(0, text.find("bn-metadata")),
            "/* Texture written by libbn 1.2.3: 3x2 pixels, channels: 1, 8bit.\nOrigin top-left; "
            "bn_small[y][x].\nThe channel is a blue-noise mask: samples are floor(rank x 256 / N), rank "
            "0..N-1, N = 6 pixels.\n\n");
  EXPECT_EQ(
      text.substr(text.find("*/")),
      "*/\n#ifndef BN_SMALL_H\n#define BN_SMALL_H\n\n#include <stdint.h>\n\n#define BN_SMALL_WIDTH 3\n"
      "#define BN_SMALL_HEIGHT 2\n#define BN_SMALL_CHANNELS 1\n\nstatic const uint8_t bn_small[2][3] = {\n"
      "  {0,1,2},\n  {253,254,255},\n};\n\n#endif /* BN_SMALL_H */\n");
}

TEST(CHeader, GoldenVolume) {
  const TemporaryFolder folder;
  Image volume = image_of<std::uint8_t>({2, 1}, 2, SampleType::u8, {0, 1, 2, 3, 4, 5, 6, 7});
  volume.depth = 2;
  Metadata metadata;
  metadata.tool_version = "1.2.3";
  write_image(folder / "small.h", volume, metadata);
  const std::string text = bytes_of(folder / "small.h");
  EXPECT_EQ(text.substr(0, text.find("bn-metadata")),
            "/* Texture written by libbn 1.2.3: 2x1x2 pixels, channels: 2, 8bit.\nOrigin top-left; "
            "bn_small[z][y][x][channel].\n2 slices of 2x1 pixels, one after the other; the volume wraps in z "
            "too.\n\n");
  EXPECT_EQ(
      text.substr(text.find("#define BN_SMALL_W")),
      "#define BN_SMALL_WIDTH 2\n#define BN_SMALL_HEIGHT 1\n#define BN_SMALL_CHANNELS 2\n"
      "#define BN_SMALL_DEPTH 2\n\nstatic const uint8_t bn_small[2][1][2][2] = {\n {\n  {{0,1},{2,3}},\n },\n"
      " {\n  {{4,5},{6,7}},\n },\n};\n\n#endif /* BN_SMALL_H */\n");
}

TEST(CHeader, SaysWhatTheChannelsOfAnAtlasMean) {
  Metadata metadata;
  metadata.kind = "retarget-atlas";
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) metadata.tiles.push_back({.motion = {x, y}});
  }
  const auto sentences = content_description(random_image({12, 9}, 3, SampleType::u8), metadata);
  ASSERT_EQ(sentences.size(), 2u);
  EXPECT_NE(sentences[0].find("Channel 0 is x + 128, channel 1 is y + 128"), std::string::npos)
      << sentences[0];
  EXPECT_NE(sentences[1].find("3x3 tiles of 4x3 pixels"), std::string::npos) << sentences[1];
  EXPECT_NE(sentences[1].find("x -1..1 from left to right"), std::string::npos) << sentences[1];
}

TEST(CHeader, NamesTheChannelsThatThereAre) {
  Metadata metadata;
  metadata.kind = "retarget-tile";
  const auto first = [&](int channels, SampleType type) {
    const std::string sentence = content_description(random_image({2, 2}, channels, type), metadata).at(0);
    return sentence.substr(0, sentence.find(':'));
  };
  EXPECT_EQ(first(2, SampleType::u8), "Channel 0 is x + 128, channel 1 is y + 128");
  EXPECT_EQ(first(3, SampleType::f16), "Channel 0 is x, channel 1 is y, channel 2 is 0");
  metadata.facts.add("step_z", 1);
  EXPECT_EQ(first(4, SampleType::u8),
            "Channel 0 is x + 128, channel 1 is y + 128, channel 2 is z + 128, channel 3 is 255");
  EXPECT_EQ(first(4, SampleType::f16), "Channel 0 is x, channel 1 is y, channel 2 is z, channel 3 is 1");
}

}  // namespace
}  // namespace bn::texture
