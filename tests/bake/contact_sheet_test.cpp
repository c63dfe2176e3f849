// Protects: the contact sheet has every section it should, stays readable at odd sizes, and its
// letters exist.
#include "bake/canvas.h"
#include "bake/label_font.h"
#include "fixtures.h"

namespace bn {
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
