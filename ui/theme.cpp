#include "ui/theme.h"

#include <array>
#include <filesystem>
#include <string>

namespace bn::ui {
namespace {

constexpr ImU32 rgb(unsigned hex, unsigned alpha = 255) {
  return IM_COL32((hex >> 16) & 255, (hex >> 8) & 255, hex & 255, alpha);
}

constexpr Palette kDark{.background = rgb(0x15171b),
                        .panel = rgb(0x1c1f25),
                        .frame = rgb(0x292d36),
                        .line = rgb(0x363b46),
                        .text = rgb(0xdfe2e8),
                        .dim_text = rgb(0x969eac),
                        .accent = rgb(0x5aa2e0),
                        .good = rgb(0x6cc08b),
                        .bad = rgb(0xef7f73),
                        .warn = rgb(0xe3b45c)};

constexpr Palette kLight{.background = rgb(0xf1f1ee),
                         .panel = rgb(0xfbfbf9),
                         .frame = rgb(0xe5e6e3),
                         .line = rgb(0xcfd1ce),
                         .text = rgb(0x1f242c),
                         .dim_text = rgb(0x5d6572),
                         .accent = rgb(0x1f6fb5),
                         .good = rgb(0x1f7f46),
                         .bad = rgb(0xbb3328),
                         .warn = rgb(0x946200)};

const Palette* current = &kDark;
ImFont* mono = nullptr;
ImFont* heading = nullptr;

constexpr float kTextPx = 14.0f;
constexpr float kHeadingPx = 16.0f;

ImVec4 colour(ImU32 value) { return ImGui::ColorConvertU32ToFloat4(value); }

ImVec4 mix(ImU32 from, ImU32 to, float share) {
  const ImVec4 a = colour(from), b = colour(to);
  return {a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share, a.z + (b.z - a.z) * share, 1.0f};
}

void set_colours(ImGuiStyle& style, const Palette& p, bool dark) {
  dark ? ImGui::StyleColorsDark(&style) : ImGui::StyleColorsLight(&style);
  auto& c = style.Colors;
  const ImVec4 hover = mix(p.frame, p.accent, 0.25f), active = mix(p.frame, p.accent, 0.45f);
  c[ImGuiCol_Text] = colour(p.text);
  c[ImGuiCol_TextDisabled] = colour(p.dim_text);
  c[ImGuiCol_WindowBg] = colour(p.background);
  c[ImGuiCol_ChildBg] = colour(p.panel);
  c[ImGuiCol_PopupBg] = colour(p.panel);
  c[ImGuiCol_MenuBarBg] = colour(p.background);
  c[ImGuiCol_Border] = c[ImGuiCol_Separator] = c[ImGuiCol_TableBorderStrong] = c[ImGuiCol_TableBorderLight] =
      colour(p.line);
  c[ImGuiCol_FrameBg] = c[ImGuiCol_Button] = colour(p.frame);
  c[ImGuiCol_FrameBgHovered] = c[ImGuiCol_ButtonHovered] = hover;
  c[ImGuiCol_FrameBgActive] = c[ImGuiCol_ButtonActive] = active;
  c[ImGuiCol_Header] = mix(p.panel, p.accent, 0.28f);
  c[ImGuiCol_HeaderHovered] = mix(p.panel, p.accent, 0.20f);
  c[ImGuiCol_HeaderActive] = mix(p.panel, p.accent, 0.40f);
  c[ImGuiCol_CheckMark] = colour(p.accent);
  c[ImGuiCol_SliderGrab] = mix(p.frame, p.accent, 0.55f);  // values are read across it
  c[ImGuiCol_SliderGrabActive] = mix(p.accent, p.text, 0.3f);
  c[ImGuiCol_Tab] = colour(p.background);
  c[ImGuiCol_TabHovered] = hover;
  c[ImGuiCol_TabActive] = mix(p.panel, p.accent, 0.30f);
  c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = colour(p.frame);
  c[ImGuiCol_ScrollbarBg] = ImVec4(0, 0, 0, 0);
  c[ImGuiCol_ScrollbarGrab] = colour(p.line);
  c[ImGuiCol_TableHeaderBg] = colour(p.frame);
  c[ImGuiCol_TableRowBgAlt] = mix(p.panel, p.frame, 0.35f);
  c[ImGuiCol_TextSelectedBg] = mix(p.panel, p.accent, 0.5f);
  c[ImGuiCol_PlotHistogram] = mix(p.frame, p.accent, 0.5f);
  c[ImGuiCol_ModalWindowDimBg] = ImVec4(0, 0, 0, 0.45f);
  c[ImGuiCol_NavHighlight] = colour(p.accent);
}

void set_distances(ImGuiStyle& style, float scale) {
  style.WindowPadding = {12, 10};
  style.FramePadding = {8, 4};
  style.ItemSpacing = {8, 6};
  style.ItemInnerSpacing = {6, 4};
  style.CellPadding = {6, 3};
  style.IndentSpacing = 16;
  style.ScrollbarSize = 12;
  style.GrabMinSize = 12;
  style.WindowRounding = 0;
  style.ChildRounding = style.PopupRounding = 5;
  style.FrameRounding = style.GrabRounding = style.TabRounding = 4;
  style.ScrollbarRounding = 6;
  style.WindowBorderSize = 0;
  style.ChildBorderSize = style.PopupBorderSize = style.FrameBorderSize = 1;
  style.ScaleAllSizes(scale);
}

/// Debian's fonts-dejavu-core; else ImGui's own, which has Latin letters only.
ImFont* add_font(const char* file, float pixels) {
  static const std::array<ImWchar, 17> ranges{0x20,   0xff,    // Latin
                                              0x394,  0x3c9,   // Greek
                                              0x2010, 0x2026,  // dashes, dots
                                              0x2070, 0x2089,  // superscripts
                                              0x2190, 0x2194,  // arrows
                                              0x2208, 0x2265,  // mathematics
                                              0x25a0, 0x25cf,  // shapes
                                              0x2713, 0x2717,  // ticks
                                              0};
  const std::string path = std::string("/usr/share/fonts/truetype/dejavu/") + file;
  ImGuiIO& io = ImGui::GetIO();
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored)) {
    if (ImFont* font = io.Fonts->AddFontFromFileTTF(path.c_str(), pixels, nullptr, ranges.data()))
      return font;
  }
  ImFontConfig config;
  config.SizePixels = pixels;
  return io.Fonts->AddFontDefault(&config);
}

}  // namespace

const Palette& palette() { return *current; }

ImU32 curve_colour(int number) {
  const auto& colours = is_dark() ? kDarkCurvePalette : kCurvePalette;
  return screen_colour(colours[static_cast<std::size_t>(number) % colours.size()]);
}

ImU32 schedule_colour(std::string_view schedule, int repeat) {
  constexpr float kPaler[] = {0.0f, 0.35f, 0.6f};
  const ImU32 full = curve_colour(schedule_colour_number(schedule));
  return ImGui::ColorConvertFloat4ToU32(
      mix(full, current->background, kPaler[static_cast<std::size_t>(repeat) % std::size(kPaler)]));
}

bool is_dark() { return current == &kDark; }
ImFont* mono_font() { return mono; }
ImFont* heading_font() { return heading; }

bool apply_theme(bool dark, float scale) {
  static float font_scale = 0.0f;
  current = dark ? &kDark : &kLight;
  ImGuiStyle style;
  set_distances(style, scale);
  set_colours(style, *current, dark);
  ImGui::GetStyle() = style;
  if (font_scale == scale && mono != nullptr) return false;
  font_scale = scale;
  ImGui::GetIO().Fonts->Clear();
  add_font("DejaVuSans.ttf", kTextPx * scale);
  mono = add_font("DejaVuSansMono.ttf", (kTextPx - 1) * scale);
  heading = add_font("DejaVuSans-Bold.ttf", kHeadingPx * scale);
  return true;
}

}  // namespace bn::ui
