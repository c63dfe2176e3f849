#include "core/progress.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>
#ifdef __SANITIZE_THREAD__
#include <exception>
#endif

#include "bn/error.h"

namespace bn {
namespace {

constexpr int kMaxThreads = 1024;
constexpr int kMostOversubscribed = 8;

/// How many of `wanted` threads can run at once, this one among them: a limit on processes (ulimit -u) or on
/// address space (ulimit -v) may allow fewer. TBB starts its workers where no failure can be handled, so
/// threads are tried out before. 15 us each.
int threads_to_be_had(int wanted) {
  std::atomic<bool> done = false;
  std::vector<std::jthread> others;
  try {
    while (static_cast<int>(others.size()) + 1 < wanted) others.emplace_back([&done] { done.wait(false); });
  } catch (const std::system_error&) {  // as many as there are
  } catch (const std::bad_alloc&) {
  }
  // What a worker allocates when it starts cannot fail with grace either, so there must be room for it.
  constexpr std::size_t kRoomBytes = std::size_t{64} << 20;
  void* const room =
      ::mmap(nullptr, kRoomBytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  const bool has_room = room != MAP_FAILED;
  if (has_room) ::munmap(room, kRoomBytes);
  done = true;
  done.notify_all();
  return has_room ? static_cast<int>(others.size()) + 1 : 1;
}

/// This thread's arena of exactly `threads` slots. Kept from call to call, since making one costs more
/// than many a loop; one for each calling thread, so that nested loops never wait for each other's slots.
[[maybe_unused]] tbb::task_arena& arena_of(int threads) {
  thread_local std::map<int, tbb::task_arena> arenas;
  return arenas.try_emplace(threads, threads).first->second;
}

#ifdef __SANITIZE_THREAD__
/// Debian's TBB is not built for the thread sanitizer, which cannot see its synchronisation and would
/// report every loop. Under the sanitizer the indices are dealt to plain threads.
void fork_and_join(int threads, std::int64_t count, const std::function<void(std::int64_t)>& body) {
  std::atomic<std::int64_t> next = 0;
  std::mutex mutex;
  std::exception_ptr first_error;
  const auto work = [&] {
    try {
      for (std::int64_t i = next++; i < count; i = next++) body(i);
    } catch (...) {
      next = count;
      const std::lock_guard lock(mutex);
      if (!first_error) first_error = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    for (std::int64_t i = 1; i < std::min<std::int64_t>(threads, count); ++i) others.emplace_back(work);
    work();
  }
  if (first_error) std::rethrow_exception(first_error);
}
#endif

}  // namespace

int thread_count(const Execution& execution) {
  if (execution.threads < 0 || execution.threads > kMaxThreads) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = fmt::format("{} threads", execution.threads),
                 .where = "threads",
                 .limit = fmt::format("0..{}, 0 for every core", kMaxThreads),
                 .remedy = ""});
  }
  return execution.threads == 0 ? tbb::info::default_concurrency() : execution.threads;
}

void check_memory(const Execution& execution, std::uint64_t bytes, std::string_view where) {
  if (bytes <= execution.memory_limit_bytes) return;
  constexpr double kMiB = 1024.0 * 1024.0;
  throw Error(
      {.code = ErrorCode::over_limit,
       .what = fmt::format("needs {:.0f} MiB of memory", static_cast<double>(bytes) / kMiB),
       .where = std::string(where),
       .limit = fmt::format("at most {:.0f} MiB", static_cast<double>(execution.memory_limit_bytes) / kMiB),
       .remedy = "ask for less, or raise the limit with --max-memory"});
}

void throw_if_stopped(const Execution& execution) {
  if (execution.stop.stop_requested()) {
    throw Error({.code = ErrorCode::cancelled, .what = "stopped", .where = "", .limit = "", .remedy = ""});
  }
}

void parallel_for(const Execution& execution, std::int64_t count,
                  const std::function<void(std::int64_t)>& body) {
  const int threads = thread_count(execution);
  if (threads == 1 || count <= 1) {
    for (std::int64_t i = 0; i < count; ++i) body(i);
    return;
  }
#ifdef __SANITIZE_THREAD__
  fork_and_join(threads, count, body);
#else
  // The process-wide limit lets the tests run more threads than the machine has cores, to show that
  // the number changes nothing. It is no higher than that: TBB may start a worker for every arena
  // that was ever made. An arena that asks for more makes TBB print a warning.
  static const int most = threads_to_be_had(std::max(tbb::info::default_concurrency(), kMostOversubscribed));
  if (most == 1) {
    for (std::int64_t i = 0; i < count; ++i) body(i);
    return;
  }
  static const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                         static_cast<std::size_t>(most));
  tbb::task_arena& arena = arena_of(std::min(threads, most));
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::int64_t>(0, count, 1),
        [&](const tbb::blocked_range<std::int64_t>& range) {
          for (std::int64_t i = range.begin(); i < range.end(); ++i) body(i);
        },
        tbb::simple_partitioner());
  });
#endif
}

ProgressMeter::ProgressMeter(const Execution& execution, std::uint64_t total)
    : report_(execution.progress), total_(std::max<std::uint64_t>(total, 1)) {}

void ProgressMeter::advance(std::uint64_t amount) {
  if (!report_) return;
  const std::uint64_t done = done_.fetch_add(amount, std::memory_order_relaxed) + amount;
  // Two hundred reports are enough for a bar; the lock is taken only for those.
  constexpr std::uint64_t kReports = 200;
  const auto notch = [&](std::uint64_t at) {
    return static_cast<std::uint64_t>(static_cast<double>(at) / static_cast<double>(total_) * kReports);
  };
  if (notch(done) == notch(done - amount)) return;
  const std::lock_guard lock(mutex_);
  const double share = std::min(1.0, static_cast<double>(done) / static_cast<double>(total_));
  if (share <= reported_) return;
  reported_ = share;
  report_(share);
}

void ProgressMeter::finish() {
  if (!report_) return;
  const std::lock_guard lock(mutex_);
  if (reported_ >= 1.0) return;
  reported_ = 1.0;
  report_(1.0);
}

}  // namespace bn
