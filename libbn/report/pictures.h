// What the page shows as pixels. Display only: no figure is read off these.

#pragma once

#include <functional>

#include "bn/spectrum.h"
#include "bn/texture.h"

namespace bn::report {

Image grey_image(const Grid<std::uint8_t>& grey);

/// The part of `grey`, repeated without end, that begins at (x, y).
Grid<std::uint8_t> window(const Grid<std::uint8_t>& grey, int x, int y, Extent size);

/// Power in decibels, DC in the middle; larger pictures are averaged in square blocks to at most `side` a
/// side.
Image spectrum_image(const PowerSpectrum& power, int side);

/// `image` with every row, or every column, so often that it is about as high as wide.
Image made_square(const Image& image);

/// Blue below zero, orange above, grey at zero; full colour at `full` and beyond.
Image signed_image(const Grid<double>& values, double full);

/// Direction as hue, length as strength (bn/palette.h): grey stays, `radius` pixels and more is full colour.
Image moves_image(const Grid<Offset>& moves, Offset motion, int radius);
/// The legend of the above: a disc of all directions, `side` pixels wide.
Image moves_legend(int side);

/// A picture with what photographs have: smooth shades, an edge, a highlight, deep shadow. Linear light,
/// 0..1.
Grid<double> photograph(Extent size);

/// 0 or 255 a pixel: white where the photograph is above the mask. `value`: the mask's values, 0..1,
/// repeated.
Grid<std::uint8_t> dithered(const Grid<double>& picture, const Grid<double>& value);

}  // namespace bn::report
