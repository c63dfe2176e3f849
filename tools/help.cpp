// bn help: the same texts as --help, and all of them at once.

#include <fmt/format.h>

#include "bn/error.h"
#include "bn/options.h"
#include "tools/command_line.h"
#include "tools/help_text.h"
#include "tools/recipe_tables.h"
#include "tools/verbs.h"

namespace bn::tools {
namespace {

/// The help of the verb or group of verbs that `words` name. Errors: usage (there is none).
std::string help_of(const std::vector<std::string>& words, const std::vector<Verb>& verbs,
                    const Arguments& globals) {
  const std::string name = fmt::format("{}", fmt::join(words, " "));
  std::vector<std::string> names;
  for (const Verb& verb : verbs) {
    if (verb.name == name) return verb_help(verb, globals);
    names.push_back(verb.name);
    names.push_back(verb.name.substr(0, verb.name.find(' ')));
  }
  for (const Verb& verb : verbs) {
    if (verb.name.starts_with(name + " ")) return group_help(name, verbs);
  }
  const std::string nearest = nearest_word(name, names);
  throw Error(
      {.code = ErrorCode::usage,
       .what = fmt::format("there is no verb '{}'", name),
       .where = "help",
       .limit = "",
       .remedy = nearest.empty() ? "see bn --help" : fmt::format("did you mean bn help {}?", nearest)});
}

/// A word of a verb's name; completion knows them.
ValueKind<std::string> verb_word() {
  ValueKind<std::string> kind;
  kind.parse = [](std::string_view text, std::string_view) { return std::string(text); };
  return kind;
}

}  // namespace

Verb help_verb() {
  const auto words = std::make_shared<std::vector<std::string>>();
  const auto all = std::make_shared<bool>(false), recipes = std::make_shared<bool>(false);
  Verb verb;
  verb.name = "help";
  verb.summary = "Print the overview, the help of one verb, or the whole manual.";
  verb.examples = {{"bn help", "the overview, as bn --help"},
                   {"bn help --all | less", "the help of every verb, as Markdown"},
                   {"bn help --recipes", "every key of a recipe"},
                   {"bn help bake", "the help of one verb, as bn bake --help"}};
  verb.details =
      "Prints the overview of verbs, or the help of one. Each verb explains itself with --help too.";
  verb.arguments.optional_list("VERB", *words, verb_word(),
                               "The verb to explain; noise has several methods.");
  verb.arguments.flag("--all", *all, true, "Print the help of every verb, as Markdown.");
  verb.arguments.flag("--recipes", *recipes, true,
                      "Print the keys of every kind of texture in a recipe, as Markdown.");
  verb.run = [words, all, recipes](Session& session) {
    if (*recipes) return session.output.write(recipe_tables());
    GlobalOptions globals;
    const Arguments global_arguments = declare(globals);
    const std::vector<Verb> verbs = all_verbs();
    session.output.write(*all              ? manual(verbs, global_arguments)
                         : !words->empty() ? help_of(*words, verbs, global_arguments)
                                           : overview_help(verbs, global_arguments));
  };
  return verb;
}

}  // namespace bn::tools
