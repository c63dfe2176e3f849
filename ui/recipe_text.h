// The text of a recipe, as wide as there is room.

#pragma once

#include <string>
#include <string_view>

namespace bn::ui {

/// `text` in lines of at most `columns` characters (at least 16), broken at spaces where there are any. What
/// goes on in the next line is indented, and of a comment is a comment again.
std::string wrapped_recipe(std::string_view text, int columns);

/// Draws it so, in the font of code.
void show_recipe(std::string_view text);

}  // namespace bn::ui
