// The widgets that views are made of: ImGui's, with the label on the left in a column of its own, a hint on
// hover, and an entry in ui/items.h, so that scripts and tests reach each by the words the user reads.
//
// Labels are unique within what is on the screen; "Radius##2" shows "Radius".

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "bn/options.h"
#include "ui/items.h"
#include "ui/theme.h"

namespace bn::ui {

/// Width of the column of labels from here on, in ems; 0: as wide as each label.
void set_label_width(float ems);

/// Shows `hint` while the item before is hovered, also where it is disabled.
void tooltip(std::string_view hint);

/// True when clicked. A disabled one says in `hint` why.
bool button(const char* label, bool enabled = true, std::string_view hint = {});
/// The one that the view is about: in the accent colour.
bool main_button(const char* label, bool enabled = true, std::string_view hint = {});
bool checkbox(const char* label, bool& value, std::string_view hint = {});
/// A button that is on or off, as the words of choice() look. True when clicked. Not recorded.
bool toggle(const char* word, bool on, std::string_view hint = {});
/// Two to five words of which one holds, side by side. Recorded as "label: word" each.
bool choice(const char* label, std::span<const char* const> words, int& index, std::string_view hint = {});
/// One of many, in a list that opens; the entries are recorded while it is open.
bool combo(const char* label, std::span<const std::string> words, int& index, std::string_view hint = {});

// Sliders: ctrl+click (or double click) types a value. True while the value changes. A number that is typed
// into a slider or a field and is beyond the range becomes the nearest that is allowed, and a message below
// the widget ("Not taken") says so until the next number is typed.
bool slider(const char* label, int& value, int low, int high, std::string_view hint = {});
bool slider(const char* label, double& value, double low, double high, const char* format = "%.3g",
            bool logarithmic = false, std::string_view hint = {});
/// Range and hint are those of the option.
bool slider(const char* label, int& value, const Option& option);
bool slider(const char* label, double& value, const Option& option, const char* format);
// Fields: true when the user is done with a new value.
bool field(const char* label, std::int64_t& value, const Option& option);
bool field(const char* label, std::int64_t& value, std::int64_t low, std::int64_t high,
           std::string_view hint = {});
bool field(const char* label, double& value, double low, double high, const char* format = "%.6g",
           std::string_view hint = {});
bool field(const char* label, std::string& value, std::string_view hint = {});
/// A number of any range, for whoever judges it to say what is wrong; none where the field is empty, which
/// then shows `otherwise` in the dim colour: what holds instead.
template <class T>
bool field(const char* label, std::optional<T>& value, std::string_view otherwise,
           std::string_view hint = {});

bool selectable(const char* label, bool selected, bool enabled = true);
bool menu_item(const char* label, const char* keys = nullptr, bool selected = false, bool enabled = true);
/// ImGui::BeginTabItem, recorded; `choose` brings it to the front.
bool begin_tab(const char* label, bool choose = false);
bool begin_menu(const char* label);

/// A figure with its name: what `expect` of a script reads.
void value(const char* label, std::string_view text, std::string_view hint = {});
/// The same in a colour of the palette.
void value(const char* label, std::string_view text, ImU32 colour, std::string_view hint = {});
void heading(const char* text);
/// Text in the dim colour, wrapped.
void note(std::string_view text);
/// What is wrong with what stands above; recorded as `name`.
void complaint(const char* name, std::string_view text);
void progress_bar(const char* label, double share, std::string_view text);

/// A column in the middle of a view that is still empty, for what to do about that. Call end_centred()
/// always.
void begin_centred(const char* name, const char* title);
void end_centred();

/// A child window with the panel's colour and padding. Size as ImGui::BeginChild. Call end_panel() always.
bool begin_panel(const char* name, ImVec2 size = {0, 0});
void end_panel();

}  // namespace bn::ui
