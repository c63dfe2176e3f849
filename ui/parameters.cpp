#include "ui/parameters.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bn/texture.h"

namespace bn::ui {
namespace {

template <class T>
void load_number(const std::string& text, T& value, T low, T high) {
  T number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && end == text.data() + text.size() && number >= low && number <= high)
    value = number;
}

}  // namespace

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

void Parameters::operator()(const char* name, int& value, int low, int high) {
  if (!loading_) {
    settings_[name] = fmt::format("{}", value);
  } else if (const auto* number = text(name)) {
    load_number(*number, value, low, high);
  }
}

void Parameters::operator()(const char* name, std::int64_t& value, std::int64_t low, std::int64_t high) {
  if (!loading_) {
    settings_[name] = fmt::format("{}", value);
  } else if (const auto* number = text(name)) {
    load_number(*number, value, low, high);
  }
}

void Parameters::operator()(const char* name, double& value, double low, double high) {
  if (!loading_) {
    settings_[name] = fmt::format("{}", value);
  } else if (const auto* number = text(name)) {
    load_number(*number, value, low, high);
  }
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
