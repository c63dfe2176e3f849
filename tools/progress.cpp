#include "tools/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bn/error.h"
#include "tools/session.h"

namespace bn::tools {
namespace {

using Json = nlohmann::ordered_json;
using namespace std::chrono_literals;

// Short tasks end before a bar would be more than a flicker.
constexpr auto kFirstPaint = 200ms;
constexpr auto kRepaint = 100ms;
constexpr auto kLineInterval = 5s;
constexpr int kNarrowestTerminal = 40;

void write_to_stderr(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

int terminal_columns() {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return std::max<int>(size.ws_col, kNarrowestTerminal);
}

/// Seconds left if the pace holds; none while it is too early to say.
std::optional<double> extrapolated(double share, double elapsed) {
  if (share < 0.01 || elapsed < 0.5) return std::nullopt;
  return elapsed * (1.0 - share) / share;
}

/// "bn: " before every line: a recipe's message has one for each mistake.
std::string prefixed(std::string_view message) {
  std::string text = "bn: ";
  for (const char c : message) {
    text += c;
    if (c == '\n') text += "bn: ";
  }
  return text + "\n";
}

}  // namespace

std::string readable_duration(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::ceil(std::clamp(seconds, 0.0, 1e9)));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

void ProgressDisplay::set_style(ProgressStyle style) {
  const std::lock_guard lock(mutex_);
  style_ = style;
  if (style == ProgressStyle::automatic) {
    style_ = ::isatty(STDERR_FILENO) ? ProgressStyle::bar : ProgressStyle::plain;
  }
}

double ProgressDisplay::seconds_since_start() const {
  return std::chrono::duration<double>(now_() - started_).count();
}

void ProgressDisplay::start(std::string_view task) {
  const std::lock_guard lock(mutex_);
  wipe();
  task_ = task;
  running_ = true;
  started_ = now_();
  next_report_ = started_;
  if (style_ == ProgressStyle::bar) next_report_ += kFirstPaint;
  if (style_ == ProgressStyle::plain) next_report_ += kLineInterval;
}

void ProgressDisplay::rename(std::string_view task) {
  const std::lock_guard lock(mutex_);
  task_ = task;
}

void ProgressDisplay::update(double share, std::optional<double> seconds_left) {
  const std::lock_guard lock(mutex_);
  const auto now = now_();
  if (!running_ || now < next_report_) return;
  next_report_ =
      now + (style_ == ProgressStyle::bar ? Clock::duration(kRepaint) : Clock::duration(kLineInterval));
  paint(share, seconds_left);
}

void ProgressDisplay::finish() {
  const std::lock_guard lock(mutex_);
  if (running_ && style_ == ProgressStyle::json) paint(1.0, 0.0);
  wipe();
  running_ = false;
}

void ProgressDisplay::note(std::string_view text) {
  const std::lock_guard lock(mutex_);
  wipe();
  if (style_ == ProgressStyle::json) {
    write_json({{"event", "note"}, {"text", text}});
  } else if (style_ != ProgressStyle::none) {
    write_to_stderr(prefixed(text));
  }
}

void ProgressDisplay::event(const Json& event) {
  const std::lock_guard lock(mutex_);
  if (style_ == ProgressStyle::json) write_json(event);
}

void ProgressDisplay::error(const Error& error, int exit_code) {
  const std::lock_guard lock(mutex_);
  wipe();
  running_ = false;
  if (style_ != ProgressStyle::json) return write_to_stderr(prefixed(error.what()));
  const ErrorInfo& info = error.info();
  write_json({{"event", "error"},
              {"exit_code", exit_code},
              {"where", info.where},
              {"what", info.what},
              {"allowed", info.limit},
              {"remedy", info.remedy}});
}

void ProgressDisplay::write_json(const Json& line) {
  // File names may hold any bytes; JSON may not.
  write_to_stderr(line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
}

void ProgressDisplay::paint(double share, std::optional<double> seconds_left) {
  const double elapsed = seconds_since_start();
  if (!seconds_left) seconds_left = extrapolated(share, elapsed);
  const int percent = static_cast<int>(share * 100);
  const std::string left = seconds_left ? readable_duration(*seconds_left) + " left" : "";
  switch (style_) {
    case ProgressStyle::json: {
      Json line{{"event", "progress"}, {"task", task_}, {"done", share}, {"seconds", elapsed}};
      if (seconds_left) line["seconds_left"] = *seconds_left;
      write_json(line);
      break;
    }
    case ProgressStyle::plain:
      write_to_stderr(fmt::format("bn: {}: {} %{}{}\n", task_, percent, left.empty() ? "" : ", ", left));
      break;
    case ProgressStyle::bar: {
      const std::string tail = fmt::format(" {:3} % {:>16}", percent, left);
      const int columns = terminal_columns() - 1;
      const int task_width = std::min<int>(static_cast<int>(task_.size()), columns / 3);
      const int cells = std::max(0, columns - task_width - static_cast<int>(tail.size()) - 3);
      const std::string filled(static_cast<std::size_t>(share * cells), '#');
      const std::string bar = cells < 5 ? "" : fmt::format(" [{:-<{}}]", filled, cells);
      write_to_stderr("\r\x1b[K" + (task_.substr(0, task_width) + bar + tail).substr(0, columns));
      painted_ = true;
      break;
    }
    case ProgressStyle::automatic:
    case ProgressStyle::none:
      break;
  }
}

void ProgressDisplay::wipe() {
  if (painted_) write_to_stderr("\r\x1b[K");
  painted_ = false;
}

Execution Session::execution_showing(std::string_view task) {
  progress.start(task);
  Execution shown = execution;
  shown.progress = [this](double share) { progress.update(share); };
  return shown;
}

}  // namespace bn::tools
