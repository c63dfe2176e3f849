#include "ui/move_legend.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "bn/palette.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace bn::ui {
namespace {

constexpr int kDiscSide = 128;

/// "down" is the widest word that stands beside the disc.
ImVec2 labelled_size(float side) { return {side + em(8), side + 2 * ImGui::GetTextLineHeight()}; }

}  // namespace

void MoveLegend::make() {
  if (around_ == palette().panel) return;
  around_ = palette().panel;
  const auto part = [&](int shift) { return static_cast<std::uint8_t>(around_ >> shift & 255); };
  const Grid<Rgb8> disc =
      move_disc(kDiscSide, {part(IM_COL32_R_SHIFT), part(IM_COL32_G_SHIFT), part(IM_COL32_B_SHIFT)});
  std::vector<std::uint32_t> texels;
  for (const Rgb8 colour : disc) texels.push_back(screen_colour(colour));
  disc_.begin(with_halvings(disc.size(), std::move(texels)));
  disc_.advance();
}

void MoveLegend::draw_disc(ImDrawList& list, ImVec2 corner, float side) const {
  list.AddImage(disc_.id(), corner, {corner.x + side, corner.y + side});
}

void MoveLegend::draw_labelled(ImDrawList& list, ImVec2 corner, float side, double longest) const {
  const float line = ImGui::GetTextLineHeight();
  const ImVec2 disc{corner.x + em(3), corner.y + line};
  draw_disc(list, disc, side);
  const auto word = [&](const char* text, ImVec2 at, float share) {
    list.AddText({at.x - share * ImGui::CalcTextSize(text).x, at.y}, palette().dim_text, text);
  };
  const float middle = disc.x + 0.5f * side, height = disc.y + 0.5f * (side - line);
  word("up", {middle, corner.y}, 0.5f);
  word("down", {middle, disc.y + side}, 0.5f);
  word("left", {disc.x - em(0.3f), height}, 1.0f);
  word("right", {disc.x + side + em(0.3f), height}, 0.0f);
  const std::string rim = fmt::format("rim: {:.3g} px", longest);
  word(rim.c_str(), {disc.x + side + em(0.3f), disc.y + side}, 0.0f);
}

void MoveLegend::draw(float side, double longest) {
  make();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::Dummy({side, side});
  items::record("Hues", fmt::format("{:.3g} px", longest));
  draw_disc(*ImGui::GetWindowDrawList(), corner, side);
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  draw_with_words(em(8), longest);
  ImGui::EndTooltip();
}

void MoveLegend::draw_with_words(float side, double longest) {
  make();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::Dummy(labelled_size(side));
  items::record("Hues", fmt::format("{:.3g} px", longest));
  draw_labelled(*ImGui::GetWindowDrawList(), corner, side, longest);
}

}  // namespace bn::ui
