// The one table of verbs, in the order the help lists them.

#pragma once

#include <vector>

#include "tools/verb.h"

namespace bn::tools {

std::vector<Verb> all_verbs();

}  // namespace bn::tools
