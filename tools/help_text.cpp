#include "tools/help_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace bn::tools {
namespace {

constexpr std::size_t kColumns = 80;
/// Where the explanation of an option begins.
constexpr std::size_t kExplanation = 26;

constexpr std::string_view kExitCodes =
    "Exit codes\n"
    "  0 ok, 1 usage, 2 input or output, 3 invalid input, 4 out of memory or over a\n"
    "  limit, 5 verification failed, 130 and 143 stopped by SIGINT and SIGTERM, 70 a\n"
    "  defect in the program\n";

/// `text` in lines of at most kColumns, each but the first indented. A line of the text that starts with
/// a space is kept as it is.
std::string wrapped(std::string_view text, std::size_t indent) {
  std::string out;
  std::size_t column = indent;
  while (!text.empty()) {
    const auto end = std::min(text.find_first_of(" \n"), text.size());
    if (column > indent && column + 1 + end > kColumns) {
      out += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (column > indent) {
      out += ' ';
      ++column;
    }
    out += text.substr(0, end);
    column += end;
    text.remove_prefix(end);
    if (text.starts_with("\n")) {
      const auto breaks = std::min(text.find_first_not_of('\n'), text.size());
      out += std::string(breaks, '\n') + std::string(indent, ' ');
      column = indent;
      text.remove_prefix(breaks);
    } else if (!text.empty()) {
      text.remove_prefix(1);
    }
  }
  return out;
}

std::string line(const std::string& left, const std::string& right) {
  std::string text = "  " + left;
  text += text.size() + 2 > kExplanation ? "\n" + std::string(kExplanation, ' ')
                                         : std::string(kExplanation - text.size(), ' ');
  return text + wrapped(right, kExplanation) + "\n";
}

/// A command that is wider than the text goes on in a further line, as a shell takes it.
std::string command_text(std::string command) {
  std::string text = "  ";
  for (std::size_t width = kColumns - 4; command.size() > width; width = kColumns - 8) {
    const std::size_t end = command.rfind(" -", width);  // an option stays with its value
    if (end == std::string::npos) break;
    text += command.substr(0, end) + " \\\n      ";
    command.erase(0, end + 1);
  }
  return text + command;
}

std::string examples_text(const std::vector<Example>& examples) {
  std::string text = "Examples\n";
  for (const auto& [command, purpose] : examples) {
    std::string lines = wrapped(purpose, 4);
    for (std::size_t at = 0; (at = lines.find("\n    ", at)) != std::string::npos; at += 5)
      lines.replace(at, 5, "\n  # ");
    text += fmt::format("  # {}\n{}\n", lines, command_text(command));
  }
  return text + "\n";
}

/// The positional arguments, or the flags of one group.
std::string arguments_text(std::string_view title, const Arguments& arguments, bool positional,
                           std::string_view group = "") {
  std::string text;
  for (const auto& argument : arguments.list()) {
    if (argument.is_positional() != positional || argument.group != group || argument.hidden) continue;
    std::string left = argument.short_name.empty() ? "" : argument.short_name + ", ";
    left += argument.name;
    if (argument.repeats) left += "...";
    if (!positional && !argument.is_switch()) left += " " + argument.placeholder;
    std::string right = argument.help;
    if (!argument.allowed.empty()) right += fmt::format(" Allowed: {}.", argument.allowed);
    if (!argument.initial.empty()) right += fmt::format(" Default: {}.", argument.initial);
    text += line(left, right);
  }
  return text.empty() ? "" : fmt::format("{}\n{}\n", title, text);
}

std::string usage_line(const Verb& verb, std::string text) {
  for (const auto& argument : verb.arguments.list()) {
    if (!argument.required && argument.is_positional())
      text += fmt::format(" [{}{}]", argument.name, argument.repeats ? "..." : "");
    if (!argument.required) continue;
    const std::string& flag = argument.short_name.empty() ? argument.name : argument.short_name;
    text += argument.is_positional() ? " " + argument.name + (argument.repeats ? "..." : "")
                                     : fmt::format(" {} {}", flag, argument.placeholder);
  }
  return text + " [OPTIONS]";
}

/// What a verb's help says that no other's does; ends without an empty line. `command` runs it: "bn bake".
std::string own_help(const Verb& verb, const std::string& command) {
  std::string text = examples_text(verb.examples) + wrapped(verb.details, 0) +
                     "\n\nUsage: " + usage_line(verb, command) + "\n\n" +
                     arguments_text("Arguments", verb.arguments, true) +
                     arguments_text("Options", verb.arguments, false);
  std::vector<std::string> groups;
  for (const auto& argument : verb.arguments.list()) {
    const bool is_new = std::find(groups.begin(), groups.end(), argument.group) == groups.end();
    if (!argument.group.empty() && !argument.hidden && is_new) groups.push_back(argument.group);
  }
  for (const auto& group : groups) text += arguments_text(group, verb.arguments, false, group);
  text.pop_back();
  return text;
}

bool is_in_group(const Verb& verb, const std::string& group) { return verb.name.starts_with(group + " "); }

}  // namespace

std::string overview_help(const std::vector<Verb>& verbs, const Arguments& globals) {
  std::string text = examples_text(
      {{"bn bake textures/default.toml --out out",
        "everything a recipe names, with proofs and a contact sheet"},
       {"bn noise void-and-cluster --size 128x128 --seed 1 -o mask.png", "one blue-noise mask"},
       {"bn retarget mask.png --radius 6 --motion 4 -o atlas.png", "its 81 retarget tiles, proven optimal"},
       {"bn verify out", "recompute every figure that the files claim"}});
  text +=
      "bn bakes blue-noise masks, single ones and one a frame, and proven retarget\ntiles, for real-time "
      "path tracing.\n\n";
  text += "Usage: bn VERB [ARGUMENTS]\n\nVerbs\n";
  for (const auto& verb : verbs) text += line(verb.name, verb.summary);
  text += "\n" + arguments_text("Options of every verb", globals, false);
  text += std::string(kExitCodes) + "\n";
  return text + "bn VERB --help explains one verb. Results go to stdout, progress and messages to\nstderr.\n";
}

std::string group_help(const std::string& group, const std::vector<Verb>& verbs) {
  std::vector<Example> examples;
  std::string methods;
  for (const auto& verb : verbs) {
    if (!is_in_group(verb, group)) continue;
    examples.push_back(verb.examples.front());
    methods += line(verb.name.substr(group.size() + 1), verb.summary);
  }
  return examples_text(examples) +
         fmt::format("Usage: bn {0} METHOD [OPTIONS]\n\nMethods\n{1}\n", group, methods) +
         fmt::format("bn {} METHOD --help explains one.\n", group);
}

std::string verb_help(const Verb& verb, const Arguments& globals) {
  return own_help(verb, "bn " + verb.name) + "\n" + arguments_text("Options of every verb", globals, false) +
         std::string(kExitCodes);
}

std::string program_help(const Verb& program) {
  return own_help(program, program.name) + "\n" + std::string(kExitCodes);
}

std::string manual(const std::vector<Verb>& verbs, const Arguments& globals) {
  std::string text = "## bn\n\n```\n" + overview_help(verbs, globals) + "```\n";
  for (const auto& verb : verbs)
    text += fmt::format("\n## bn {}\n\n```\n{}```\n", verb.name, own_help(verb, "bn " + verb.name));
  return text;
}

}  // namespace bn::tools
