#include "bn/palette.h"

#include <algorithm>
#include <cmath>

namespace bn {
namespace {

std::uint8_t to_byte(double share) {
  return static_cast<std::uint8_t>(std::clamp(share, 0.0, 1.0) * 255.0 + 0.5);
}

Rgb8 colour_of(double x, double y, double longest) {
  // A plane of equal lightness in OKLab (Ottosson 2020), which needs no trigonometry: the move itself is the
  // pair (a, b). Gamma 2 in place of the sRGB curve, as a square root has the same bits everywhere.
  constexpr double kLightness = 0.74, kChroma = 0.17;
  double a = kChroma * x / longest, b = kChroma * -y / longest;
  const double beyond = std::sqrt(a * a + b * b) / kChroma;
  if (beyond > 1.0) a /= beyond, b /= beyond;
  const double l = kLightness + 0.3963377774 * a + 0.2158037573 * b;
  const double m = kLightness - 0.1055613458 * a - 0.0638541728 * b;
  const double s = kLightness - 0.0894841775 * a - 1.2914855480 * b;
  const double l3 = l * l * l, m3 = m * m * m, s3 = s * s * s;
  const auto channel = [](double linear) { return to_byte(std::sqrt(std::clamp(linear, 0.0, 1.0))); };
  return {channel(4.0767416621 * l3 - 3.3077115913 * m3 + 0.2309699292 * s3),
          channel(-1.2684380046 * l3 + 2.6097574011 * m3 - 0.3413193965 * s3),
          channel(-0.0041960863 * l3 - 0.7034186147 * m3 + 1.7076147010 * s3)};
}

}  // namespace

Rgb8 move_colour(Offset move, double longest) { return colour_of(move.x, move.y, longest); }

Grid<Rgb8> move_disc(int side, Rgb8 outside) {
  Grid<Rgb8> disc(Extent{side, side}, outside);
  const double radius = 0.5 * side;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double dx = x + 0.5 - radius, dy = y + 0.5 - radius;
      if (dx * dx + dy * dy <= radius * radius) disc(x, y) = colour_of(dx, dy, radius);
    }
  }
  return disc;
}

Rgb8 scale_colour(double share) {
  constexpr Rgb8 kStops[] = {{38, 40, 74}, {45, 84, 120}, {38, 130, 129}, {103, 178, 98}, {240, 218, 96}};
  constexpr int kSteps = 4;
  const double at = std::clamp(share, 0.0, 1.0) * kSteps;
  const int stop = std::min(static_cast<int>(at), kSteps - 1);
  const double rest = at - stop;
  const auto blend = [&](std::uint8_t low, std::uint8_t high) {
    return to_byte((low + (high - low) * rest) / 255.0);
  };
  const Rgb8 low = kStops[stop], high = kStops[stop + 1];
  return {blend(low.red, high.red), blend(low.green, high.green), blend(low.blue, high.blue)};
}

int schedule_colour_number(std::string_view schedule) {
  static constexpr std::array<std::string_view, 6> kInOrder{"exponential", "kirkpatrick", "linear",
                                                            "inverse",     "hajek",       "constant"};
  const auto found = std::find(kInOrder.begin(), kInOrder.end(), schedule);
  return static_cast<int>(found - kInOrder.begin());
}

}  // namespace bn
