// bn/palette.h - floor 0: one colour for one thing, in the contact sheet, the report, the figures and the
// inspector.
//
// Deterministic: additions, products and square roots only, so a picture has the same bytes everywhere.
// Thread safe. No errors. Cost: a few dozen operations a colour.

#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "bn/grid.h"

namespace bn {

/// A colour of the screen, sRGB, 8 bit a channel.
struct Rgb8 {
  std::uint8_t red = 0, green = 0, blue = 0;
  friend constexpr bool operator==(const Rgb8&, const Rgb8&) = default;
};

/// The colour of a move: grey where there is none, the direction its hue, the length its strength, as a share
/// of `longest` (above 0) and full from there on. All of equal lightness, so that no direction stands out.
/// Right is pink, down is blue-violet, left is green-blue, up is yellow-green.
Rgb8 move_colour(Offset move, double longest);

/// The legend of the above: a disc `side` pixels wide (at least 1), each pixel in the colour of the move that
/// leads there from the middle, the rim `longest`; `outside` elsewhere.
Grid<Rgb8> move_disc(int side, Rgb8 outside);

/// A scale from dark blue over green to yellow for a share 0..1, lighter for more.
Rgb8 scale_colour(double share);

/// Colours of curves that also those tell apart who see few (Okabe and Ito 2008).
inline constexpr std::array<Rgb8, 7> kCurvePalette{{{0x00, 0x72, 0xb2},    // blue
                                                    {0xd5, 0x5e, 0x00},    // vermilion
                                                    {0x00, 0x9e, 0x73},    // green
                                                    {0xcc, 0x79, 0xa7},    // purple
                                                    {0xe6, 0x9f, 0x00},    // orange
                                                    {0x56, 0xb4, 0xe9},    // sky
                                                    {0x88, 0x88, 0x88}}};  // grey

/// The same hues, lighter, for dark pages and windows.
inline constexpr std::array<Rgb8, 7> kDarkCurvePalette{{{0x56, 0xb4, 0xe9},
                                                        {0xf0, 0x80, 0x3c},
                                                        {0x2f, 0xbf, 0x93},
                                                        {0xd9, 0x94, 0xbb},
                                                        {0xe6, 0xb8, 0x00},
                                                        {0xa6, 0xd8, 0xf5},
                                                        {0x9a, 0xa1, 0xab}}};

/// Which of them a cooling schedule has, wherever it is drawn: exponential blue, kirkpatrick vermilion,
/// linear green, inverse purple, hajek orange, constant sky, greedy and all other names grey. In gnuplot:
/// line style number + 1.
int schedule_colour_number(std::string_view schedule);

}  // namespace bn
