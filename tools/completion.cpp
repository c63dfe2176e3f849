// bn completion: a script for the shell, made from the same declarations as the help.

#include <fmt/format.h>

#include <map>
#include <set>

#include "bn/version.h"
#include "tools/command_line.h"
#include "tools/verbs.h"

namespace bn::tools {
namespace {

enum class Shell { bash };

std::string names_of(const Arguments& arguments) {
  std::string names;
  for (const auto& argument : arguments.list()) {
    if (!argument.is_positional() && !argument.hidden) names += argument.name + " ";
  }
  return names;
}

std::string generator(const Argument& argument) {
  switch (argument.completion) {
    case Completion::file:
      return argument.choices.empty() ? "-f" : fmt::format("-f -W '{}'", fmt::join(argument.choices, " "));
    case Completion::folder:
      return "-d";
    case Completion::choice:
      return fmt::format("-W '{}'", fmt::join(argument.choices, " "));
    case Completion::none:
      return "-W ''";
  }
  return "";
}

/// One line a value: "  'bake --out') generate=(-d) ;;".
std::string value_cases(const std::string& verb, const Arguments& arguments) {
  std::string text;
  for (const auto& argument : arguments.list()) {
    if (argument.is_positional() || argument.is_switch() || argument.hidden) continue;
    std::string patterns = fmt::format("'{} {}'", verb, argument.name);
    if (!argument.short_name.empty()) patterns += fmt::format("|'{} {}'", verb, argument.short_name);
    text += fmt::format("    {}) generate=({}) ;;\n", patterns, generator(argument));
  }
  return text;
}

/// Every word that a verb's name has.
std::string words_of(const std::vector<Verb>& verbs) {
  std::set<std::string> words;
  for (const auto& verb : verbs) {
    const auto space = verb.name.find(' ');
    words.insert(verb.name.substr(0, space));
    if (space != std::string::npos) words.insert(verb.name.substr(space + 1));
  }
  return fmt::format("{}", fmt::join(words, " "));
}

std::string bash_script() {
  GlobalOptions globals;
  const Arguments global_arguments = declare(globals);
  std::map<std::string, std::string> words_after;  // what may follow "" (bn itself) or a group's name
  std::string value_lines, word_lines;
  const std::vector<Verb> verbs = all_verbs();
  for (const auto& verb : verbs) {
    const auto space = verb.name.find(' ');
    const std::string first = verb.name.substr(0, space);
    auto& words = words_after[""];
    if (words.find(first + " ") == std::string::npos) words += first + " ";
    if (space != std::string::npos) words_after[first] += verb.name.substr(space + 1) + " ";
    value_lines += value_cases(verb.name, verb.arguments) + value_cases(verb.name, global_arguments);
    std::string positional;
    for (const auto& argument : verb.arguments.list()) {
      if (argument.is_positional()) positional = generator(argument);
    }
    if (verb.name == "help") positional = fmt::format("-W '{}'", words_of(verbs));
    word_lines += fmt::format("    '{}') options='{}' generate=({}) ;;\n", verb.name,
                              names_of(verb.arguments) + names_of(global_arguments),
                              positional.empty() ? "-W ''" : positional);
  }
  for (const auto& [group, words] : words_after) {
    value_lines += value_cases(group, global_arguments);
    word_lines += fmt::format("    '{}') options='{}' generate=(-W '{}') ;;\n", group,
                              names_of(global_arguments), words);
  }
  return fmt::format(R"(# bash completion for bn {}; made by: bn completion bash
_bn() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} verb= i options= generate=()
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case ${{COMP_WORDS[i]}} in
      -*) ;;
      *) case "${{verb:+$verb }}${{COMP_WORDS[i]}}" in
           {}) verb=${{verb:+$verb }}${{COMP_WORDS[i]}} ;;
         esac ;;
    esac
  done
  case "$verb $before" in
{}    *) ;;
  esac
  if [ ${{#generate[@]}} = 0 ]; then
    case $verb in
{}    esac
    [[ $word != -* ]] || generate=(-W "$options")
  fi
  [[ ${{generate[0]}} != -[fd] ]] || compopt -o filenames 2>/dev/null || true
  mapfile -t COMPREPLY < <(compgen "${{generate[@]}}" -- "$word")
}}
complete -F _bn bn
)",
                     kVersion,
                     [&verbs] {
                       std::string names;
                       for (const auto& verb : verbs) {
                         const auto space = verb.name.find(' ');
                         if (space != std::string::npos) names += "'" + verb.name.substr(0, space) + "'|";
                         names += "'" + verb.name + "'|";
                       }
                       names.pop_back();
                       return names;
                     }(),
                     value_lines, word_lines);
}

}  // namespace

Verb completion_verb() {
  const auto shell = std::make_shared<Shell>(Shell::bash);
  Verb verb;
  verb.name = "completion";
  verb.summary = "Print a completion script for bash.";
  verb.examples = {
      {"source <(bn completion bash)", "complete bn's verbs, options and values in this shell"},
      {"bn completion bash > ~/.local/share/bash-completion/completions/bn", "in every bash from now on"}};
  verb.details = "Prints a script that teaches the shell bn's verbs, options and values.";
  verb.arguments.positional("SHELL", *shell, choice_of<Shell>({{"bash", Shell::bash}}),
                            "The shell to complete in: bash.");
  verb.run = [shell](Session& session) {
    if (*shell == Shell::bash) session.output.write(bash_script());
  };
  return verb;
}

}  // namespace bn::tools
