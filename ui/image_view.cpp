#include "ui/image_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "bn/spectrum.h"
#include "ui/keys.h"
#include "ui/parameters.h"
#include "ui/widgets.h"

namespace bn::ui {
namespace {

constexpr double kMaxZoom = 256.0;
constexpr double kOverlayZoom = 10.0;  ///< pixels a texel from which an overlay can be read
constexpr int kHistogramBars = 128;

std::string number(float value) {
  return value == std::floor(value) && std::abs(value) < 1e7f ? fmt::format("{:.0f}", value)
                                                              : fmt::format("{:.5g}", value);
}

}  // namespace

void ViewLink::parameters(Parameters& p, const std::string& view) {
  p((view + ".nearest").c_str(), nearest);
  p((view + ".tiled").c_str(), tiled);
  p((view + ".hex").c_str(), hex);
}

void ViewLink::go_to(Offset texel, Extent size) {
  constexpr double kReadable = 48.0;
  pinned = texel;
  zoom = std::max(zoom, kReadable);
  centre_x = (texel.x + 0.5) / size.width;
  centre_y = (texel.y + 0.5) / size.height;
}

void draw_link_controls(ViewLink& link) {
  if (button("Fit", true, "The whole picture (F, or a double click on it)") || shortcut("f")) link.fit();
  ImGui::SameLine();
  if (button("1:1", true, "One texel to a pixel of the screen (1)") || shortcut("1")) link.zoom = 1.0;
  ImGui::SameLine();
  bool linear = !link.nearest;
  if (checkbox("Linear", linear, "Enlarge smoothly; off: every texel is a square")) link.nearest = !linear;
  ImGui::SameLine();
  checkbox("3×3", link.tiled, "Show repetitions on all sides: do seams show?");
}

void ImageView::clear() {
  picture_ = std::make_shared<const Picture>();
  preparing_.stop();
  texture_.reset();
  histogram_.clear();
  stale_ = false;
}

void ImageView::set(std::shared_ptr<const Picture> picture) {
  const bool same_size = picture->size == picture_->size;
  const bool same_range = same_size && picture->low == picture_->low && picture->high == picture_->high;
  if (!same_size) clear();
  picture_ = std::move(picture);
  if (!same_range) {
    low_ = picture_->low;
    high_ = picture_->high;
  }
  stale_ = !empty();
}

ImageView::Prepared ImageView::prepare(const Picture& picture, float low, float high) {
  const Extent shown{std::min(picture.size.width, GlTexture::kMaxSide),
                     std::min(picture.size.height, GlTexture::kMaxSide)};
  std::vector<std::uint32_t> texels(static_cast<std::size_t>(shown.area()));
  const float scale = high > low ? 255.0f / (high - low) : 0.0f;
  const auto level = [&](float value) {
    return static_cast<std::uint32_t>(std::clamp((value - low) * scale + 0.5f, 0.0f, 255.0f));
  };
  const int channels = picture.channels;
  for (int y = 0; y < shown.height; ++y) {
    for (int x = 0; x < shown.width; ++x) {
      const auto from_x = static_cast<std::size_t>(std::int64_t{x} * picture.size.width / shown.width);
      const auto from_y = static_cast<std::size_t>(std::int64_t{y} * picture.size.height / shown.height);
      const std::size_t from = from_y * static_cast<std::size_t>(picture.size.width) + from_x;
      const std::size_t to =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(shown.width) + static_cast<std::size_t>(x);
      if (!picture.colours.empty()) {
        texels[to] = picture.colours[from];
        continue;
      }
      const float* v = &picture.values[from * static_cast<std::size_t>(channels)];
      const auto part = [&](int c) {
        return c < channels && (picture.visible >> c & 1) != 0 ? level(v[c]) : 0u;
      };
      const std::uint32_t grey = level(v[0]);
      texels[to] = channels == 1 ? IM_COL32(grey, grey, grey, 255) : IM_COL32(part(0), part(1), part(2), 255);
    }
  }
  Prepared prepared{.levels = with_halvings(shown, std::move(texels)), .histogram = {}};
  if (!picture.colours.empty()) return prepared;
  const double top = static_cast<double>(picture.high > picture.low ? picture.high : picture.low + 1.0f);
  prepared.histogram.resize(kHistogramBars);
  // Bit by bit, as doubles of all of a large picture would be too much.
  constexpr std::size_t kBit = 1 << 16;
  for (std::size_t first = 0; first < picture.values.size(); first += kBit) {
    const auto begin = picture.values.begin() + static_cast<std::ptrdiff_t>(first);
    const std::vector<double> values(
        begin, begin + static_cast<std::ptrdiff_t>(std::min(kBit, picture.values.size() - first)));
    const auto counts = histogram(values, static_cast<double>(picture.low), top, kHistogramBars);
    for (std::size_t i = 0; i < counts.size(); ++i) prepared.histogram[i] += counts[i];
  }
  return prepared;
}

void ImageView::prepare_texels() {
  try {
    std::optional<Prepared> prepared = preparing_.poll();
    if (stale_ && !preparing_.running()) {
      stale_ = failed_ = false;
      if (picture_->size.area() <= kAtOnce) {
        prepared = prepare(*picture_, low_, high_);
      } else {
        preparing_.start([picture = picture_, low = low_, high = high_](const Execution&) {
          return prepare(*picture, low, high);
        });
      }
    }
    if (prepared) {
      texture_.begin(std::move(prepared->levels));
      histogram_ = std::move(prepared->histogram);
    }
  } catch (const std::bad_alloc&) {
    failed_ = true;
  }
  texture_.advance();
}

std::string ImageView::value_text(float value, bool hex) const {
  if (!hex || picture_->hex_digits == 0) return number(value);
  return fmt::format("{:0{}X}", static_cast<unsigned>(value), picture_->hex_digits);
}

std::string ImageView::describe(int x, int y, bool hex) const {
  if (picture_->describe) return picture_->describe(x, y);
  std::string text;
  const std::size_t at = (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_->size.width) +
                          static_cast<std::size_t>(x)) *
                         static_cast<std::size_t>(picture_->channels);
  for (int c = 0; c < picture_->channels && at < picture_->values.size(); ++c) {
    text += (c > 0 ? ", " : "") + value_text(picture_->values[at + static_cast<std::size_t>(c)], hex);
  }
  return text;
}

/// The line below the picture: of the texel under the mouse, else of the pinned one, else of all.
std::string ImageView::below(const ViewLink& link, float width) const {
  const auto texel = [&](Offset at) {
    // What describes itself is not addressed by texels: a spectrum.
    const std::string value = describe(at.x, at.y, link.hex);
    return picture_->describe ? value : fmt::format("({}, {})  {}", at.x, at.y, value);
  };
  const auto is_here = [&](const std::optional<Offset>& at) {
    return at && at->x < picture_->size.width && at->y < picture_->size.height;
  };
  if (is_here(link.cursor)) return texel(*link.cursor);
  if (failed_) return "not enough memory to show it";
  if (is_here(link.pinned)) return texel(*link.pinned) + ", pinned";
  const std::string size = fmt::format("{} × {}", picture_->size.width, picture_->size.height);
  if (!has_range() || picture_->describe) return size;
  const std::string range = fmt::format("{} … {}", number(low_), number(high_)), both = size + ", " + range;
  return ImGui::CalcTextSize(both.c_str()).x <= width ? both : range;
}

float ImageView::widest_value(bool hex) const {
  // Of numbers that are not whole any may be as long as this.
  const bool whole = picture_->low == std::floor(picture_->low) &&
                     picture_->high == std::floor(picture_->high) && picture_->high > 1.0f;
  const std::string longest = whole ? value_text(picture_->high, hex) : "0.12345";
  return ImGui::CalcTextSize(longest.c_str()).x;
}

void ImageView::draw_values(ImDrawList& list, int x, int y, ImVec2 corner, float size, bool hex) const {
  const auto channels = static_cast<std::size_t>(picture_->channels);
  const float* v =
      &picture_->values[(static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_->size.width) +
                         static_cast<std::size_t>(x)) *
                        channels];
  const float line = ImGui::GetTextLineHeight();
  const float span = high_ > low_ ? high_ - low_ : 1.0f;
  const auto light = [&](std::size_t c) {
    const bool drawn = channels == 1 || (c < 3 && (picture_->visible >> c & 1) != 0);
    return drawn ? std::clamp((v[c] - low_) / span, 0.0f, 1.0f) : 0.0f;
  };
  float grey = light(0);
  if (channels > 1) grey = 0.3f * light(0) + 0.6f * light(1) + (channels > 2 ? 0.1f * light(2) : 0.0f);
  const ImU32 ink = grey > 0.5f ? IM_COL32_BLACK : IM_COL32_WHITE;
  for (std::size_t c = 0; c < channels; ++c) {
    const std::string text = value_text(v[c], hex);
    const float top = 0.5f * (size - line * static_cast<float>(channels)) + line * static_cast<float>(c);
    list.AddText({corner.x + 0.5f * (size - ImGui::CalcTextSize(text.c_str()).x), corner.y + top}, ink,
                 text.c_str());
  }
}

void ImageView::draw(const char* name, ViewLink& link, ImVec2 size) {
  ImGui::PushID(name);
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const ImVec2 area{std::max(size.x, em(4)), std::max(size.y - line, em(4))};
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("picture", area);
  items::record(name,
                empty() ? "empty" : fmt::format("{} × {}", picture_->size.width, picture_->size.height));
  const bool hovered = ImGui::IsItemHovered(), held = ImGui::IsItemActive();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 far_corner{corner.x + area.x, corner.y + area.y};
  list.AddRectFilled(corner, far_corner, palette().background, ImGui::GetStyle().FrameRounding);

  std::string text;
  if (!empty()) {
    prepare_texels();
    // Large pictures come over several frames; a script waits for the whole one.
    const bool coming = stale_ || preparing_.running() || texture_.pending();
    items::record(fmt::format("{} shown", name), coming ? "not yet" : "yes");
    texture_.set_nearest(link.nearest);
    const double w = picture_->size.width, h = picture_->size.height;
    const double tiles = link.tiled ? 3.0 : 1.0;
    const double fit = std::min(area.x / (w * tiles), area.y / (h * tiles));
    const ImGuiIO& io = ImGui::GetIO();
    double zoom = link.zoom > 0.0 ? link.zoom : fit;
    const double middle_x = corner.x + 0.5 * area.x, middle_y = corner.y + 0.5 * area.y;
    const auto texel_at = [&](ImVec2 p) {
      return std::pair{link.centre_x * w + (p.x - middle_x) / zoom,
                       link.centre_y * h + (p.y - middle_y) / zoom};
    };
    if (held && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0)) {
      link.zoom = zoom;
      link.centre_x -= io.MouseDelta.x / (zoom * w);
      link.centre_y -= io.MouseDelta.y / (zoom * h);
    }
    if (hovered && io.MouseWheel != 0) {
      const auto [x, y] = texel_at(io.MousePos);
      zoom = std::clamp(zoom * std::pow(1.25, static_cast<double>(io.MouseWheel)), std::min(fit, 1.0) / 8.0,
                        kMaxZoom);
      link.zoom = zoom;
      link.centre_x = (x - (io.MousePos.x - middle_x) / zoom) / w;
      link.centre_y = (y - (io.MousePos.y - middle_y) / zoom) / h;
    }
    if (hovered && ImGui::IsMouseDoubleClicked(0)) link.fit();
    link.centre_x = std::clamp(link.centre_x, -1.0, 2.0);
    link.centre_y = std::clamp(link.centre_y, -1.0, 2.0);

    const auto screen = [&](double x, double y) {
      return ImVec2(static_cast<float>(middle_x + (x - link.centre_x * w) * zoom),
                    static_cast<float>(middle_y + (y - link.centre_y * h) * zoom));
    };
    const double first = link.tiled ? -1.0 : 0.0, last = link.tiled ? 2.0 : 1.0;
    list.PushClipRect(corner, far_corner, true);
    if (!texture_.empty()) {
      list.AddImage(texture_.id(), screen(first * w, first * h), screen(last * w, last * h),
                    {static_cast<float>(first), static_cast<float>(first)},
                    {static_cast<float>(last), static_cast<float>(last)});
    }
    const auto each_in_sight = [&](auto visit) {
      const auto [left, top] = texel_at(corner);
      const auto [right, bottom] = texel_at(far_corner);
      const auto limit = [&](double v, double side) {
        return std::clamp(std::floor(v), first * side, last * side - 1.0);
      };
      for (double y = limit(top, h); y <= limit(bottom, h); ++y) {
        for (double x = limit(left, w); x <= limit(right, w); ++x) {
          visit(wrap(static_cast<std::int64_t>(x), picture_->size.width),
                wrap(static_cast<std::int64_t>(y), picture_->size.height), screen(x, y));
        }
      }
    };
    const float texel = static_cast<float>(zoom);
    const bool has_numbers = has_range() && !picture_->describe;
    const bool fits = texel > ImGui::GetTextLineHeight() * static_cast<float>(picture_->channels) &&
                      texel > widest_value(link.hex) + em(0.3f);
    if (picture_->overlay && zoom >= kOverlayZoom) {
      each_in_sight([&](int x, int y, ImVec2 at) { picture_->overlay(list, x, y, at, texel); });
    } else if (has_numbers && fits) {
      each_in_sight([&](int x, int y, ImVec2 at) { draw_values(list, x, y, at, texel, link.hex); });
      items::record(fmt::format("{} values", name), link.hex ? "hexadecimal" : "decimal");
    }
    if (hovered) {
      const auto [x, y] = texel_at(io.MousePos);
      const bool inside = x >= first * w && x < last * w && y >= first * h && y < last * h;
      link.cursor =
          inside
              ? std::optional<Offset>({wrap(static_cast<std::int64_t>(std::floor(x)), picture_->size.width),
                                       wrap(static_cast<std::int64_t>(std::floor(y)), picture_->size.height)})
              : std::nullopt;
    }
    const auto frame = [&](const std::optional<Offset>& at, ImU32 colour) {
      if (!at || zoom < 3.0) return;
      list.AddRect(screen(at->x, at->y), screen(at->x + 1, at->y + 1), colour, 0, 0, 2.0f);
    };
    frame(link.pinned, palette().warn);
    frame(link.cursor, palette().accent);
    text = below(link, area.x);
    list.PopClipRect();
  }
  list.AddRect(corner, far_corner, palette().line, ImGui::GetStyle().FrameRounding);
  // No wider than the picture, whatever it says.
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::Dummy({area.x, ImGui::GetTextLineHeight()});
  const ImVec4 clip{at.x, at.y, at.x + area.x, at.y + line};
  list.AddText(nullptr, 0.0f, at, palette().dim_text, text.c_str(), nullptr, 0.0f, &clip);
  if (hovered || link.pinned) items::record("Pixel", text);
  // Where there is no room for all of it, it stands at the mouse.
  if (hovered && ImGui::CalcTextSize(text.c_str()).x > area.x) ImGui::SetTooltip("%s", text.c_str());
  ImGui::PopID();
}

void ImageView::draw_range_fields() {
  if (!has_range() || !ImGui::BeginTable("range", 4, ImGuiTableFlags_SizingStretchProp)) return;
  ImGui::TableSetupColumn("black", 0, 1.0f);
  ImGui::TableSetupColumn("white", 0, 1.0f);
  ImGui::TableSetupColumn("auto", ImGuiTableColumnFlags_WidthFixed);
  ImGui::TableSetupColumn("all", ImGuiTableColumnFlags_WidthFixed);
  const auto low = static_cast<double>(picture_->low), high = static_cast<double>(picture_->high);
  double black = static_cast<double>(low_), white = static_cast<double>(high_);
  ImGui::TableNextColumn();
  bool changed = field("Black", black, low, white, "%.5g", "The value that is shown as black");
  ImGui::TableNextColumn();
  changed |= field("White", white, black, high, "%.5g", "The value that is shown as white");
  ImGui::TableNextColumn();
  if (button("Auto", true, "From the least to the greatest value of the picture")) {
    const auto [least, most] = std::minmax_element(picture_->values.begin(), picture_->values.end());
    black = static_cast<double>(*least), white = static_cast<double>(*most);
    changed = true;
  }
  ImGui::TableNextColumn();
  if (button("All", true, "Everything that samples of this type can be"))
    black = low, white = high, changed = true;
  ImGui::EndTable();
  if (!changed) return;
  low_ = static_cast<float>(black);
  high_ = static_cast<float>(white);
  stale_ = true;
}

void ImageView::draw_range(const char* name, float height) {
  if (!has_range()) return;
  ImGui::PushID(name);
  const float width = std::max(ImGui::GetContentRegionAvail().x, em(1));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("range", {width, height});
  items::record(name, fmt::format("{}..{}", number(low_), number(high_)));
  const float span = picture_->high > picture_->low ? picture_->high - picture_->low : 1.0f;
  const auto place = [&](float value) { return corner.x + (value - picture_->low) / span * width; };
  if (ImGui::IsItemActive()) {
    // The nearer handle follows.
    const float value = std::clamp(picture_->low + (ImGui::GetIO().MousePos.x - corner.x) / width * span,
                                   picture_->low, picture_->high);
    float& handle = std::abs(value - low_) < std::abs(value - high_) ? low_ : high_;
    if (handle != value) {
      handle = value;
      stale_ = true;
    }
  }
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) {
    low_ = picture_->low;
    high_ = picture_->high;
    stale_ = true;
  }
  tooltip("What is shown as black and as white: drag the handles; a double click shows everything.");
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(corner, {corner.x + width, corner.y + height}, palette().background);
  const auto most = histogram_.empty() ? 0 : *std::max_element(histogram_.begin(), histogram_.end());
  for (int i = 0; i < kHistogramBars && most > 0; ++i) {
    const float share =
        static_cast<float>(histogram_[static_cast<std::size_t>(i)]) / static_cast<float>(most);
    const float x0 = corner.x + width * static_cast<float>(i) / kHistogramBars;
    const float x1 = corner.x + width * static_cast<float>(i + 1) / kHistogramBars;
    list.AddRectFilled({x0, corner.y + height * (1 - 0.9f * share)}, {x1, corner.y + height}, palette().line);
  }
  for (const float handle : {low_, high_}) {
    const float x = std::clamp(place(handle), corner.x + 1, corner.x + width - 1);
    list.AddLine({x, corner.y}, {x, corner.y + height}, palette().accent, 2.0f);
  }
  ImGui::PopID();
}

}  // namespace bn::ui
