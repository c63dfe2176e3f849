#include "report/pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "bn/palette.h"

namespace bn::report {
namespace {

using Colour = std::array<double, 3>;  // sRGB, 0..1

Image colour_image(Extent size, const std::function<Colour(int x, int y)>& colour) {
  Image image{.size = size, .channels = 3, .type = SampleType::u8, .samples = {}};
  image.samples.reserve(static_cast<std::size_t>(size.area()) * 3);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      for (const double part : colour(x, y)) {
        image.samples.push_back(static_cast<std::byte>(std::lround(255.0 * std::clamp(part, 0.0, 1.0))));
      }
    }
  }
  return image;
}

Image palette_image(Extent size, const std::function<Rgb8(int x, int y)>& colour) {
  Image image{.size = size, .channels = 3, .type = SampleType::u8, .samples = {}};
  image.samples.reserve(static_cast<std::size_t>(size.area()) * 3);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Rgb8 c = colour(x, y);
      for (const std::uint8_t part : {c.red, c.green, c.blue}) image.samples.push_back(std::byte{part});
    }
  }
  return image;
}

Colour mixed(const Colour& a, const Colour& b, double share) {
  Colour result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = a[i] + share * (b[i] - a[i]);
  return result;
}

double smooth(double low, double high, double value) {
  const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace

Image grey_image(const Grid<std::uint8_t>& grey) {
  Image image{.size = grey.size(), .channels = 1, .type = SampleType::u8, .samples = {}};
  image.samples.resize(grey.count());
  std::memcpy(image.samples.data(), grey.data(), grey.count());
  return image;
}

Grid<std::uint8_t> window(const Grid<std::uint8_t>& grey, int x, int y, Extent size) {
  Grid<std::uint8_t> part(size);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) part(u, v) = grey.torus(x + u, y + v);
  }
  return part;
}

Image spectrum_image(const PowerSpectrum& power, int side) {
  const Grid<std::uint8_t> full = log_picture(power);
  const int block = (std::max(full.width(), full.height()) + side - 1) / side;
  if (block <= 1) return grey_image(full);
  Grid<std::uint8_t> small({std::max(1, full.width() / block), std::max(1, full.height() / block)});
  const int across = std::min(block, full.width()), down = std::min(block, full.height());
  for (int y = 0; y < small.height(); ++y) {
    for (int x = 0; x < small.width(); ++x) {
      int sum = 0;
      for (int v = 0; v < down; ++v) {
        for (int u = 0; u < across; ++u) sum += full(x * across + u, y * down + v);
      }
      small(x, y) = static_cast<std::uint8_t>(sum / (across * down));
    }
  }
  return grey_image(small);
}

Image made_square(const Image& image) {
  const int down = std::max(1, image.size.width / std::max(1, image.size.height));
  const int across = std::max(1, image.size.height / std::max(1, image.size.width));
  Image result = image;
  result.size = {image.size.width * across, image.size.height * down};
  result.samples.clear();
  const auto pixel_bytes = static_cast<std::ptrdiff_t>(image.samples.size()) /
                           (std::int64_t{image.size.width} * image.size.height);
  for (int y = 0; y < result.size.height; ++y) {
    for (int x = 0; x < result.size.width; ++x) {
      const auto at =
          image.samples.begin() + (std::int64_t{y / down} * image.size.width + x / across) * pixel_bytes;
      result.samples.insert(result.samples.end(), at, at + pixel_bytes);
    }
  }
  return result;
}

Image signed_image(const Grid<double>& values, double full) {
  constexpr Colour kZero{0.93, 0.93, 0.92}, kBelow{0.10, 0.35, 0.70}, kAbove{0.80, 0.35, 0.05};
  return colour_image(values.size(), [&](int x, int y) {
    const double share = full > 0.0 ? std::clamp(values(x, y) / full, -1.0, 1.0) : 0.0;
    return mixed(kZero, share < 0.0 ? kBelow : kAbove, std::abs(share));
  });
}

Image moves_image(const Grid<Offset>& moves, Offset motion, int radius) {
  return palette_image(moves.size(), [&](int x, int y) {
    const Offset move = moves(x, y);
    return move_colour({move.x - motion.x, move.y - motion.y}, radius);
  });
}

Image moves_legend(int side) {
  // The page shows through round the disc, whatever its colour.
  const Grid<Rgb8> disc = move_disc(side, {});
  Image image{.size = {side, side}, .channels = 4, .type = SampleType::u8, .samples = {}};
  for (const Rgb8& c : disc) {
    const std::uint8_t opaque = c == Rgb8{} ? 0 : 255;
    for (const std::uint8_t part : {c.red, c.green, c.blue, opaque}) image.samples.push_back(std::byte{part});
  }
  return image;
}

Grid<double> photograph(Extent size) {
  // A ball on a table before a wall, lit from the upper left.
  Grid<double> picture(size);
  const double unit = size.height, horizon = 0.62;
  for (int py = 0; py < size.height; ++py) {
    for (int px = 0; px < size.width; ++px) {
      const double x = (px + 0.5) / unit, y = (py + 0.5) / unit;
      const double glow_x = x - 0.30, glow_y = y - 0.10;
      double light = 0.10 + 0.75 / (1.0 + 4.0 * (glow_x * glow_x + glow_y * glow_y));
      if (y > horizon) {
        const double depth = (y - horizon) / (1.0 - horizon);
        const double shadow_x = (x - 1.02) / 0.46, shadow_y = (y - 0.86) / 0.075;
        const double shadow = 1.0 - smooth(0.2, 1.0, std::sqrt(shadow_x * shadow_x + shadow_y * shadow_y));
        light = (0.30 + 0.35 * depth * (1.0 - 0.35 * x)) * (1.0 - 0.85 * shadow);
      }
      const double ball_x = (x - 0.85) / 0.34, ball_y = (y - 0.54) / 0.34;
      const double inside = 1.0 - ball_x * ball_x - ball_y * ball_y;
      if (inside > 0.0) {
        const double ball_z = std::sqrt(inside);
        const double facing = std::max(0.0, -0.50 * ball_x - 0.62 * ball_y + 0.60 * ball_z);
        double gloss = facing;
        for (int i = 0; i < 5; ++i) gloss *= gloss;
        light =
            0.015 + 0.62 * facing * facing + 0.35 * gloss + 0.10 * (1.0 - ball_z) * smooth(0.0, 1.0, ball_y);
      }
      picture(px, py) = std::clamp(light, 0.0, 1.0);
    }
  }
  return picture;
}

Grid<std::uint8_t> dithered(const Grid<double>& picture, const Grid<double>& value) {
  Grid<std::uint8_t> bits(picture.size());
  for (int y = 0; y < bits.height(); ++y) {
    for (int x = 0; x < bits.width(); ++x) bits(x, y) = picture(x, y) > value.torus(x, y) ? 255 : 0;
  }
  return bits;
}

}  // namespace bn::report
