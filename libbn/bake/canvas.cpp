#include "bake/canvas.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bake/label_font.h"

namespace bn::baking {
namespace {

std::uint8_t to_byte(double share) {
  return static_cast<std::uint8_t>(std::clamp(share, 0.0, 1.0) * 255.0 + 0.5);
}

}  // namespace

void Canvas::fill(int x, int y, Extent size, Colour colour) {
  for (int v = std::max(y, 0); v < std::min(y + size.height, pixels_.height()); ++v) {
    for (int u = std::max(x, 0); u < std::min(x + size.width, pixels_.width()); ++u) pixels_(u, v) = colour;
  }
}

void Canvas::mix(int x, int y, Colour colour, double weight) {
  if (x < 0 || y < 0 || x >= pixels_.width() || y >= pixels_.height()) return;
  Colour& pixel = pixels_(x, y);
  const auto blend = [&](std::uint8_t below, std::uint8_t above) {
    return to_byte((below + (above - below) * weight) / 255.0);
  };
  pixel = {blend(pixel.red, colour.red), blend(pixel.green, colour.green), blend(pixel.blue, colour.blue)};
}

void Canvas::text(int x, int y, std::string_view text, int scale, Colour colour) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int left = x + static_cast<int>(i) * kGlyphAdvance * scale;
    for (int v = 0; v < kGlyphHeight; ++v) {
      for (int u = 0; u < kGlyphWidth; ++u) {
        if (glyph_pixel(text[i], u, v)) fill(left + u * scale, y + v * scale, {scale, scale}, colour);
      }
    }
  }
}

void Canvas::picture(int x, int y, const Grid<Colour>& picture, int scale, int every) {
  for (int v = 0; v * every < picture.height(); ++v) {
    for (int u = 0; u * every < picture.width(); ++u) {
      fill(x + u * scale, y + v * scale, {scale, scale}, picture(u * every, v * every));
    }
  }
}

void Canvas::line(double x0, double y0, double x1, double y1, double half_width, Colour colour) {
  const double dx = x1 - x0, dy = y1 - y0, length2 = std::max(dx * dx + dy * dy, 1e-9);
  const int left = static_cast<int>(std::floor(std::min(x0, x1))) - 2;
  const int right = static_cast<int>(std::ceil(std::max(x0, x1))) + 2;
  const int top = static_cast<int>(std::floor(std::min(y0, y1))) - 2;
  const int bottom = static_cast<int>(std::ceil(std::max(y0, y1))) + 2;
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      // Coverage of the pixel, from the distance of its centre to the segment.
      const double px = x + 0.5 - x0, py = y + 0.5 - y0;
      const double along = std::clamp((px * dx + py * dy) / length2, 0.0, 1.0);
      const double ex = px - along * dx, ey = py - along * dy;
      const double cover = half_width + 0.5 - std::sqrt(ex * ex + ey * ey);
      if (cover > 0.0) mix(x, y, colour, std::min(cover, 1.0));
    }
  }
}

void Canvas::arrow(double x0, double y0, double x1, double y1, Colour colour) {
  constexpr double kHalfWidth = 0.7, kHead = 3.5;
  line(x0, y0, x1, y1, kHalfWidth, colour);
  const double dx = x1 - x0, dy = y1 - y0, length = std::sqrt(dx * dx + dy * dy);
  if (length < 1.0) return;
  // Two barbs, at about 35 degrees to the shaft.
  const double head = std::min(kHead, 0.6 * length);
  const double ux = dx / length * head, uy = dy / length * head;
  line(x1, y1, x1 - 0.8 * ux + 0.55 * uy, y1 - 0.8 * uy - 0.55 * ux, kHalfWidth, colour);
  line(x1, y1, x1 - 0.8 * ux - 0.55 * uy, y1 - 0.8 * uy + 0.55 * ux, kHalfWidth, colour);
}

Image Canvas::image() const {
  Image image{.size = pixels_.size(), .channels = 3, .type = SampleType::u8, .samples = {}};
  image.samples.reserve(pixels_.count() * 3);
  for (const Colour& pixel : pixels_) {
    for (const std::uint8_t value : {pixel.red, pixel.green, pixel.blue})
      image.samples.push_back(std::byte{value});
  }
  return image;
}

}  // namespace bn::baking
