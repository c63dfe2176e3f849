#include "tools/recipe_tables.h"

#include <fmt/format.h>

#include "bn/kind.h"

namespace bn::tools {
namespace {

std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.replace(at, 1, "\\|");
  return text;
}

std::string rows_of(const Options& options) {
  std::string text;
  for (const Option& option : options.list()) {
    std::string initial = option.required ? "required" : recipe_value(option, option.get());
    if (!option.required && !option.unset_help.empty()) initial = option.unset_help;
    std::string help = option.help;
    if (!option.needs.empty()) help += fmt::format(" Only with {}.", option.needs);
    for (const std::string& former : option.former) help += fmt::format(" Formerly `{}`.", former);
    std::string allowed = option.names_file ? "path"
                          : !option.names_kinds.empty()
                              ? fmt::format("name of a [[{}]]", fmt::join(option.names_kinds, "]] or [["))
                              : allowed_text(option);
    if (!option.unit.empty()) allowed += " " + option.unit;
    text += fmt::format("| `{}` | {} | {} | {} |\n", option.key, cell(allowed), cell(initial), cell(help));
  }
  return text;
}

constexpr std::string_view kHead = "| key | values | default | |\n|---|---|---|---|\n";

}  // namespace

std::string recipe_tables() {
  std::string text;
  for (const Kind* kind : kinds()) {
    const std::shared_ptr<Entry> entry = kind->make();
    text += fmt::format("\n## `[[{}]]`\n\n{}\n\n{}", kind->table, kind->title + ".", kHead);
    text += "| `name` | 1..64 letters, digits, `_`, `-`, `.` | required | Unique among all entries. |\n";
    text += rows_of(entry->options());
    text +=
        "| `count` | 1..1024 | 1 | So many entries: names and paths get a number, seeds follow each other. "
        "|\n";
    text += "| `outputs` | 1..64 paths or tables | required | The files. |\n";
    entry->add_output();
    text += fmt::format("\nEach output is a path, or a table:\n\n{}", kHead);
    text +=
        "| `path` | relative path | required | Inside the output folder; the extension decides the format. "
        "|\n";
    text += rows_of(entry->output_options(0));
  }
  return text;
}

}  // namespace bn::tools
