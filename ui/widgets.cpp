#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "ui/declared.h"
#include "ui/flow.h"
#include "ui/parameters.h"

namespace bn::ui {
namespace {

float label_width_em = 8.0f;

const char* end_of(const char* label) { return ImGui::FindRenderedTextEnd(label); }

/// Draws the label and leaves the cursor where the widget begins, as wide as the room that is left.
void begin_row(const char* label) {
  ImGui::PushID(label);
  ImGui::BeginGroup();
  if (end_of(label) != label) {
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, palette().dim_text);
    ImGui::TextUnformatted(label, end_of(label));
    ImGui::PopStyleColor();
    ImGui::SameLine(label_width_em > 0 ? em(label_width_em) : 0.0f);  // from the group's left
  }
  ImGui::SetNextItemWidth(-FLT_MIN);
}

void end_row(std::string_view hint) {
  ImGui::EndGroup();
  tooltip(hint);
  ImGui::PopID();
}

void wrapped(std::string_view text, ImU32 colour) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

/// The number that was typed last, where it was not taken as it is: its widget, and what is said below that.
struct NotTaken {
  ImGuiID widget = 0;
  std::string why;
} not_taken;

void take_number() {
  if (not_taken.widget == ImGui::GetID("##value")) not_taken = {};
}

void refuse_number(std::string why) { not_taken = {ImGui::GetID("##value"), std::move(why)}; }

/// Takes a number that was typed, or the nearest in its range.
template <class T>
void judge_number(T& value, T low, T high) {
  const T typed = value;
  value = typed >= low && typed <= high ? typed : typed > high ? high : low;  // NaN: the lowest
  if (typed == value) return take_number();
  refuse_number(fmt::format("{} is out of range (allowed: {}..{}); it is {} now.", typed, low, high, value));
}

/// As end_row(); what was not taken is told once the user is done typing.
void end_number_row(std::string_view hint, bool active) {
  if (not_taken.widget == ImGui::GetID("##value") && !active) {
    const std::string why = not_taken.why;
    end_row(hint);
    complaint("Not taken", why);
  } else {
    end_row(hint);
  }
}

std::string printf_text(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// A slider by `draw`, with its value on the right, where no knob covers it.
template <class T, class Shown, class Draw>
bool track(const char* label, T& value, T low, T high, Shown shown, std::string_view hint, Draw draw) {
  begin_row(label);
  const auto width = [&](T number) { return ImGui::CalcTextSize(shown(number).c_str()).x; };
  const float room = std::max({width(low), width(high), width(value)}) + ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::SetNextItemWidth(-room);
  const bool typing = ImGui::TempInputIsActive(ImGui::GetID("##value"));
  if (!typing) ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(0, 0, 0, 0));
  const bool changed = draw();
  if (!typing) ImGui::PopStyleColor();
  if (changed) judge_number(value, low, high);
  items::record(label, shown(value));
  const bool active = ImGui::IsItemActive();
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  ImGui::TextUnformatted(shown(value).c_str());
  end_number_row(hint, active);
  return changed;
}

template <class T>
bool number_field(const char* label, T& value, std::string text, T low, T high, std::string_view hint) {
  begin_row(label);
  // While it is held ImGui keeps the text, so a number that is half typed may be anything.
  if (ImGui::InputText("##value", &text)) {
    if (T number{}; read_number(text, number)) {
      value = number;
      judge_number(value, low, high);
    } else {
      refuse_number(fmt::format("\"{}\" is no number; it is {} still.", text, value));
    }
  }
  items::record(label, text);
  const bool done = ImGui::IsItemDeactivatedAfterEdit();
  end_number_row(hint, ImGui::IsItemActive());
  return done;
}

bool recorded_button(const char* label, bool enabled, std::string_view hint) {
  ImGui::BeginDisabled(!enabled);
  const bool clicked = ImGui::Button(label);
  items::record(label, {}, enabled);
  ImGui::EndDisabled();
  tooltip(hint);
  return clicked && enabled;
}

}  // namespace

void set_label_width(float ems) { label_width_em = ems; }

void tooltip(std::string_view hint) {
  if (hint.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(em(26));
  ImGui::TextUnformatted(hint.data(), hint.data() + hint.size());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool button(const char* label, bool enabled, std::string_view hint) {
  return recorded_button(label, enabled, hint);
}

bool main_button(const char* label, bool enabled, std::string_view hint) {
  const ImVec4 accent = ImGui::ColorConvertU32ToFloat4(palette().accent);
  const auto shade = [&](float share) {
    return ImVec4(accent.x * share, accent.y * share, accent.z * share, 1.0f);
  };
  ImGui::PushStyleColor(ImGuiCol_Button, shade(is_dark() ? 0.72f : 1.0f));
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, shade(is_dark() ? 0.82f : 0.9f));
  ImGui::PushStyleColor(ImGuiCol_ButtonActive, shade(is_dark() ? 0.6f : 0.8f));
  ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32_WHITE);
  const bool clicked = recorded_button(label, enabled, {});
  ImGui::PopStyleColor(4);
  tooltip(hint);  // in the colours of all hints
  return clicked;
}

bool checkbox(const char* label, bool& value, std::string_view hint) {
  const bool changed = ImGui::Checkbox(label, &value);
  items::record(label, value ? "on" : "off");
  tooltip(hint);
  return changed;
}

bool toggle(const char* word, bool on, std::string_view hint) {
  if (on) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_HeaderActive));
  if (!on) ImGui::PushStyleColor(ImGuiCol_Text, palette().dim_text);
  const bool clicked = ImGui::Button(word);
  ImGui::PopStyleColor();
  tooltip(hint);
  return clicked;
}

bool choice(const char* label, std::span<const char* const> words, int& index, std::string_view hint) {
  begin_row(label);
  bool changed = false;
  const std::string name(label, end_of(label));
  const float left = ImGui::GetCursorPosX();
  for (int i = 0; i < static_cast<int>(words.size()); ++i) {
    if (i > 0) {
      flow(button_width(words[i]), 1);
      ImGui::SetCursorPosX(std::max(left, ImGui::GetCursorPosX()));  // of a new line: below the first word
    }
    const bool chosen = i == index;
    if (toggle(words[i], chosen) && !chosen) {
      index = i;
      changed = true;
    }
    items::record(name.empty() ? std::string(words[i]) : fmt::format("{}: {}", name, words[i]),
                  chosen ? "on" : "off");
  }
  end_row(hint);
  return changed;
}

bool combo(const char* label, std::span<const std::string> words, int& index, std::string_view hint) {
  begin_row(label);
  bool changed = false;
  const bool known = index >= 0 && index < static_cast<int>(words.size());
  const std::string shown = known ? words[static_cast<std::size_t>(index)] : "";
  const bool open = ImGui::BeginCombo("##value", shown.c_str(), ImGuiComboFlags_HeightLarge);
  if (!open) items::record(label, shown);
  if (open) {
    for (int i = 0; i < static_cast<int>(words.size()); ++i) {
      if (selectable(words[static_cast<std::size_t>(i)].c_str(), i == index) && i != index) {
        index = i;
        changed = true;
      }
    }
    ImGui::EndCombo();
  }
  end_row(hint);
  return changed;
}

bool slider(const char* label, int& value, int low, int high, std::string_view hint) {
  const auto shown = [](int number) { return fmt::format("{}", number); };
  return track(label, value, low, high, shown, hint,
               [&] { return ImGui::SliderInt("##value", &value, low, high, "%d"); });
}

bool slider(const char* label, double& value, double low, double high, const char* format, bool logarithmic,
            std::string_view hint) {
  const auto shown = [&](double number) { return printf_text(format, number); };
  return track(label, value, low, high, shown, hint, [&] {
    const auto flags = logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None;
    return ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &low, &high, format, flags);
  });
}

bool slider(const char* label, int& value, const Option& option) {
  return slider(label, value, static_cast<int>(option.least), static_cast<int>(option.most), hint_of(option));
}

bool slider(const char* label, double& value, const Option& option, const char* format) {
  return slider(label, value, option.least_real, option.most_real, format, false, hint_of(option));
}

bool field(const char* label, std::int64_t& value, const Option& option) {
  return field(label, value, option.least, option.most, hint_of(option));
}

bool field(const char* label, std::int64_t& value, std::int64_t low, std::int64_t high,
           std::string_view hint) {
  return number_field(label, value, fmt::format("{}", value), low, high, hint);
}

bool field(const char* label, double& value, double low, double high, const char* format,
           std::string_view hint) {
  return number_field(label, value, printf_text(format, value), low, high, hint);
}

bool field(const char* label, std::string& value, std::string_view hint) {
  begin_row(label);
  ImGui::InputText("##value", &value);
  items::record(label, value);
  const bool done = ImGui::IsItemDeactivatedAfterEdit();
  end_row(hint);
  return done;
}

template <class T>
bool field(const char* label, std::optional<T>& value, std::string_view otherwise, std::string_view hint) {
  begin_row(label);
  std::string text = value ? fmt::format("{}", *value) : "";
  // While it is held ImGui keeps the text, so a number that is half typed may be anything.
  if (ImGui::InputTextWithHint("##value", std::string(otherwise).c_str(), &text)) {
    T number{};
    if (text.empty()) {
      value.reset();
      take_number();
    } else if (read_number(text, number)) {
      value = number;
      take_number();
    } else {
      refuse_number(fmt::format("\"{}\" is no number of this kind; it is not taken.", text));
    }
  }
  items::record(label, value ? fmt::format("{}", *value) : std::string(otherwise));
  const bool done = ImGui::IsItemDeactivatedAfterEdit();
  end_number_row(hint, ImGui::IsItemActive());
  return done;
}
template bool field(const char*, std::optional<int>&, std::string_view, std::string_view);
template bool field(const char*, std::optional<std::int64_t>&, std::string_view, std::string_view);
template bool field(const char*, std::optional<double>&, std::string_view, std::string_view);

bool selectable(const char* label, bool selected, bool enabled) {
  const bool clicked =
      ImGui::Selectable(label, selected, enabled ? ImGuiSelectableFlags_None : ImGuiSelectableFlags_Disabled);
  items::record(label, selected ? "on" : "off", enabled);
  return clicked;
}

bool menu_item(const char* label, const char* keys, bool selected, bool enabled) {
  const bool clicked = ImGui::MenuItem(label, keys, selected, enabled);
  items::record(label, selected ? "on" : "off", enabled);
  return clicked;
}

bool begin_tab(const char* label, bool choose) {
  const bool open = ImGui::BeginTabItem(label, nullptr, choose ? ImGuiTabItemFlags_SetSelected : 0);
  items::record(label, open ? "on" : "off");
  return open;
}

bool begin_menu(const char* label) {
  const bool open = ImGui::BeginMenu(label);
  if (!open) items::record(label);
  return open;
}

void value(const char* label, std::string_view text, std::string_view hint) {
  value(label, text, palette().text, hint);
}

void value(const char* label, std::string_view text, ImU32 colour, std::string_view hint) {
  ImGui::BeginGroup();
  ImGui::PushStyleColor(ImGuiCol_Text, palette().dim_text);
  ImGui::TextUnformatted(label, end_of(label));
  ImGui::PopStyleColor();
  ImGui::SameLine(label_width_em > 0 ? em(label_width_em) : 0.0f);
  wrapped(text, colour);
  items::record(label, text);
  ImGui::EndGroup();
  tooltip(hint);
}

void heading(const char* text) {
  if (ImGui::GetCursorPosY() > em(2)) ImGui::Dummy({0, em(0.2f)});
  ImGui::PushFont(heading_font());
  ImGui::TextUnformatted(text);
  ImGui::PopFont();
}

void note(std::string_view text) { wrapped(text, palette().dim_text); }

void complaint(const char* name, std::string_view text) {
  ImGui::BeginGroup();
  wrapped(text, palette().bad);
  ImGui::EndGroup();
  items::record(name, text);
}

void progress_bar(const char* label, double share, std::string_view text) {
  ImGui::ProgressBar(static_cast<float>(share), {-FLT_MIN, 0}, std::string(text).c_str());
  items::record(label, text);
}

void begin_centred(const char* name, const char* title) {
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float width = std::min(room.x, em(30));
  ImGui::SetCursorPos(
      {ImGui::GetCursorPosX() + 0.5f * (room.x - width), ImGui::GetCursorPosY() + 0.3f * room.y});
  ImGui::BeginChild(name, {width, 0}, false, ImGuiWindowFlags_NoBackground);
  heading(title);
}

void end_centred() { ImGui::EndChild(); }

bool begin_panel(const char* name, ImVec2 size) {
  return ImGui::BeginChild(name, size, true, ImGuiWindowFlags_AlwaysUseWindowPadding);
}

void end_panel() { ImGui::EndChild(); }

}  // namespace bn::ui
