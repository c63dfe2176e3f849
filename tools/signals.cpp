#include "tools/signals.h"

#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <initializer_list>
#include <system_error>
#include <utility>

namespace bn::tools {
namespace {

/// SIGUSR1 wakes the watcher when it is no longer needed.
constexpr int kWake = SIGUSR1;

sigset_t set_of(std::initializer_list<int> signals) {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : signals) sigaddset(&set, signal);
  return set;
}

void end_at_once(int signal) { ::_exit(128 + signal); }

}  // namespace

void occupy_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // open() takes the lowest free number, which is this one. Not fit for writing, on purpose.
    if (::fcntl(stream, F_GETFD) == -1) (void)::open("/dev/null", O_RDONLY);
  }
}

void let_writes_fail() {
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);
}

StopOnSignal::StopOnSignal(std::function<void()> on_stop) : on_stop_(std::move(on_stop)) {
  // Also where a shell has started us in the background with SIGINT ignored: a stop loses nothing.
  ::signal(SIGINT, end_at_once);
  ::signal(SIGTERM, end_at_once);
  const sigset_t all = set_of({SIGINT, SIGTERM, kWake});
  ::pthread_sigmask(SIG_BLOCK, &all, nullptr);
  try {
    watcher_ = std::thread([this] { watch(); });
  } catch (const std::system_error&) {
    // No thread to be had, as under ulimit -u: signals end the run at once, which leaves whole files behind.
    const sigset_t stopping = set_of({SIGINT, SIGTERM});
    ::pthread_sigmask(SIG_UNBLOCK, &stopping, nullptr);
  }
}

StopOnSignal::~StopOnSignal() {
  if (!watcher_.joinable()) return;
  ::pthread_kill(watcher_.native_handle(), kWake);
  watcher_.join();
}

void StopOnSignal::watch() {
  const sigset_t all = set_of({SIGINT, SIGTERM, kWake});
  int signal = 0;
  ::sigwait(&all, &signal);
  if (signal == kWake) return;
  signal_ = signal;
  source_.request_stop();
  // From here on a signal reaches the handler, in this thread, even while a note waits for its reader.
  const sigset_t stopping = set_of({SIGINT, SIGTERM}), wake = set_of({kWake});
  ::pthread_sigmask(SIG_UNBLOCK, &stopping, nullptr);
  on_stop_();
  ::sigwait(&wake, &signal);
}

}  // namespace bn::tools
