#include "tools/verbs.h"

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
Verb study_fft_verb();
Verb study_temporal_verb();
Verb validate_verb();
Verb verify_verb();
Verb noise_void_and_cluster_verb();

std::vector<Verb> all_verbs() {
  return {
      bake_verb(),           noise_void_and_cluster_verb(),
      retarget_verb(),       pack_verb(),
      info_verb(),           verify_verb(),
      spectrum_verb(),       report_verb(),
      study_anneal_verb(),   study_fft_verb(),
      study_temporal_verb(), validate_verb(),
      completion_verb(),     help_verb(),
  };
}

}  // namespace bn::tools
