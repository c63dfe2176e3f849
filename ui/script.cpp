#include "ui/script.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>
#include <utility>

#include "bn/error.h"
#include "ui/app.h"
#include "ui/items.h"
#include "ui/keys.h"

namespace bn::ui {
namespace {

constexpr double kDefaultWaitSeconds = 30.0;

/// How many words follow each command.
const std::map<std::string_view, std::pair<std::size_t, std::size_t>> kCommands{
    {"open", {1, 1}},        {"drop", {1, 1}},         {"click", {1, 2}},    {"ctrl-click", {1, 1}},
    {"right-click", {1, 1}}, {"double-click", {1, 1}}, {"hover", {1, 3}},    {"drag", {5, 5}},
    {"wheel", {2, 2}},       {"key", {1, 9}},          {"type", {1, 1}},     {"set", {2, 2}},
    {"choose", {2, 2}},      {"wait", {1, 1}},         {"wait-for", {2, 4}}, {"expect", {2, 3}},
    {"screenshot", {1, 1}},  {"resize", {2, 2}},       {"scale", {1, 1}},    {"theme", {1, 1}},
    {"print", {1, 1}},       {"measure", {1, 1}},      {"random", {2, 2}},   {"quit", {0, 0}}};

/// Words are parted by spaces; "..." holds one with spaces, # begins a comment.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < line.size();) {
    if (line[i] == ' ' || line[i] == '\t' || line[i] == '\r') {
      ++i;
    } else if (line[i] == '#') {
      break;
    } else if (line[i] == '"') {
      const std::size_t end = line.find('"', i + 1);
      words.push_back(line.substr(i + 1, end == std::string::npos ? end : end - i - 1));
      i = end == std::string::npos ? line.size() : end + 1;
    } else {
      const std::size_t end = std::min(line.find_first_of(" \t\r", i), line.size());
      words.push_back(line.substr(i, end - i));
      i = end;
    }
  }
  return words;
}

/// The number that a text begins with: "3638 (1.04 %)" is 3638.
bool leading_number(const std::string& text, double& number) {
  char* end = nullptr;
  number = std::strtod(text.c_str(), &end);
  return end != text.c_str();
}

/// Relations that need no value.
bool stands_alone(const std::string& relation) {
  return relation == "shown" || relation == "gone" || relation == "enabled" || relation == "disabled";
}

}  // namespace

Script::Script(std::string_view text, std::string name) : name_(std::move(name)) {
  std::istringstream lines{std::string(text)};
  std::string line;
  while (std::getline(lines, line)) {
    ++line_;
    auto words = words_of(line);
    if (words.empty()) continue;
    const auto known = kCommands.find(words[0]);
    if (known == kCommands.end())
      fail(false, fmt::format("there is no command \"{}\"", words[0]), "docs/inspector.md lists them");
    const auto [least, most] = known->second;
    if (words.size() - 1 < least || words.size() - 1 > most) {
      fail(false, fmt::format("{} takes {}..{} words, here are {}", words[0], least, most, words.size() - 1));
    }
    commands_.push_back({line_, std::move(words)});
  }
}

Script Script::read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) {
    throw Error(
        {.code = ErrorCode::io, .what = "cannot be read", .where = path.string(), .limit = "", .remedy = ""});
  }
  return Script(text.str(), path.string());
}

void Script::fail(bool verdict, std::string what, std::string remedy) const {
  throw Error({.code = verdict ? ErrorCode::verification_failed : ErrorCode::invalid_input,
               .what = std::move(what),
               .where = fmt::format("{}:{}", name_, line_),
               .limit = "",
               .remedy = std::move(remedy)});
}

const Item& Script::item(const std::string& name) const {
  const Item* found = items::find(name);
  if (found == nullptr) {
    fail(false, fmt::format("nothing on the screen is called \"{}\"", name),
         fmt::format("there are: {}", fmt::join(items::names(), ", ")));
  }
  return *found;
}

ImVec2 Script::point(const std::string& name, double x, double y) const {
  const Item& found = item(name);
  if (!found.visible) fail(false, fmt::format("\"{}\" is out of sight", name));
  return {found.min.x + (found.max.x - found.min.x) * static_cast<float>(x),
          found.min.y + (found.max.y - found.min.y) * static_cast<float>(y)};
}

void Script::queue_click(ImVec2 at, bool right, bool ctrl) {
  inputs_.push_back({.mouse = at, .ctrl = ctrl});
  inputs_.push_back({.mouse = at, .left = !right, .right = right, .ctrl = ctrl});
  inputs_.push_back({.mouse = at, .ctrl = ctrl});
}

void Script::queue_key(const std::string& text) {
  const auto chord = parse_chord(text);
  if (!chord)
    fail(false, fmt::format("there is no key \"{}\"", text), "for example a, f5, ctrl+shift+z, enter");
  inputs_.push_back({.mouse = mouse_, .ctrl = chord->ctrl, .shift = chord->shift, .alt = chord->alt});
  inputs_.push_back(
      {.mouse = mouse_, .key = chord->key, .ctrl = chord->ctrl, .shift = chord->shift, .alt = chord->alt});
  inputs_.push_back({.mouse = mouse_});
}

void Script::queue_text(const std::string& text) {
  inputs_.push_back({.mouse = mouse_, .text = text});
  inputs_.push_back({.mouse = mouse_});
}

bool Script::holds(const std::vector<std::string>& condition, std::string& found) const {
  const Item* shown = items::find(condition[0]);
  found = shown != nullptr ? shown->text : "nothing of that name";
  const std::string& relation = condition[1];
  if (relation == "shown") return shown != nullptr && shown->visible;
  if (relation == "gone") return shown == nullptr;
  if (relation == "enabled" || relation == "disabled") {
    return shown != nullptr && shown->enabled == (relation == "enabled");
  }
  if (condition.size() < 3) fail(false, fmt::format("{} needs a value after it", relation));
  if (shown == nullptr) return relation == "!=";
  const std::string& wanted = condition[2];
  if (relation == "contains") return found.find(wanted) != std::string::npos;
  double left = 0, right = 0;
  const bool numbers = leading_number(found, left) && leading_number(wanted, right);
  if (relation == "=") return found == wanted || (numbers && left == right);
  if (relation == "!=") return !(found == wanted || (numbers && left == right));
  if (relation == "<") return numbers && left < right;
  if (relation == ">") return numbers && left > right;
  if (relation == "<=") return numbers && left <= right;
  if (relation == ">=") return numbers && left >= right;
  fail(false, fmt::format("there is no relation \"{}\"", relation),
       "= != < > <= >= contains; shown, gone, enabled, disabled");
}

bool Script::before_frame(App& app) {
  const auto now = Clock::now();
  if (measuring_) {
    if (last_frame_ != Clock::time_point{}) {
      frame_seconds_.push_back(std::chrono::duration<double>(now - last_frame_).count());
    }
    last_frame_ = now;
    if (now < deadline_) return true;
    measuring_ = false;
    std::sort(frame_seconds_.begin(), frame_seconds_.end());
    const auto at = [&](double share) {
      return frame_seconds_[static_cast<std::size_t>(share * static_cast<double>(frame_seconds_.size() - 1))];
    };
    if (!frame_seconds_.empty()) {
      fmt::print("{} frames, median {:.2f} ms ({:.1f} a second), 99 % within {:.2f} ms, worst {:.2f} ms\n",
                 frame_seconds_.size(), 1e3 * at(0.5), 1.0 / at(0.5), 1e3 * at(0.99), 1e3 * at(1.0));
      std::fflush(stdout);
    }
  }
  for (;;) {
    if (!inputs_.empty()) {
      apply(inputs_.front());
      inputs_.pop_front();
      return true;
    }
    if (random_left_ > 0) {
      --random_left_;
      queue_random(app);
      continue;
    }
    if (frames_to_wait_ > 0) {
      --frames_to_wait_;
      apply({.mouse = mouse_});
      return true;
    }
    if (!condition_.empty()) {
      std::string found;
      if (holds(condition_, found)) {
        condition_.clear();
        frames_to_wait_ = 2;  // what came up with it finds its place
        continue;
      } else if (Clock::now() > deadline_) {
        fail(true, fmt::format("waited in vain for {}; it is: {}", fmt::join(condition_, " "), found),
             app.errors().empty() ? "" : fmt::format("the window says: {}", app.errors().back().what()));
      } else {
        // As a window does: what is waited for has the processor in between.
        std::this_thread::sleep_for(std::chrono::milliseconds(16));
        last_frame_ = Clock::now();
        return true;
      }
    }
    if (next_ == commands_.size()) return false;
    const Command& command = commands_[next_++];
    line_ = command.line;
    if (command.words[0] == "quit") return false;
    if (scrolls_to(command)) {
      --next_;  // again, once it is in sight
      frames_to_wait_ = 3;
      continue;
    }
    start(app, command);
    if (measuring_) return true;
  }
}

bool Script::scrolls_to(const Command& command) {
  static constexpr std::array kOnItems{"click", "ctrl-click", "right-click", "double-click", "hover",
                                       "drag",  "wheel",      "set",         "choose"};
  const auto& words = command.words;
  if (std::find(kOnItems.begin(), kOnItems.end(), words[0]) == kOnItems.end()) return false;
  const Item* found = items::find(words[1]);
  if (found == nullptr || found->whole || std::exchange(scrolled_to_, line_) == line_) return false;
  items::scroll_to(words[1]);
  return true;
}

void Script::apply(const Input& input) {
  ImGuiIO& io = ImGui::GetIO();
  mouse_ = input.mouse;
  io.MousePos = input.mouse.x < 0 ? ImVec2(-FLT_MAX, -FLT_MAX) : input.mouse;
  io.MouseDown[0] = input.left;
  io.MouseDown[1] = input.right;
  io.MouseWheel = input.wheel;
  std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
  if (input.key > 0) io.KeysDown[input.key] = true;
  io.KeyCtrl = input.ctrl;
  io.KeyShift = input.shift;
  io.KeyAlt = input.alt;
  if (!input.text.empty()) io.AddInputCharactersUTF8(input.text.c_str());
}

void Script::start(App& app, const Command& command) {
  const auto& words = command.words;
  const std::string& verb = words[0];
  const auto number = [&](std::size_t i) {
    double value = 0;
    if (!leading_number(words[i], value)) fail(false, fmt::format("\"{}\" is no number", words[i]));
    return value;
  };
  frames_to_wait_ = 2;  // ImGui answers most input one or two frames later
  if (verb == "open") {
    app.open(words[1]);
  } else if (verb == "drop") {
    app.take(words[1]);
  } else if (verb == "click" && words.size() == 3) {
    queue_click({static_cast<float>(number(1)), static_cast<float>(number(2))});
  } else if (verb == "click") {
    queue_click(point(words[1]));
  } else if (verb == "ctrl-click") {
    queue_click(point(words[1]), false, true);
  } else if (verb == "right-click") {
    queue_click(point(words[1]), true);
  } else if (verb == "double-click") {
    queue_click(point(words[1]));
    queue_click(point(words[1]));
  } else if (verb == "hover") {
    const bool at = words.size() == 4;
    mouse_ = point(words[1], at ? number(2) : 0.5, at ? number(3) : 0.5);
  } else if (verb == "drag") {
    const ImVec2 from = point(words[1], number(2), number(3)), to = point(words[1], number(4), number(5));
    inputs_.push_back({.mouse = from});
    for (int i = 0; i <= 8; ++i) {
      const float share = static_cast<float>(i) / 8.0f;
      inputs_.push_back(
          {.mouse = {from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share}, .left = true});
    }
    inputs_.push_back({.mouse = to});
  } else if (verb == "wheel") {
    const ImVec2 at = point(words[1]);
    inputs_.push_back({.mouse = at});
    inputs_.push_back({.mouse = at, .wheel = static_cast<float>(number(2))});
  } else if (verb == "key") {
    for (std::size_t i = 1; i < words.size(); ++i) queue_key(words[i]);
  } else if (verb == "type") {
    queue_text(words[1]);
  } else if (verb == "set") {
    const ImVec2 at = point(words[1]);
    queue_click(at, false, true);
    mouse_ = at;
    queue_key("ctrl+a");
    words[2].empty() ? queue_key("delete") : queue_text(words[2]);
    queue_key("enter");
  } else if (verb == "choose") {
    // The list opens first; then the entry is on the screen.
    queue_click(point(words[1]));
    commands_.insert(commands_.begin() + static_cast<std::ptrdiff_t>(next_),
                     {command.line, {"click", words[2]}});
  } else if (verb == "wait") {
    frames_to_wait_ = static_cast<int>(std::clamp(number(1), 0.0, 1e5));
  } else if (verb == "wait-for") {
    frames_to_wait_ = 0;
    condition_.assign(words.begin() + 1, words.end());
    double seconds = kDefaultWaitSeconds;
    const bool alone = stands_alone(words[2]);
    if (words.size() == (alone ? 4u : 5u)) seconds = number(alone ? 3 : 4), condition_.pop_back();
    deadline_ =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  } else if (verb == "expect") {
    frames_to_wait_ = 0;
    std::string found;
    if (!holds({words.begin() + 1, words.end()}, found)) {
      fail(true,
           fmt::format("expected {}; it is: {}", fmt::join(words.begin() + 1, words.end(), " "), found));
    }
  } else if (verb == "screenshot") {
    screenshot_ = words[1];
    frames_to_wait_ = 1;
  } else if (verb == "resize") {
    ImGui::GetIO().DisplaySize = {static_cast<float>(std::clamp(number(1), 64.0, 8192.0)),
                                  static_cast<float>(std::clamp(number(2), 64.0, 8192.0))};
  } else if (verb == "scale") {
    app.scale = std::clamp(number(1), 0.5, 4.0);
  } else if (verb == "theme") {
    app.dark = words[1] == "dark";
  } else if (verb == "print") {
    frames_to_wait_ = 0;
    fmt::print("{}: {}\n", words[1], item(words[1]).text);
    std::fflush(stdout);
  } else if (verb == "random") {
    random_left_ = static_cast<int>(std::clamp(number(1), 0.0, 1e9));
    random_seed_ = static_cast<std::uint64_t>(std::max(number(2), 0.0));
    random_draws_ = 0;
  } else if (verb == "measure") {
    frames_to_wait_ = 0;
    measuring_ = true;
    last_frame_ = {};
    frame_seconds_.clear();
    deadline_ =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(number(1)));
  }
}

}  // namespace bn::ui
