// The `bn` command: finds the verb, runs it, and turns every failure into one message and one exit code.

#include <fmt/format.h>

#include <filesystem>
#include <new>
#include <system_error>

#include "bn/error.h"
#include "bn/version.h"
#include "tools/command_line.h"
#include "tools/help_text.h"
#include "tools/signals.h"
#include "tools/verbs.h"

namespace bn::tools {
namespace {

/// An exception that nobody meant to throw; EX_SOFTWARE of sysexits.h.
constexpr auto kDefect = static_cast<ErrorCode>(70);

/// The only place where a failure becomes a number.
int exit_code_of(ErrorCode code, int signal) {
  switch (code) {
    case ErrorCode::usage:
      return 1;
    case ErrorCode::io:
      return 2;
    case ErrorCode::invalid_input:
      return 3;
    case ErrorCode::over_limit:
      return 4;
    case ErrorCode::verification_failed:
      return 5;
    case ErrorCode::cancelled:
      return 128 + signal;
  }
  return static_cast<int>(kDefect);
}

/// The library's own errors are told as they are; all others are put into the same words. Call it
/// inside a catch block.
Error error_in_flight() {
  try {
    throw;
  } catch (const Error& error) {
    return error;
  } catch (const std::filesystem::filesystem_error& error) {
    return Error({.code = ErrorCode::io,
                  .what = error.code().message(),
                  .where = error.path1().string(),
                  .limit = "",
                  .remedy = "check the path and its permissions"});
  } catch (const std::bad_alloc&) {
    return Error({.code = ErrorCode::over_limit,
                  .what = "out of memory",
                  .where = "",
                  .limit = "",
                  .remedy = "ask for less, or use fewer --threads"});
  } catch (const std::length_error&) {
    return Error({.code = ErrorCode::over_limit,
                  .what = "more elements than any memory holds",
                  .where = "",
                  .limit = "",
                  .remedy = "ask for less"});
  } catch (const std::system_error& error) {
    const bool no_resources = error.code() == std::errc::resource_unavailable_try_again ||
                              error.code() == std::errc::not_enough_memory;
    return Error({.code = no_resources ? ErrorCode::over_limit : ErrorCode::io,
                  .what = error.what(),
                  .where = "",
                  .limit = "",
                  .remedy = no_resources ? "use fewer --threads" : ""});
  } catch (const std::exception& defect) {
    return Error({.code = kDefect,
                  .what = fmt::format("a defect in bn: {}", defect.what()),
                  .where = "",
                  .limit = "",
                  .remedy = "please report it with the command that shows it"});
  } catch (...) {
    return Error({.code = kDefect,
                  .what = "a defect in bn: an exception of no known type",
                  .where = "",
                  .limit = "",
                  .remedy = "please report it with the command that shows it"});
  }
}

/// Returns the exit code of a run that does not fail.
int run(const std::vector<std::string>& words, const StopOnSignal& signals, ProgressDisplay& progress) {
  const std::vector<Verb> verbs = all_verbs();
  GlobalOptions globals;
  const Arguments global_arguments = declare(globals);
  const Invocation invocation = parse_command_line(words, verbs, global_arguments);

  Output output(globals.quiet);
  if (globals.version) {
    output.write(fmt::format("bn {}\n", kVersion));
    return 0;
  }
  if (globals.help || invocation.verb == nullptr) {
    const bool has_group = !invocation.group.empty();
    output.write(invocation.verb != nullptr ? verb_help(*invocation.verb, global_arguments)
                 : has_group                ? group_help(invocation.group, verbs)
                                            : overview_help(verbs, global_arguments));
    // Without a verb nothing was done, which a script should notice.
    return globals.help ? 0 : exit_code_of(ErrorCode::usage, 0);
  }
  progress.set_style(globals.quiet ? ProgressStyle::none : globals.progress);
  Session session{.execution = {.threads = globals.threads,
                                .stop = signals.token(),
                                .memory_limit_bytes = globals.memory_limit_bytes},
                  .output = output,
                  .progress = progress,
                  .quiet = globals.quiet};
  invocation.verb->run(session);
  progress.finish();
  return 0;
}

int guarded_run(const std::vector<std::string>& words) {
  ProgressDisplay progress;
  const StopOnSignal signals([&] { progress.note("stopping; once more to end at once"); });
  try {
    return run(words, signals, progress);
  } catch (...) {
    const Error error = error_in_flight();
    const int exit_code = exit_code_of(error.code(), signals.signal());
    progress.error(error, exit_code);
    return exit_code;
  }
}

}  // namespace
}  // namespace bn::tools

int main(int argc, char** argv) {
  bn::tools::occupy_standard_streams();
  bn::tools::let_writes_fail();
  return bn::tools::guarded_run(std::vector<std::string>(argv + (argc > 0), argv + argc));
}
