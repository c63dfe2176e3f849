#include "ui/optimum.h"

#include <chrono>
#include <new>

#include "bn/error.h"

namespace bn::ui {

Optimum::Optimum(const AnnealProblem& problem) {
  task_.start(
      [levels = problem.channels.at(0).levels, options = problem.retarget](const Execution& execution) {
        const auto start = std::chrono::steady_clock::now();
        Solved solved{.tile = solve_retarget(levels, options, execution)};
        solved.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return solved;
      });
}

void Optimum::poll() {
  try {
    if (auto solved = task_.poll()) solved_ = std::move(solved);
  } catch (const Error& error) {
    failure_ = error.what();
  } catch (const std::bad_alloc&) {
    failure_ = "out of memory";
  }
}

}  // namespace bn::ui
