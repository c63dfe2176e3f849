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
#include <vector>

#include "bn/core.h"

namespace bn::ui {

/// start() again supersedes what runs: it is asked to stop, and its result is dropped. The window never
/// waits, but in the destructor. All functions are for one thread.
template <class T>
class Task {
 public:
  using Work = std::function<T(const Execution&)>;

  ~Task() {
    for (auto& job : jobs_) job.thread.request_stop();
  }

  /// `work` runs on its own thread, at low priority, so that the window and runs keep their speed, with an
  /// Execution that carries stop, progress and `threads`.
  void start(Work work, int threads = 0) {
    stop();
    auto state = std::make_shared<State>();
    current_ = state;
    jobs_.push_back(
        {state, std::jthread([state, threads, work = std::move(work)](std::stop_token stop_token) {
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
         })});
  }

  /// Asks what runs to stop; its result is dropped.
  void stop() {
    current_.reset();
    for (auto& job : jobs_) job.thread.request_stop();
  }
  /// Asks it to stop, and lets poll() say how it ended.
  void request_stop() {
    for (auto& job : jobs_) job.thread.request_stop();
  }

  bool running() const { return current_ != nullptr; }
  double progress() const { return current_ ? current_->progress.load() : 0.0; }

  /// The result, once, when it is there. Rethrows what `work` threw. Call it every frame.
  std::optional<T> poll() {
    std::erase_if(jobs_, [&](const Job& job) {
      return job.state != current_ && job.state->done.load(std::memory_order_acquire);
    });
    if (!current_ || !current_->done.load(std::memory_order_acquire)) return {};
    const auto state = std::exchange(current_, nullptr);
    if (state->error) std::rethrow_exception(state->error);
    return std::move(state->result);
  }

 private:
  struct State {
    std::atomic<bool> done{false};
    std::atomic<double> progress{0.0};
    std::optional<T> result;
    std::exception_ptr error;
  };
  struct Job {
    std::shared_ptr<State> state;
    std::jthread thread;
  };
  std::shared_ptr<State> current_;
  std::vector<Job> jobs_;
};

}  // namespace bn::ui
