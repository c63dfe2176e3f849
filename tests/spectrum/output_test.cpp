// Protects: what leaves the room says what is in it: CSV columns, picture levels.
#include <gtest/gtest.h>

#include <algorithm>

#include "bn/error.h"
#include "direct_dft.h"

namespace bn {
namespace {

TEST(CurvesCsv, HasALineAnAnnulus) {
  const std::string picture = curves_csv(power_spectrum(test::white_values(256, 1), {16, 16}));
  EXPECT_EQ(picture.find("axis,frequency,power,anisotropy_db,count\nspace,0.0625,"), 0u);
  EXPECT_EQ(std::count(picture.begin(), picture.end(), '\n'), 1 + 11);  // corner at 16 / sqrt(2) = 11.3 steps
  const std::string volume = curves_csv(power_spectrum(test::white_values(256 * 8, 1), {16, 16, 8}));
  EXPECT_EQ(std::count(volume.begin(), volume.end(), '\n'), 1 + 11 + 4);
  EXPECT_NE(volume.find("\ntime,0.125,"), std::string::npos);
}

TEST(LogPicture, IsInDecibels) {
  PowerSpectrum power{.shape = {4, 4}, .half = std::vector<double>(12, 1.0)};
  power.half[0] = 0.0;
  power.half[1] = 1e9;
  power.half[2] = 1e-3;
  const Grid<std::uint8_t> picture = log_picture(power, -60.0, 60.0);
  EXPECT_EQ(picture(2, 2), 0);    // DC
  EXPECT_EQ(picture(3, 2), 255);  // 90 dB
  EXPECT_EQ(picture(0, 2), 64);   // -30 dB
  EXPECT_EQ(picture(2, 3), 128);  // 0 dB
  EXPECT_THROW(log_picture(power, 1.0, 1.0), Error);
}

}  // namespace
}  // namespace bn
