// bn/value.h - floor 0: values that options have and files record.

#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "bn/grid.h"

namespace bn {

/// A value of an option or of a recorded figure: a truth, a number, a text or a short list of whole numbers,
/// such as a size or an offset. monostate is "not set".
using Value =
    std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<std::int64_t>>;

/// A recorded figure: its name, as in recipes and JSON, and its value.
struct Fact {
  std::string key;
  Value value;
  friend bool operator==(const Fact&, const Fact&) = default;
};

/// Recorded figures in the order in which they were added.
class Facts {
 public:
  void add(std::string key, Value value) { list_.push_back({std::move(key), std::move(value)}); }
  void add(std::string key, Offset value) {
    add(std::move(key), Value(std::vector<std::int64_t>{value.x, value.y}));
  }
  template <class Text>
  requires(std::is_convertible_v<Text, std::string_view>) void add(std::string key, const Text& value) {
    add(std::move(key), Value(std::string(std::string_view(value))));
  }
  template <class Integer>
  requires(std::is_integral_v<Integer> && !std::is_same_v<Integer, bool>) void add(std::string key,
                                                                                   Integer value) {
    add(std::move(key), Value(static_cast<std::int64_t>(value)));
  }

  /// Null if there is none of this name.
  const Value* find(std::string_view key) const {
    for (const Fact& fact : list_) {
      if (fact.key == key) return &fact.value;
    }
    return nullptr;
  }
  /// The figure as a T (bool, an integer, double, std::string, Offset); nothing if it is missing, of another
  /// type, or does not fit.
  template <class T>
  std::optional<T> get(std::string_view key) const {
    const Value* value = find(key);
    if (!value) return std::nullopt;
    if constexpr (std::is_same_v<T, Offset>) {
      const auto* list = std::get_if<std::vector<std::int64_t>>(value);
      if (!list || list->size() != 2) return std::nullopt;
      constexpr auto fits = [](std::int64_t x) { return x == static_cast<int>(x); };
      if (!fits((*list)[0]) || !fits((*list)[1])) return std::nullopt;
      return Offset{static_cast<int>((*list)[0]), static_cast<int>((*list)[1])};
    } else if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
      const auto* whole = std::get_if<std::int64_t>(value);
      if (!whole || !std::in_range<T>(*whole)) return std::nullopt;
      return static_cast<T>(*whole);
    } else {
      const T* held = std::get_if<T>(value);
      return held ? std::optional<T>(*held) : std::nullopt;
    }
  }

  bool empty() const { return list_.empty(); }
  std::size_t size() const { return list_.size(); }
  auto begin() const { return list_.begin(); }
  auto end() const { return list_.end(); }
  friend bool operator==(const Facts&, const Facts&) = default;

 private:
  std::vector<Fact> list_;
};

}  // namespace bn
