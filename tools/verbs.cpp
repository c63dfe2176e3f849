#include "tools/verbs.h"

namespace bn::tools {

// A new verb: a file of its name that defines `Verb name_verb()`, and one line in each list.
Verb completion_verb();
Verb help_verb();

std::vector<Verb> all_verbs() {
  return {
      completion_verb(),
      help_verb(),
  };
}

}  // namespace bn::tools
