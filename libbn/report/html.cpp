#include "report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace bn::report {
namespace {

/// What a page of 400 pixels has for each of two pictures in a row.
constexpr int kNarrowPage = 168;

/// Length of the well-formed UTF-8 sequence that `text` begins with, 0 if there is none (Unicode 15, table
/// 3-7).
std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xC2 && first <= 0xDF   ? 2
                             : first >= 0xE0 && first <= 0xEF ? 3
                             : first >= 0xF0 && first <= 0xF4 ? 4
                                                              : 0;
  if (length == 0 || text.size() < length) return 0;
  const unsigned char low = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const unsigned char high = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  if (byte(1) < low || byte(1) > high) return 0;
  for (std::size_t i = 2; i < length; ++i) {
    if (byte(i) < 0x80 || byte(i) > 0xBF) return 0;
  }
  return length;
}

std::string image_element(const Image& image, int scale, std::string_view alt) {
  return fmt::format("<img alt=\"{}\" width=\"{}\" height=\"{}\" src=\"data:image/png;base64,{}\">", alt,
                     image.size.width * scale, image.size.height * scale, base64(encode_png(image)));
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = sequence_length(text);
    const auto c = static_cast<unsigned char>(text[0]);
    // C1 controls are printable to no one either.
    const bool control = (c < 0x20 && c != '\n' && c != '\t') || c == 0x7F ||
                         (length == 2 && c == 0xC2 && static_cast<unsigned char>(text[1]) < 0xA0);
    if (length == 0 || control) {
      result += "\uFFFD";
    } else if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else if (c == '"') {
      result += "&quot;";
    } else if (c == '\'') {
      result += "&#39;";
    } else {
      result += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

std::string base64(std::span<const unsigned char> bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const unsigned word = (unsigned{bytes[i]} << 16) | (left > 1 ? unsigned{bytes[i + 1]} << 8 : 0u) |
                          (left > 2 ? unsigned{bytes[i + 2]} : 0u);
    text += kDigits[word >> 18];
    text += kDigits[word >> 12 & 63];
    text += left > 1 ? kDigits[word >> 6 & 63] : '=';
    text += left > 2 ? kDigits[word & 63] : '=';
  }
  return text;
}

std::string whole(std::int64_t value) {
  std::string digits = std::to_string(std::llabs(value));
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3) {
    digits.insert(static_cast<std::size_t>(at), ",");
  }
  return value < 0 ? "\u2212" + digits : digits;
}

std::string number(double value) {
  if (std::isnan(value)) return "\u2013";
  if (std::isinf(value)) return value > 0 ? "\u221E" : "\u2212\u221E";
  const double size = std::abs(value);
  if (size >= 1e4 || size == std::floor(size)) return whole(std::llround(std::clamp(value, -1e18, 1e18)));
  const std::string_view sign = value < 0 ? "\u2212" : "";
  constexpr double kLeast = 1e-6;
  if (size < kLeast) return fmt::format("{}&lt;\u202F0.000001", sign);
  const int digits = std::clamp(2 - static_cast<int>(std::floor(std::log10(size))), 0, 6);
  std::string text = fmt::format("{:.{}f}", size, digits);
  while (text.ends_with('0')) text.pop_back();
  if (text.ends_with('.')) text.pop_back();
  return std::string(sign) + text;
}

int scale_for(int pixels, int wanted) { return std::max(1, wanted / std::max(1, pixels)); }

std::string figure(const Picture& picture) {
  const int pixels = picture.image.size.width;
  const int whole = pixels * picture.scale;
  const bool cut = picture.shown > 0 && picture.shown < whole;
  const int narrow_scale = std::min(picture.scale, kNarrowPage / pixels);
  const int narrow = cut                 ? std::min(picture.shown, kNarrowPage)
                     : narrow_scale == 0 ? kNarrowPage
                                         : pixels * narrow_scale;
  return fmt::format(
      "<figure class=\"picture{}\" style=\"--w:{}px;--n:{}px;--z:{}px\"><label class=\"zoom\"><input "
      "type=\"checkbox\" aria-label=\"Show larger\">{}</label><figcaption><b>{}</b> "
      "{}</figcaption></figure>\n",
      cut                 ? " cut"
      : narrow_scale == 0 ? " narrow-cut"
                          : "",
      cut ? picture.shown : whole, narrow, whole * (cut ? 2 : 3),
      image_element(picture.image, picture.scale, "picture; its caption says what it shows"), picture.title,
      picture.caption);
}

std::string thumbnail(const Image& image, int scale, std::string_view alt, std::string_view label) {
  return fmt::format("<figure class=\"thumbnail\">{}<figcaption>{}</figcaption></figure>\n",
                     image_element(image, scale, alt), label);
}

std::string fact(std::string_view name, std::string_view value) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", name, value);
}

std::string badge_of(std::string_view look, std::string_view words) {
  return fmt::format("<span class=\"badge {}\">{}</span>", look, words);
}

std::string badge(bool passed, std::string_view words) { return badge_of(passed ? "pass" : "fail", words); }

std::string badge(bool passed) { return badge(passed, passed ? "pass" : "fail"); }

}  // namespace bn::report
