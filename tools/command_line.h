// From the words of a command line to a verb with its values.

#pragma once

#include <string>
#include <vector>

#include "tools/verb.h"

namespace bn::tools {

/// Options that every verb takes, before or after its name.
struct GlobalOptions {
  int threads = 0;
  std::uint64_t memory_limit_bytes = Execution{}.memory_limit_bytes;
  ProgressStyle progress = ProgressStyle::automatic;
  bool quiet = false;
  bool help = false;
  bool version = false;
};

/// The declarations of `globals`, which must outlive them.
Arguments declare(GlobalOptions& globals);

struct Invocation {
  const Verb* verb = nullptr;  ///< none: no verb was named
  std::string group;           ///< "noise" where only the first of two words was named
};

/// Assigns every value given in `words` (without the program's name) to its target.
/// With --help or --version nothing else is checked or assigned.
/// Throws usage: unknown words (with the nearest known one), missing or repeated arguments, bad values.
Invocation parse_command_line(const std::vector<std::string>& words, const std::vector<Verb>& verbs,
                              const Arguments& globals);
/// The same for a program without verbs; messages call it `program`.
void parse_arguments(const std::vector<std::string>& words, const std::string& program,
                     const Arguments& arguments);

}  // namespace bn::tools
