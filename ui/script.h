// A small language that uses the inspector as a person does. docs/inspector.md lists its commands.

#pragma once

#include <imgui.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bn::ui {

class App;
struct Item;

class Script {
 public:
  /// Parses the whole text. Errors: invalid_input, naming `name` and the line.
  Script(std::string_view text, std::string name);
  static Script read(const std::filesystem::path& path);

  /// Does what comes before the next frame: sets ImGui's input, or looks whether a wait is over. False: the
  /// script has ended. Errors: verification_failed (an `expect` that does not hold, a wait that takes too
  /// long), invalid_input (no such item); each with its line.
  bool before_frame(App& app);

  /// Where the frame that was just drawn is to be written; empty: nowhere.
  std::filesystem::path take_screenshot() { return std::exchange(screenshot_, {}); }

  /// Random events go on; one of them may have asked to quit.
  bool is_random() const { return random_left_ > 0; }

 private:
  struct Command {
    int line;
    std::vector<std::string> words;
  };
  /// The input of one frame.
  struct Input {
    ImVec2 mouse{-1, -1};
    bool left = false, right = false;
    float wheel = 0.0f;
    int key = 0;
    bool ctrl = false, shift = false, alt = false;
    std::string text = {};
  };

  /// Starts a command; it may queue inputs, or leave something to wait for.
  void start(App& app, const Command& command);
  /// Has the item that the command acts on scrolled into sight, where it is not. True: it waits for that.
  bool scrolls_to(const Command& command);
  void apply(const Input& input);
  bool holds(const std::vector<std::string>& condition, std::string& found) const;
  const Item& item(const std::string& name) const;
  ImVec2 point(const std::string& name, double x = 0.5, double y = 0.5) const;
  void queue_click(ImVec2 at, bool right = false, bool ctrl = false);
  void queue_key(const std::string& chord);
  void queue_text(const std::string& text);
  void queue_random(App& app);
  [[noreturn]] void fail(bool verdict, std::string what, std::string remedy = {}) const;

  using Clock = std::chrono::steady_clock;
  std::string name_;
  std::vector<Command> commands_;
  std::size_t next_ = 0;
  int line_ = 0, scrolled_to_ = -1;  ///< the latter: the line for whose sake it was scrolled
  std::deque<Input> inputs_;
  ImVec2 mouse_{-1, -1};
  int frames_to_wait_ = 4;  // until the window has found its layout
  std::vector<std::string> condition_;  ///< of a wait-for
  Clock::time_point deadline_{}, last_frame_{};
  std::filesystem::path screenshot_;
  bool measuring_ = false;
  int random_left_ = 0;
  std::uint64_t random_seed_ = 0, random_draws_ = 0;
  std::vector<double> frame_seconds_;
};

}  // namespace bn::ui
