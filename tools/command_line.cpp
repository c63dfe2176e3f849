// CLI11 parts options, values and verbs; meaning and messages are ours. Each argument is collected as
// text, as often as it is given, and assigned afterwards, so that an unknown word is reported before
// a bad value and --help works whatever else is wrong. The only file that includes CLI11: it compiles slowly.

#include "tools/command_line.h"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <deque>

#include "bn/error.h"
#include "bn/options.h"

namespace bn::tools {
namespace {

[[noreturn]] void fail(std::string what, std::string where, std::string remedy) {
  throw Error({.code = ErrorCode::usage,
               .what = std::move(what),
               .where = std::move(where),
               .limit = "",
               .remedy = std::move(remedy)});
}

/// More words than a command line holds.
constexpr int kManyWords = 1 << 28;

/// An argument and the texts given for it.
struct Given {
  const Argument* argument;
  std::vector<std::string> texts = {};
  int switched = 0;
};

/// A CLI11 application whose arguments are `given`; a deque, because CLI11 keeps references.
void add_arguments(CLI::App& app, const std::vector<Argument>& list, std::deque<Given>& given) {
  for (const auto& argument : list) {
    Given& entry = given.emplace_back(Given{&argument});
    const std::string names =
        argument.short_name.empty() ? argument.name : argument.short_name + "," + argument.name;
    if (argument.is_switch()) {
      app.add_flag(names, entry.switched)->disable_flag_override();
    } else {
      // One value each time, or none: how many, and how often, is checked in assign().
      app.add_option(names, entry.texts)
          ->type_size(1)
          ->expected(argument.is_positional() ? 1 : 0, argument.repeats ? kManyWords : 1)
          ->allow_extra_args(argument.repeats)
          ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    }
  }
}

void prepare(CLI::App& app) {
  app.set_help_flag();
  app.allow_extras();
  app.fallthrough();
}

std::string first_word(const std::string& name) { return name.substr(0, name.find(' ')); }

/// What the words are for: a program, and its verb as far as it was named.
struct Place {
  std::string program = "bn";
  std::string verb = {};
};

std::string help_remedy(const Place& of) {
  return of.verb.empty() ? fmt::format("see {} --help", of.program)
                         : fmt::format("see {} {} --help", of.program, of.verb);
}

std::string suggestion(const std::string& nearest, const Place& of) {
  return nearest.empty() ? help_remedy(of) : fmt::format("did you mean {}?", nearest);
}

void fail_unknown_option(const std::string& word, const std::vector<const std::vector<Argument>*>& lists,
                         const Place& of) {
  std::vector<std::string> names;
  for (const auto* list : lists) {
    for (const auto& argument : *list) {
      if (!argument.is_positional()) names.push_back(argument.name);
    }
  }
  const std::string name = word.substr(0, word.find('='));
  fail(fmt::format("there is no option '{}'", name), of.verb, suggestion(nearest_word(name, names), of));
}

/// The second words of the verbs that begin with `group`.
std::vector<std::string> methods_of(const std::string& group, const std::vector<Verb>& verbs) {
  std::vector<std::string> methods;
  for (const auto& verb : verbs) {
    if (verb.name.starts_with(group + " ")) methods.push_back(verb.name.substr(group.size() + 1));
  }
  return methods;
}

[[noreturn]] void fail_missing_method(const std::string& group, const std::vector<Verb>& verbs) {
  throw Error({.code = ErrorCode::usage,
               .what = "the method is missing",
               .where = group,
               .limit = fmt::format("{}", fmt::join(methods_of(group, verbs), ", ")),
               .remedy = fmt::format("write bn {} METHOD and then its options", group)});
}

[[noreturn]] void fail_unknown_verb(const std::string& word, const std::string& group,
                                    const std::vector<Verb>& verbs) {
  if (!group.empty()) {
    const std::vector<std::string> methods = methods_of(group, verbs);
    const std::string nearest = nearest_word(word, methods);
    throw Error({.code = ErrorCode::usage,
                 .what = fmt::format("there is no method '{}'", word),
                 .where = group,
                 .limit = nearest.empty() ? fmt::format("{}", fmt::join(methods, ", ")) : "",
                 .remedy = suggestion(nearest.empty() ? "" : fmt::format("bn {} {}", group, nearest),
                                      {.verb = group})});
  }
  // A method may have been named without its verb, and other programs have a verb for their version.
  std::vector<std::string> known{"version"}, meant{"bn --version"};
  for (const auto& verb : verbs) {
    known.push_back(first_word(verb.name));
    meant.push_back("bn " + known.back());
    if (known.back() == verb.name) continue;
    known.push_back(verb.name.substr(known.back().size() + 1));
    meant.push_back("bn " + verb.name);
  }
  const auto found = std::find(known.begin(), known.end(), nearest_word(word, known));
  fail(fmt::format("there is no verb '{}'", word), "",
       suggestion(found == known.end() ? "" : meant[static_cast<std::size_t>(found - known.begin())], {}));
}

void assign(const Given& given, const Place& of) {
  const Argument& argument = *given.argument;
  if (argument.is_switch()) {
    if (given.switched > 0) argument.assign("");
  } else if (argument.repeats && !given.texts.empty()) {
    for (const auto& text : given.texts) argument.assign(text);
  } else if (given.texts.size() > 1) {
    fail(fmt::format("given {} times, as '{}'", given.texts.size(), fmt::join(given.texts, "' and '")),
         argument.name, "give it once");
  } else if (given.texts.size() == 1 && given.texts.front().empty() && !argument.is_positional()) {
    throw Error({.code = ErrorCode::usage,
                 .what = "a value is missing",
                 .where = argument.name,
                 .limit = argument.allowed,
                 .remedy = fmt::format("write {} {}", argument.name, argument.placeholder)});
  } else if (given.texts.size() == 1) {
    argument.assign(given.texts.front());
  } else if (argument.required) {
    fail(fmt::format("{} is missing",
                     argument.is_positional() ? argument.name : argument.name + " " + argument.placeholder),
         of.verb, help_remedy(of));
  }
}

}  // namespace

Arguments declare(GlobalOptions& globals) {
  Arguments arguments;
  arguments.option("--threads", globals.threads, integer_in(0, 1024),
                   "Threads to use, 0 for every core. The result does not depend on it.");
  arguments.option("--max-memory", globals.memory_limit_bytes, memory_size(),
                   "Refuse work that would need more memory than this.");
  arguments.option("--progress", globals.progress,
                   choice_of<ProgressStyle>({{"auto", ProgressStyle::automatic},
                                             {"bar", ProgressStyle::bar},
                                             {"plain", ProgressStyle::plain},
                                             {"json", ProgressStyle::json},
                                             {"none", ProgressStyle::none}}),
                   "How progress is shown on stderr; auto is a bar on a terminal and plain lines elsewhere.");
  arguments.flag("--quiet", globals.quiet, true,
                 "Print errors only, and what was asked for: JSON, info, help. verify names what fails.",
                 "-q");
  arguments.flag("--help", globals.help, true, "Print this help.", "-h");
  arguments.flag("--version", globals.version, true, "Print the version.", "-V");
  return arguments;
}

namespace {

Invocation parse(const std::vector<std::string>& words, const std::string& program,
                 const std::vector<Verb>& verbs, const Arguments& globals) {
  CLI::App root;
  prepare(root);
  root.require_subcommand(0, 1);
  std::deque<Given> given_globals;
  add_arguments(root, globals.list(), given_globals);

  struct Candidate {
    const Verb* verb;
    CLI::App* app;
    std::deque<Given> given = {};
  };
  std::deque<Candidate> candidates;
  std::vector<std::pair<std::string, CLI::App*>> groups;
  for (const auto& verb : verbs) {
    CLI::App* parent = &root;
    std::string word = verb.name;
    if (const auto space = word.find(' '); space != std::string::npos) {
      const std::string group = word.substr(0, space);
      word = word.substr(space + 1);
      if (groups.empty() || groups.back().first != group) {
        CLI::App* app = root.add_subcommand(group);
        prepare(*app);
        app->require_subcommand(0, 1);
        groups.emplace_back(group, app);
      }
      parent = groups.back().second;
    }
    CLI::App* app = parent->add_subcommand(word);
    prepare(*app);
    auto& candidate = candidates.emplace_back(Candidate{&verb, app});
    add_arguments(*app, verb.arguments.list(), candidate.given);
  }

  Invocation invocation;
  std::string parse_failure;
  try {
    root.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 takes them last first
  } catch (const CLI::ArgumentMismatch&) {
    parse_failure = "a switch takes no value";
  } catch (const CLI::ParseError& error) {
    parse_failure = error.what();
  }
  const Candidate* chosen = nullptr;
  for (const auto& [name, app] : groups) {
    if (app->parsed()) invocation.group = name;
  }
  for (const auto& candidate : candidates) {
    if (candidate.app->parsed()) chosen = &candidate;
  }
  if (chosen != nullptr) invocation.verb = chosen->verb;
  const Place place{program, chosen != nullptr ? chosen->verb->name : invocation.group};

  for (const auto& given : given_globals) {
    const auto& option = given.argument->name;
    if (given.switched > 0 && (option == "--help" || option == "--version")) {
      given.argument->assign("");
      return invocation;
    }
  }
  if (!parse_failure.empty()) fail(parse_failure, place.verb, help_remedy(place));

  auto extras = root.remaining(true);
  std::erase(extras, "--");  // CLI11 hands back the mark after which every word is a positional argument
  // Options belong to a verb: which one is missing or misspelt comes before what they are.
  if (chosen == nullptr && !extras.empty() && extras.front().starts_with("-") && !invocation.group.empty())
    fail_missing_method(invocation.group, verbs);
  if (chosen == nullptr && !verbs.empty() && !extras.empty() && !extras.front().starts_with("-"))
    fail_unknown_verb(extras.front(), invocation.group, verbs);
  for (const auto& word : extras) {
    if (word.size() < 2 || word.front() != '-') continue;
    std::vector<const std::vector<Argument>*> lists{&globals.list()};
    if (chosen != nullptr) lists.push_back(&chosen->verb->arguments.list());
    fail_unknown_option(word, lists, place);
  }
  if (!extras.empty())
    fail(fmt::format("unexpected argument '{}'", extras.front()), place.verb, help_remedy(place));

  for (const auto& given : given_globals) assign(given, place);
  if (chosen != nullptr) {
    for (const auto& given : chosen->given) assign(given, place);
  }
  return invocation;
}

}  // namespace

Invocation parse_command_line(const std::vector<std::string>& words, const std::vector<Verb>& verbs,
                              const Arguments& globals) {
  return parse(words, "bn", verbs, globals);
}

void parse_arguments(const std::vector<std::string>& words, const std::string& program,
                     const Arguments& arguments) {
  parse(words, program, {}, arguments);
}

}  // namespace bn::tools
