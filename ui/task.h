// One computation off the window's thread, whose result the window picks up.

#pragma once

#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "bn/execution.h"

namespace bn::ui {

/// start() again supersedes what runs: it is asked to stop, its result is dropped, and the new work begins
/// when it has ended, so that no two hold memory. The window never waits, but in the destructor. All
/// functions are for one thread.
template <class T>
class Task {
 public:
  using Work = std::function<T(const Execution&)>;

  ~Task() { stop(); }

  /// `work` runs on its own thread, at low priority, so that the window and runs keep their speed, with an
  /// Execution that carries stop, progress and `threads`.
  void start(Work work, int threads = 0) {
    stop();
    current_ = std::make_shared<State>();
    waiting_ = std::move(work);
    threads_ = threads;
    begin_when_free();
  }

  /// Asks what runs to stop; its result is dropped.
  void stop() {
    current_.reset();
    waiting_ = nullptr;
    request_stop();
  }
  /// Asks it to stop, and lets poll() say how it ended.
  void request_stop() {
    if (current_) current_->stopped = true;
    if (thread_.joinable()) thread_.request_stop();
  }

  bool running() const { return current_ != nullptr; }
  double progress() const { return current_ ? current_->progress.load() : 0.0; }

  /// The result, once, when it is there. Rethrows what `work` threw. Call it every frame.
  std::optional<T> poll() {
    begin_when_free();
    if (!current_ || !current_->done.load(std::memory_order_acquire)) return {};
    const auto state = std::exchange(current_, nullptr);
    if (state->error) std::rethrow_exception(state->error);
    return std::move(state->result);
  }

 private:
  struct State {
    std::atomic<bool> done{false};
    std::atomic<double> progress{0.0};
    bool stopped = false;  ///< before it began
    std::optional<T> result;
    std::exception_ptr error;
  };

  void begin_when_free() {
    if (running_ && running_->done.load(std::memory_order_acquire)) {
      thread_.join();
      running_.reset();
    }
    if (running_ || !waiting_) return;
    running_ = current_;
    thread_ = std::jthread([state = running_, threads = threads_,
                            work = std::exchange(waiting_, nullptr)](std::stop_token stop_token) {
      // Of this thread alone; where it is not granted, the work merely competes.
      constexpr int kNice = 10;
      setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice);
      Execution execution{.threads = threads, .stop = stop_token};
      execution.progress = [&](double done) { state->progress = done; };
      try {
        state->result = work(execution);
      } catch (...) {
        state->error = std::current_exception();
      }
      state->done.store(true, std::memory_order_release);
    });
    if (current_->stopped) thread_.request_stop();
  }

  std::shared_ptr<State> current_;  ///< whose result is wanted
  std::shared_ptr<State> running_;  ///< of the thread; another than current_ where that one waits for its end
  Work waiting_;
  int threads_ = 0;
  std::jthread thread_;
};

}  // namespace bn::ui
