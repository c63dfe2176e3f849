// Protects: PNG files of every layout give the samples that are stored in them, and the masks that others
// have published are read as the permutations that they are.
#include <png.h>

#include <map>

#include "texture/rare_formats.h"

namespace bn::texture {
namespace {

/// A PNG made with libpng, as the test says.
struct PngRecipe {
  int width, height, depth, type;
  bool interlaced = false;
  std::vector<png_color> palette = {};
  std::vector<png_byte> palette_alpha = {};
  bool text_at_end = false;
  bool marks_a_colour = false;
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
  if (recipe.marks_a_colour) {
    png_color_16 colour = {};
    colour.gray = colour.red = colour.green = colour.blue = 1;
    png_set_tRNS(png, info, nullptr, 0, &colour);
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
    const Image image = decoded(png_of({values, 1, depth, PNG_COLOR_TYPE_GRAY}, packed, 0)).image;
    EXPECT_EQ(image.type, SampleType::u8);
    EXPECT_EQ(image.channels, 1);
    EXPECT_EQ(samples_of<std::uint8_t>(image), expected) << depth;
  }
}

TEST(ForeignPng, PalettesAreExpanded) {
  const std::vector<png_color> palette = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  const std::vector<std::uint8_t> indices = {0, 1, 2, 2};
  const Image colours = decoded(png_of({2, 2, 8, PNG_COLOR_TYPE_PALETTE, false, palette}, indices, 2)).image;
  EXPECT_EQ(colours.channels, 3);
  EXPECT_EQ(samples_of<std::uint8_t>(colours),
            (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8, 9, 7, 8, 9}));
  const Image with_alpha =
      decoded(png_of({2, 2, 8, PNG_COLOR_TYPE_PALETTE, false, palette, {10, 20}}, indices, 2)).image;
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
          decoded(png_of({13, 11, 8, type, interlaced}, samples_of<std::uint8_t>(image), 13 * channels))
              .image,
          image));
    }
  }
}

TEST(ForeignPng, AColourThatIsMarkedAsTransparentAddsNoChannel) {
  for (const auto& [type, channels, depth] :
       {std::tuple{PNG_COLOR_TYPE_GRAY, 1, 8}, {PNG_COLOR_TYPE_GRAY, 1, 16}, {PNG_COLOR_TYPE_RGB, 3, 8}}) {
    const std::vector<std::uint8_t> packed = {0, 1, 2, 3, 1, 1, 1, 1, 1, 1, 7, 255};
    const int width = 12 / channels / (depth / 8);
    const Bytes bytes = png_of(
        {.width = width, .height = 1, .depth = depth, .type = type, .marks_a_colour = true}, packed, 0);
    const Decoded read = decoded(bytes);
    EXPECT_EQ(read.image.channels, channels);
    EXPECT_EQ(read.image.samples.size(), packed.size());
    if (depth == 8) {
      EXPECT_EQ(samples_of<std::uint8_t>(read.image), packed);
    }
    ASSERT_EQ(read.notes.size(), 1u);
    EXPECT_NE(read.notes[0].find("tRNS"), std::string::npos);
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
