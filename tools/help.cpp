// bn help: the same texts as --help, and all of them at once.

#include "tools/command_line.h"
#include "tools/help_text.h"
#include "tools/recipe_tables.h"
#include "tools/verbs.h"

namespace bn::tools {
Verb help_verb() {
  const auto all = std::make_shared<bool>(false), recipes = std::make_shared<bool>(false);
  Verb verb;
  verb.name = "help";
  verb.summary = "Print the overview, or the whole manual.";
  verb.examples = {{"bn help", "the overview, as bn --help"},
                   {"bn help --all | less", "the help of every verb, as Markdown"},
                   {"bn help --recipes", "every key of a recipe"},
                   {"bn bake --help", "the help of one verb"}};
  verb.details = "Prints the overview of verbs. Each verb explains itself with --help.";
  verb.arguments.flag("--all", *all, true, "Print the help of every verb, as Markdown.");
  verb.arguments.flag("--recipes", *recipes, true,
                      "Print the keys of every kind of texture in a recipe, as Markdown.");
  verb.run = [all, recipes](Session& session) {
    if (*recipes) return session.output.write(recipe_tables());
    GlobalOptions globals;
    const Arguments global_arguments = declare(globals);
    session.output.write(*all ? manual(all_verbs(), global_arguments)
                              : overview_help(all_verbs(), global_arguments));
  };
  return verb;
}

}  // namespace bn::tools
