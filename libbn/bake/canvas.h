// A small drawing surface for contact sheets: 8 bit RGB, integer placement, no outside fonts or
// libraries, so that the same sheet has the same bytes everywhere.

#pragma once

#include <cstdint>
#include <string_view>

#include "bn/palette.h"
#include "bn/texture.h"

namespace bn::baking {

using Colour = Rgb8;

class Canvas {
 public:
  Canvas(Extent size, Colour background) : pixels_(size, background) {}
  Extent size() const { return pixels_.size(); }

  void fill(int x, int y, Extent size, Colour colour);
  /// Mixes `colour` into one pixel with weight 0..1; outside the canvas nothing happens.
  void mix(int x, int y, Colour colour, double weight);
  /// Text with its upper left corner at (x, y), each font pixel `scale` pixels wide.
  void text(int x, int y, std::string_view text, int scale, Colour colour);
  /// A picture enlarged `scale` times, or with every `every`-th pixel only.
  void picture(int x, int y, const Grid<Colour>& picture, int scale, int every = 1);
  /// An antialiased arrow from (x0, y0) to (x1, y1).
  void arrow(double x0, double y0, double x1, double y1, Colour colour);

  Image image() const;  ///< 8bit RGB

 private:
  void line(double x0, double y0, double x1, double y1, double half_width, Colour colour);
  Grid<Colour> pixels_;
};

}  // namespace bn::baking
