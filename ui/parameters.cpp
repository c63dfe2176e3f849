#include "ui/parameters.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "bn/texture.h"

namespace bn::ui {

template <class T>
bool read_number(std::string_view text, T& value) {
  const char* const last = text.data() + text.size();
  T number{};
  auto [end, error] = std::from_chars(text.data(), last, number);
  bool whole = error == std::errc() && end == last && !text.empty();
  if constexpr (std::is_integral_v<T>) {
    double real = 0.0;
    if (!whole && read_number(text, real)) {
      // Beyond 2^53 a double is no longer one integer; the greatest T is.
      const double most = static_cast<double>(std::numeric_limits<T>::max());
      whole = real == std::floor(real) && std::abs(real) < most;
      if (whole) number = static_cast<T>(real);
    }
  }
  if (whole) value = number;
  return whole;
}
template bool read_number(std::string_view, int&);
template bool read_number(std::string_view, std::int64_t&);
template bool read_number(std::string_view, double&);

const std::string* Parameters::text(const char* name) const {
  const auto found = settings_.find(name);
  return found == settings_.end() ? nullptr : &found->second;
}

void Parameters::operator()(const char* name, bool& value) {
  if (!loading_) {
    settings_[name] = value ? "yes" : "no";
  } else if (const auto* word = text(name); word != nullptr && (*word == "yes" || *word == "no")) {
    value = *word == "yes";
  }
}

template <class T>
void Parameters::number(const char* name, T& value, T low, T high) {
  if (!loading_) {
    settings_[name] = fmt::format("{}", value);
  } else if (const auto* word = text(name)) {
    T known{};
    if (read_number(*word, known) && known >= low && known <= high) value = known;
  }
}

template <class T>
void Parameters::optional_number(const char* name, std::optional<T>& value) {
  if (!loading_) {
    settings_[name] = value ? fmt::format("{}", *value) : "";
  } else if (const auto* word = text(name)) {
    T known{};
    if (word->empty()) {
      value.reset();
    } else if (read_number(*word, known)) {
      value = known;
    }
  }
}

void Parameters::operator()(const char* name, int& value, int low, int high) {
  number(name, value, low, high);
}
void Parameters::operator()(const char* name, std::int64_t& value, std::int64_t low, std::int64_t high) {
  number(name, value, low, high);
}
void Parameters::operator()(const char* name, double& value, double low, double high) {
  number(name, value, low, high);
}
void Parameters::operator()(const char* name, std::optional<double>& value) { optional_number(name, value); }
void Parameters::operator()(const char* name, std::optional<int>& value) { optional_number(name, value); }
void Parameters::operator()(const char* name, std::optional<std::int64_t>& value) {
  optional_number(name, value);
}

void Parameters::operator()(const char* name, std::string& value) {
  if (!loading_) {
    settings_[name] = value;
  } else if (const auto* word = text(name)) {
    value = *word;
  }
}

void Parameters::operator()(const char* name, std::filesystem::path& value) {
  std::string word = value.string();
  (*this)(name, word);
  value = word;
}

void UndoHistory::note(const Settings& now) {
  if (!states_.empty() && states_[present_] == now) return;
  if (!states_.empty()) states_.resize(present_ + 1);
  states_.push_back(now);
  if (states_.size() > kDepth) states_.erase(states_.begin());
  present_ = states_.size() - 1;
}

std::filesystem::path session_file() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state == '/') {
    return std::filesystem::path(state) / "bn-inspector" / "session.json";
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/') {
    return std::filesystem::path(home) / ".local" / "state" / "bn-inspector" / "session.json";
  }
  return {};
}

Settings read_session(const std::filesystem::path& path) {
  std::ifstream file(path);
  const auto json = nlohmann::json::parse(file, nullptr, false);
  Settings settings;
  if (!json.is_object()) return settings;
  for (const auto& [name, value] : json.items()) {
    if (value.is_string()) settings[name] = value.get<std::string>();
  }
  return settings;
}

void write_session(const std::filesystem::path& path, const Settings& settings) {
  std::error_code failure;
  std::filesystem::create_directories(path.parent_path(), failure);  // the write below says what is wrong
  const auto replace = nlohmann::json::error_handler_t::replace;     // a path need not be UTF-8
  write_text_file(path, nlohmann::json(settings).dump(2, ' ', true, replace) + "\n");
}

}  // namespace bn::ui
