// Pieces of the page.

#pragma once

#include <span>
#include <string>
#include <string_view>

#include "bn/texture.h"

namespace bn::report {

/// `text` for any place in the page: the five characters that mean something in HTML are replaced, and what
/// is no UTF-8 or no printable character becomes U+FFFD.
std::string escaped(std::string_view text);

std::string base64(std::span<const unsigned char> bytes);

/// Three significant digits and at most six decimals, one notation for all: 0.0518, 0.000024, 12.3; whole
/// numbers with commas, 3,638; below 10^-6 as less than that. HTML.
std::string number(double value);
std::string whole(std::int64_t value);

/// A picture whose pixels stay square and equal: on a narrow page the scale is a lesser whole one, and a
/// picture too wide even at 1 is cut. A click shows it larger.
struct Picture {
  Image image;
  int scale = 1;        ///< page pixels a pixel, on a wide page
  std::string title;    ///< HTML
  std::string caption;  ///< HTML; empty for small ones
  int shown = 0;        ///< page pixels of it that are seen before a click; 0: all
};
std::string figure(const Picture& picture);

/// The same small, with a line of text under it.
std::string thumbnail(const Image& image, int scale, std::string_view alt, std::string_view label);

/// The whole scale that shows `pixels` about `wanted` page pixels wide, at least 1.
int scale_for(int pixels, int wanted);

/// A row of a table of two columns; `value` is HTML.
std::string fact(std::string_view name, std::string_view value);

/// "pass" or "fail" as a badge.
std::string badge(bool passed);
std::string badge(bool passed, std::string_view words);
/// `look`: "pass" (green), "weak" (amber), "fail" (red), "plain" (an outline).
std::string badge_of(std::string_view look, std::string_view words);

}  // namespace bn::report
