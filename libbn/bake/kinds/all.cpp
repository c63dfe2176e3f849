// The kinds of texture that there are. A new kind: its class in a file of this folder, and one line in
// `shipped`.

#include <algorithm>

#include "bake/kinds/all.h"
#include "bn/kind.h"
#include "core/refuse.h"

namespace bn {
namespace {

std::vector<const Kind*>& registry() {
  static std::vector<const Kind*> shipped = {&baking::mask_kind(), &baking::spatiotemporal_kind(),
                                             &baking::vector_kind(), &baking::retarget_kind()};
  return shipped;
}

}  // namespace

const std::vector<const Kind*>& kinds() { return registry(); }

const Kind* find_kind(std::string_view table) {
  const auto& all = registry();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Kind* kind) { return kind->table == table; });
  return found == all.end() ? nullptr : *found;
}

void register_kind(const Kind& kind) {
  if (kind.table.empty() || !kind.make) refuse("kind", "has no table or makes no entries", "both");
  for (const Kind* other : registry()) {
    const bool same_verb = !kind.verb.empty() && kind.verb == other->verb;
    if (kind.table == other->table || same_verb) {
      refuse("kind", "'" + (same_verb ? kind.verb : kind.table) + "' is taken",
             "a table and a verb of its own");
    }
  }
  registry().push_back(&kind);
}

}  // namespace bn
