// The declarations of options: what each type reads from its variable and writes to it.

#include "bn/options.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/measured_word.h"

namespace bn {
namespace {

using List = std::vector<std::int64_t>;

}  // namespace

Option& Options::add(Option option) {
  list_.push_back(std::move(option));
  return list_.back();
}

Option* Options::find(std::string_view key) {
  for (Option& option : list_) {
    const bool formerly = std::find(option.former.begin(), option.former.end(), key) != option.former.end();
    if (option.key == key || formerly) return &option;
  }
  return nullptr;
}

Option& Options::boolean(std::string key, bool& value, std::string help) {
  return add({.key = std::move(key),
              .help = std::move(help),
              .type = OptionType::boolean,
              .get = [&value]() -> Value { return value; },
              .set = [&value](const Value& given) { value = std::get<bool>(given); }});
}

Option& Options::text(std::string key, std::string& value, std::string help) {
  return add({.key = std::move(key),
              .help = std::move(help),
              .type = OptionType::text,
              .get = [&value]() -> Value { return value.empty() ? Value() : Value(value); },
              .set = [&value](const Value& given) { value = std::get<std::string>(given); }});
}

Option& Options::measured_word(std::string key, std::vector<MeasuredWord> words, std::string help,
                               std::function<std::pair<std::string, double>()> get,
                               std::function<void(std::string_view word, double number)> set) {
  Option option{.key = std::move(key), .help = std::move(help), .type = OptionType::measured};
  option.get = [get = std::move(get), words]() -> Value {
    const auto [word, number] = get();
    for (const MeasuredWord& known : words) {
      if (known.word == word) return has_number(known) ? fmt::format("{}:{}", word, number) : word;
    }
    return {};
  };
  option.set = [set = std::move(set), words](const Value& given) {
    const auto parts = measured_parts(words, std::get<std::string>(given));
    if (parts) set(parts->first, parts->second);
  };
  option.measured_words = std::move(words);
  return add(std::move(option));
}

Option& Options::whole(std::string key, std::int64_t least, std::int64_t most, std::string help,
                       std::function<Value()> get, std::function<void(const Value&)> set) {
  return add({.key = std::move(key),
              .help = std::move(help),
              .type = OptionType::integer,
              .least = least,
              .most = most,
              .get = std::move(get),
              .set = std::move(set)});
}

Option& Options::number(std::string key, double least, double most, std::string help,
                        std::function<Value()> get, std::function<void(const Value&)> set) {
  return add({.key = std::move(key),
              .help = std::move(help),
              .type = OptionType::real,
              .least_real = least,
              .most_real = most,
              .get = std::move(get),
              .set = std::move(set)});
}

Option& Options::word(std::string key, std::vector<std::string> words, std::string help,
                      std::function<Value()> get, std::function<void(const Value&)> set) {
  return add({.key = std::move(key),
              .help = std::move(help),
              .type = OptionType::choice,
              .words = std::move(words),
              .get = std::move(get),
              .set = std::move(set)});
}

Option& Options::size(std::string key, Extent& value, int least, int most, std::string help) {
  return add({.key = std::move(key),
              .help = std::move(help),
              .type = OptionType::size,
              .least = least,
              .most = most,
              .get = [&value]() -> Value {
                return List{value.width, value.height};
              },
              .set =
                  [&value](const Value& given) {
                    const List& list = std::get<List>(given);
                    value = {static_cast<int>(list[0]), static_cast<int>(list[1])};
                  }});
}

Option& Options::shape(std::string key, Shape& value, int least, int most, std::string help) {
  return add({.key = std::move(key),
              .help = std::move(help),
              .type = OptionType::shape,
              .least = least,
              .most = most,
              .get = [&value]() -> Value {
                return value.depth == 1 ? List{value.width, value.height}
                                        : List{value.width, value.height, value.depth};
              },
              .set =
                  [&value](const Value& given) {
                    const List& list = std::get<List>(given);
                    value = {static_cast<int>(list[0]), static_cast<int>(list[1]),
                             list.size() > 2 ? static_cast<int>(list[2]) : 1};
                  }});
}

Option& Options::offset(std::string key, std::optional<Offset>& value, int least, int most,
                        std::string unset_word, std::string help) {
  return add({.key = std::move(key),
              .help = std::move(help),
              .type = OptionType::offset,
              .least = least,
              .most = most,
              .unset_word = std::move(unset_word),
              .get = [&value]() -> Value {
                return value ? Value(List{value->x, value->y}) : Value();
              },
              .set =
                  [&value](const Value& given) {
                    const List* list = std::get_if<List>(&given);
                    value.reset();
                    if (list) value = {static_cast<int>((*list)[0]), static_cast<int>((*list)[1])};
                  }});
}

Option& Options::offset(std::string key, Offset& value, int least, int most, std::string help) {
  return add({.key = std::move(key),
              .help = std::move(help),
              .type = OptionType::offset,
              .least = least,
              .most = most,
              .get = [&value]() -> Value {
                return List{value.x, value.y};
              },
              .set =
                  [&value](const Value& given) {
                    const List& list = std::get<List>(given);
                    value = {static_cast<int>(list[0]), static_cast<int>(list[1])};
                  }});
}

Option& Options::integers(std::string key, std::vector<int>& value, int least, int most,
                          std::size_t most_elements, std::string help) {
  return add({.key = std::move(key),
              .help = std::move(help),
              .type = OptionType::integers,
              .least = least,
              .most = most,
              .most_elements = most_elements,
              .get = [&value]() -> Value {
                return value.empty() ? Value() : Value(List(value.begin(), value.end()));
              },
              .set =
                  [&value](const Value& given) {
                    const List* list = std::get_if<List>(&given);
                    value.clear();
                    if (list) value.assign(list->begin(), list->end());
                  }});
}

}  // namespace bn
