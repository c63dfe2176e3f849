#include "ui/declared.h"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <stdexcept>

#include "bn/kind.h"

namespace bn::ui {

const Option& declared(std::string_view table, std::string_view key) {
  /// An entry, and the options that are bound to it.
  struct Declaration {
    std::shared_ptr<Entry> entry;
    Options options;
  };
  static std::map<std::string, Declaration, std::less<>> known;
  auto found = known.find(table);
  if (found == known.end()) {
    const Kind* kind = find_kind(table);
    if (kind == nullptr) throw std::logic_error(fmt::format("no kind [[{}]]", table));
    const std::shared_ptr<Entry> entry = kind->make();
    found = known.emplace(table, Declaration{entry, entry->options()}).first;
  }
  const Option* option = found->second.options.find(key);
  if (option == nullptr) throw std::logic_error(fmt::format("[[{}]] has no option {}", table, key));
  return *option;
}

std::string hint_of(const Option& option) {
  return fmt::format("{} Allowed: {}{}.", option.help, allowed_text(option),
                     option.unit.empty() ? "" : " " + option.unit);
}

}  // namespace bn::ui
