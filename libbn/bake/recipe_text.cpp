// A recipe written out. This is the text inside every file: every key of the first edition of the language,
// so that no later change of a default can change what it means, and of younger keys those that differ from
// their default, so that the bytes of files which do not use them stay as they were.

#include <fmt/format.h>

#include "bn/bake.h"

namespace bn {
namespace {

const Option& name_as_option() {
  static const Option option{.key = "name", .help = "", .type = OptionType::text};
  return option;
}

std::string text_value(const std::string& text) { return recipe_value(name_as_option(), Value(text)); }

/// Calls each(key, value as text) for what is written of `options`, whose defaults are those of `initial`.
template <class Each>
void for_each_written(const Options& options, const Options& initial, Each each) {
  for (std::size_t i = 0; i < options.list().size(); ++i) {
    const Option& option = options.list()[i];
    if (!option.applies()) continue;
    const Value value = option.get();
    const std::string text = recipe_value(option, value);
    if (text.empty()) continue;
    if (option.since > 1 && value == initial.list()[i].get()) continue;
    each(option.key, text);
  }
}

void write_entry(const Entry& entry, std::string& text) {
  const std::shared_ptr<Entry> fresh = entry.kind().make();
  text += fmt::format("\n[[{}]]\nname = {}\n", entry.kind().table, text_value(entry.name));
  for_each_written(options_of(entry), fresh->options(),
                   [&](const std::string& key, const std::string& value) {
                     text += fmt::format("{} = {}\n", key, value);
                   });
  text += "outputs = [\n";
  const std::shared_ptr<Entry> plain = entry.clone();
  for (std::size_t i = 0; i < entry.output_count(); ++i) {
    plain->default_output(i);
    text += fmt::format("  {{ path = {}", text_value(entry.path_of(i)));
    for_each_written(output_options_of(entry, i), plain->output_options(i),
                     [&](const std::string& key, const std::string& value) {
                       text += fmt::format(", {} = {}", key, value);
                     });
    text += " },\n";
  }
  text += "]\n";
}

}  // namespace

std::string recipe_text(const Recipe& recipe) {
  std::string text =
      fmt::format("version = {}\ncontact_sheet = {}\n", kRecipeVersion, text_value(recipe.contact_sheet));
  for (const auto& entry : recipe.entries) write_entry(*entry, text);
  return text;
}

}  // namespace bn
