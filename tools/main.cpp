// The `bn` command: finds the verb, runs it, and turns every failure into one message and one exit code.

#include <fmt/format.h>

#include "bn/error.h"
#include "bn/version.h"
#include "tools/command_line.h"
#include "tools/failure.h"
#include "tools/help_text.h"
#include "tools/signals.h"
#include "tools/verbs.h"

namespace bn::tools {
namespace {

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
    return globals.help ? 0 : exit_code_of(ErrorCode::usage);
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
    const Error error = error_in_flight("bn");
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
