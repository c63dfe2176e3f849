// Protects: a vector mask is made, kept and verified as a kind of texture; its samples are its values; its
// options are read and written as declared, and mistakes are named before the work.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "bn/error.h"
#include "bn/volume.h"
#include "fixtures.h"

namespace bn {
namespace {

const std::string kRecipe =
    "version = 1\ncontact_sheet = ''\n"
    "[[vector]]\nname = 'v'\nvalues = 'hemisphere'\nsize = [16, 12, 3]\nbudget = 2\n"
    "outputs = ['v_%d.png', { path = 'fine.bin', type = '16bit' }, { path = 'v.exr', type = 'float' }]\n";

VectorEntry entry_of(VectorValues values, const std::string& path, SampleType type) {
  VectorEntry entry;
  entry.name = "v";
  entry.vectors.values = values;
  entry.vectors.mask.size = {16, 12, 2};
  entry.vectors.budget = 1;
  entry.outputs = {{.path = path, .type = type}};
  return entry;
}

double share_of(const Image& image, std::size_t sample) {
  if (image.type == SampleType::u8) return (std::to_integer<int>(image.samples[sample]) + 0.5) / 256.0;
  if (image.type == SampleType::u16) {
    std::uint16_t level;
    std::memcpy(&level, image.samples.data() + 2 * sample, 2);
    return (level + 0.5) / 65536.0;
  }
  float value;
  std::memcpy(&value, image.samples.data() + 4 * sample, 4);
  return value;
}

TEST(VectorKind, IsReadAsWritten) {
  const Recipe recipe = parse_recipe(kRecipe, "r", "");
  const auto& entry = dynamic_cast<const VectorEntry&>(*recipe.entries.at(0));
  EXPECT_EQ(entry.vectors.values, VectorValues::hemisphere);
  EXPECT_EQ(entry.vectors.mask.size, (Shape{16, 12, 3}));
  EXPECT_EQ(entry.vectors.budget, 2);
  const std::string written = recipe_text(recipe);
  EXPECT_EQ(recipe_text(parse_recipe(written, "again", "")), written);
}

TEST(VectorKind, MistakesAreNamedWithTheRange) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = kRecipe;
    try {
      parse_recipe(text.replace(text.find(from), from.size(), to), "r", "");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(with("'hemisphere'", "'vec5'").find("values is 'vec5'"), std::string::npos);
  EXPECT_NE(with("budget = 2", "budget = -1").find("budget is -1"), std::string::npos);
  EXPECT_NE(with("budget = 2", "slice_share = 2.0").find("slice_share is 2"), std::string::npos);
}

TEST(VectorKind, IsBakedKeptAndVerified) {
  const TemporaryFolder out;
  const Recipe recipe = parse_recipe(kRecipe, "r", "");
  EXPECT_FALSE(bake(recipe, {.out_dir = out}).jobs.at(0).skipped);
  EXPECT_TRUE(bake(recipe, {.out_dir = out}).jobs.at(0).skipped);
  EXPECT_EQ(failures(verify_path(out)), "");
  // One slice that changes is found.
  FileContent slice = read_image(out / "v_1.png");
  std::swap(slice.image.samples[0], slice.image.samples[4]);
  write_image(out / "v_1.png", slice.image, *slice.metadata);
  EXPECT_NE(failures(verify_path(out / "v_1.png")).find("pixels: "), std::string::npos);
}

TEST(VectorKind, SamplesAreTheValues) {
  for (const VectorValues values : {VectorValues::vec2, VectorValues::vec3, VectorValues::vec4,
                                    VectorValues::circle, VectorValues::sphere, VectorValues::hemisphere}) {
    for (const SampleType type : {SampleType::u8, SampleType::u16, SampleType::f32}) {
      const VectorEntry entry = entry_of(values, "v.bin", type);
      const Image image = bake_entry(entry).files.at(0).image;
      const Grid<std::uint32_t> places = vector_mask(entry.vectors);
      const auto channels = static_cast<std::size_t>(image.channels);
      ASSERT_EQ(channels,
                values == VectorValues::circle ? 1u : static_cast<std::size_t>(vector_components(values)));
      const bool halved =
          type != SampleType::f32 && (values == VectorValues::sphere || values == VectorValues::hemisphere);
      const double step = type == SampleType::u8 ? 1.0 / 512 : 1.0 / 131072;
      for (std::size_t i = 0; i < places.count(); ++i) {
        for (std::size_t c = 0; c < channels; ++c) {
          const double expected = values == VectorValues::circle ? std::ldexp(double(places[i]), -32)
                                                                 : double{vector_value(values, places[i])[c]};
          const double share = share_of(image, i * channels + c);
          ASSERT_NEAR(halved ? 2.0 * share - 1.0 : share, expected, halved ? 2.01 * step : 1.01 * step)
              << name_of(values) << " " << i;
        }
      }
    }
  }
}

}  // namespace
}  // namespace bn
