// Protects: the contact sheet has every section it should, stays readable at odd sizes, and its
// letters exist.
#include <cmath>
#include <numbers>
#include <set>

#include "bake/canvas.h"
#include "bake/label_font.h"
#include "bake/sheet_spectrum.h"
#include "bn/random.h"
#include "fixtures.h"

namespace bn {
using namespace baking;

namespace {

TEST(ContactSheet, HasASectionForEverySetAndLoneMask) {
  const TemporaryFolder out;
  const auto height = [&](const std::string& recipe) {
    bake(parse_recipe("version = 1\n" + recipe, "r", ""), {.out_dir = out, .force = true});
    return read_image(out / "contact_sheet.png").image.size.height;
  };
  const std::string mask = "[[mask]]\nname = 'm'\nsize = [8, 8]\noutputs = ['m.png']\n";
  const std::string wide = "[[mask]]\nname = 'w'\nsize = [700, 2]\noutputs = ['w.png']\n";
  const std::string set = "[[retarget]]\nname = 'r'\nmask = 'm'\nradius = 2\noutputs = ['r.png']\n";
  const int one_mask = height(mask);
  EXPECT_GT(height(mask + set), one_mask) << "a set has two rows";
  EXPECT_GT(height(mask + wide), one_mask);
  EXPECT_EQ(height(mask + wide) - one_mask, height(mask + set + wide) - height(mask + set));
}

TEST(ContactSheet, PutsManyMasksIntoAGrid) {
  const TemporaryFolder out;
  const auto size = [&](int masks) {
    std::string recipe = "version = 1\n";
    for (int i = 0; i < masks; ++i) {
      recipe += "[[mask]]\nname = 'm" + std::to_string(i) + "'\nsize = [8, 8]\noutputs = ['m" +
                std::to_string(i) + ".png']\n";
    }
    bake(parse_recipe(recipe, "r", ""), {.out_dir = out, .force = true});
    return read_image(out / "contact_sheet.png").image.size;
  };
  EXPECT_LT(size(32).height, 2100);
  EXPECT_EQ(size(32).height - size(28).height, size(28).height - size(24).height) << "four in a row";
  EXPECT_EQ(size(29), size(32));
  EXPECT_EQ(size(1).width, size(32).width);
}

TEST(ContactSheet, ShowsSpatiotemporalMasks) {
  const TemporaryFolder out;
  const std::string stack = "[[spatiotemporal]]\nname = 's'\nsize = [16, 16, 4]\noutputs = ['s.ktx2']\n";
  const std::string set = "[[retarget]]\nname = 'r'\nmask = 's'\nradius = 2\noutputs = ['t.ktx2']\n";
  const auto sheet = [&](const std::string& recipe) {
    bake(parse_recipe("version = 1\n" + recipe, "r", ""), {.out_dir = out, .force = true});
    return read_image(out / "contact_sheet.png").image;
  };
  const Image one = sheet(stack);
  // A row of four panels: each differs from the paper.
  EXPECT_GT(one.size.height, 400);
  const auto pixel = [&](int x, int y) {
    return static_cast<int>(one.samples[static_cast<std::size_t>(3 * (y * one.size.width + x))]);
  };
  for (const int column : {0, 1, 2, 3}) {
    std::set<int> levels;
    for (int y = 150; y < 390; ++y) levels.insert(pixel(60 + 296 * column + 128, y));
    EXPECT_GT(levels.size(), 2u) << "column " << column;
  }
  EXPECT_GT(sheet(stack + set).size.height, one.size.height);
}

TEST(SheetSpectrum, InTimeIsThePowerOfRowsOverTheSlices) {
  // Along x white, in time a wave of two frames: all power is at half a cycle a frame.
  Grid<std::int32_t> volume(Shape{16, 8, 4});
  for (int z = 0; z < 4; ++z) {
    for (std::size_t i = 0; i < 128; ++i) {
      const auto level = static_cast<std::int32_t>(random_bits(1, 0, i) & 255u);
      volume[static_cast<std::size_t>(z) * 128 + i] = z % 2 == 0 ? level : 255 - level;
    }
  }
  const Grid<std::uint8_t> power = sheet_spectrum_in_time(volume);
  ASSERT_EQ(power.size(), (Extent{16, 4}));
  for (int x = 0; x < 16; ++x) {
    EXPECT_EQ(power(x, 1), 0) << "a quarter of a cycle";
    EXPECT_EQ(power(x, 3), 0);
    EXPECT_GT(power(x, 0), 150) << "half a cycle";
  }
  EXPECT_EQ(row_in_time(volume, 3)(5, 2), volume[2 * 128 + 3 * 16 + 5]);
}

TEST(SheetSpectrum, IsThePowerInDecibels) {
  // A wave: two frequencies hold all power; N/2 each against white noise.
  Grid<std::int32_t> wave(Extent{32, 16});
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 32; ++x) {
      wave(x, y) = static_cast<std::int32_t>(
          std::lround(100000 * std::cos(2 * std::numbers::pi * (3 * x / 32.0 + y / 16.0))));
    }
  }
  const Grid<std::uint8_t> power = sheet_spectrum(wave);
  ASSERT_EQ(power.size(), (Extent{32, 16}));
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 32; ++x) {
      const bool there = (x == 16 + 3 && y == 8 + 1) || (x == 16 - 3 && y == 8 - 1);
      EXPECT_EQ(power(x, y), there ? 255 : 0) << x << " " << y;
    }
  }
}

TEST(SheetSpectrum, FoldsLargeMasksAndLeavesOutWhatItCannot) {
  EXPECT_EQ(sheet_spectrum(Grid<std::int32_t>(Extent{8, 8}, 5)).count(), 0u);
  Grid<std::int32_t> noise(Extent{512, 300});
  for (std::size_t i = 0; i < noise.count(); ++i)
    noise[i] = static_cast<std::int32_t>(random_bits(1, 0, i) & 255u);
  const Grid<std::uint8_t> power = sheet_spectrum(noise);
  EXPECT_EQ(power.size(), (Extent{128, 100}));
  double mean = 0.0;
  for (const std::uint8_t level : power) mean += level / static_cast<double>(power.count());
  EXPECT_NEAR(mean, 255 * (50 - 2.5) / 62.5, 3.0);  // white noise reads 0 dB, its decibels -2.5 in the mean
  EXPECT_EQ(sheet_spectrum(Grid<std::int32_t>(Extent{257, 8}, 1)).count(), 0u);
}

TEST(ContactSheet, IsLeftOutOnRequest) {
  const TemporaryFolder out;
  bake(parse_recipe(
           "version = 1\ncontact_sheet = ''\n[[mask]]\nname = 'm'\nsize = [8, 8]\noutputs = ['m.png']\n", "r",
           ""),
       {.out_dir = out});
  EXPECT_EQ(contents_of(out).size(), 2u);
}

TEST(LabelFont, HasEveryCharacterACaptionMayUse) {
  const auto pixels = [](char c) {
    std::string bits;
    for (int y = 0; y < kGlyphHeight; ++y) {
      for (int x = 0; x < kGlyphWidth; ++x) bits += glyph_pixel(c, x, y) ? '#' : ' ';
    }
    return bits;
  };
  const std::string used = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.,:()%|=+/";
  std::map<std::string, char> seen;
  for (const char c : used) {
    EXPECT_NE(pixels(c), pixels('?')) << c;
    EXPECT_TRUE(seen.emplace(pixels(c), c).second) << c << " looks like " << seen[pixels(c)];
  }
  EXPECT_EQ(pixels('\x01'), pixels('?'));
}

}  // namespace
}  // namespace bn
