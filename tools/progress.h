// Progress and notes on stderr: a bar on a terminal, plain lines at intervals elsewhere, or one JSON object a
// line.

#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <nlohmann/json_fwd.hpp>

#include "bn/error.h"

namespace bn::tools {

enum class ProgressStyle { automatic, bar, plain, json, none };

/// The only writer to stderr. Thread safe. Trouble there is never an error: progress is no result.
class ProgressDisplay {
 public:
  using Clock = std::chrono::steady_clock;

  /// `now` is the clock; tests bring one of their own.
  explicit ProgressDisplay(std::function<Clock::time_point()> now = Clock::now) : now_(std::move(now)) {}
  /// Until this is called only errors are shown. `automatic` is a bar where stderr is a terminal,
  /// plain otherwise.
  void set_style(ProgressStyle style);

  /// Begins a task; share and time start anew. Ends the one before.
  void start(std::string_view task);
  /// The share of the task done, 0..1, and the time left where the caller knows better than the pace
  /// so far. Call it as often as you like: a bar repaints ten times a second at most, plain and JSON
  /// lines come every few seconds; the first JSON line comes at once, and says that work has begun.
  void update(double share, std::optional<double> seconds_left = {});
  /// Another name for what the same bar counts.
  void rename(std::string_view task);
  /// The task is done: wipes the bar. Plain says nothing (the result speaks); JSON says done 1.
  void finish();

  /// A line for a person, shown in the bar and plain styles; in JSON {"event":"note","text":...}.
  void note(std::string_view text);
  /// A line for a program, shown in the JSON style only.
  void event(const nlohmann::ordered_json& event);

  /// The last word of a run that failed: "bn: " and the message; in JSON {"event":"error",...}.
  void error(const Error& error, int exit_code);

 private:
  double seconds_since_start() const;
  void paint(double share, std::optional<double> seconds_left);
  void write_json(const nlohmann::ordered_json& line);
  void wipe();

  std::function<Clock::time_point()> now_;
  ProgressStyle style_ = ProgressStyle::none;
  std::mutex mutex_;
  std::string task_;
  bool running_ = false;
  bool painted_ = false;
  Clock::time_point started_{};
  Clock::time_point next_report_{};
};

/// "4 s", "2 min 5 s", "3 h 10 min".
std::string readable_duration(double seconds);

}  // namespace bn::tools
