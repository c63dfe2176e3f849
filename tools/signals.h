// Signals: SIGINT and SIGTERM ask for a clean stop; broken pipes and full files become errors.

#pragma once

#include <atomic>
#include <functional>
#include <stop_token>
#include <thread>

namespace bn::tools {

/// Makes a closed stdin, stdout or stderr harmless: without this the next file opened would take its
/// number, and results would be written into a texture. Writing to it then fails as it should.
void occupy_standard_streams();

/// SIGPIPE and SIGXFSZ end a process by default; ignored, the write fails with an error that says why.
void let_writes_fail();

/// While it lives, the first SIGINT or SIGTERM requests a stop and calls `on_stop`; the second ends
/// the process at once with 128 + its number. A thread of its own waits for them, so that no code of
/// ours runs inside a signal handler. Make it before any other thread: threads inherit what it blocks.
class StopOnSignal {
 public:
  explicit StopOnSignal(std::function<void()> on_stop);
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;

  std::stop_token token() const { return source_.get_token(); }
  /// The signal that asked for the stop; 0 if none did.
  int signal() const { return signal_; }

 private:
  void watch();

  std::stop_source source_;
  std::function<void()> on_stop_;
  std::atomic<int> signal_ = 0;
  std::thread watcher_;
};

}  // namespace bn::tools
