#include "tools/verbs.h"

#include "tools/kind_verb.h"

namespace bn::tools {

// A new verb: a file of its name that defines `Verb name_verb()`, and one line in each list.
Verb bake_verb();
Verb completion_verb();
Verb help_verb();
Verb info_verb();
Verb pack_verb();
Verb report_verb();
Verb retarget_verb();
Verb spectrum_verb();
Verb study_anneal_verb();
Verb study_convergence_verb();
Verb study_fft_verb();
Verb study_presets_verb();
Verb study_search_verb();
Verb study_temporal_verb();
Verb validate_verb();
Verb verify_verb();

std::vector<Verb> all_verbs() {
  std::vector<Verb> verbs = {bake_verb()};
  // The commands of the kinds of texture; retarget has one of its own hand, which prints tables and traces.
  for (const Kind* kind : kinds()) {
    if (kind->verb == "retarget") {
      verbs.push_back(retarget_verb());
    } else if (!kind->verb.empty()) {
      verbs.push_back(kind_verb(*kind));
    }
  }
  for (auto make : {pack_verb, info_verb, verify_verb, spectrum_verb, report_verb, study_anneal_verb,
                    study_convergence_verb, study_fft_verb, study_presets_verb, study_search_verb,
                    study_temporal_verb, validate_verb, completion_verb, help_verb}) {
    verbs.push_back(make());
  }
  return verbs;
}

}  // namespace bn::tools
