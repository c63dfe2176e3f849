#include "ui/recipe_text.h"

#include <algorithm>

#include "ui/theme.h"
#include "ui/widgets.h"

namespace bn::ui {
namespace {

/// How many bytes the first `columns` characters of UTF-8 text take.
std::size_t bytes_of(std::string_view text, std::size_t columns) {
  std::size_t i = 0;
  for (std::size_t seen = 0; i < text.size(); ++i) {
    const bool begins = (static_cast<unsigned char>(text[i]) & 0xC0) != 0x80;
    if (begins && seen++ == columns) break;
  }
  return i;
}

}  // namespace

std::string wrapped_recipe(std::string_view text, int columns) {
  const auto width = static_cast<std::size_t>(std::max(columns, 16));
  std::string out;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::string_view next = line.starts_with("#") ? "# " : "    ";
    std::size_t room = width;
    while (bytes_of(line, room) < line.size()) {
      const std::size_t most = bytes_of(line, room);
      const std::size_t space = line.rfind(' ', most);
      // Not at the space after "#", which would leave it alone.
      const bool good = space != std::string_view::npos && space > 2;
      out += line.substr(0, good ? space : most);
      line.remove_prefix(good ? space + 1 : most);
      out += '\n';
      out += next;
      room = width - next.size();
    }
    out += line;
    out += '\n';
  }
  return out;
}

void show_recipe(std::string_view text) {
  ImGui::PushFont(mono_font());
  const float character = ImGui::CalcTextSize("0").x;
  // A column less, so that nothing is wrapped a second time.
  note(wrapped_recipe(text, static_cast<int>(ImGui::GetContentRegionAvail().x / character) - 1));
  ImGui::PopFont();
}

}  // namespace bn::ui
