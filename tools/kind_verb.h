// The command that makes one entry of a kind: `bn noise void-and-cluster`.

#pragma once

#include "bn/kind.h"
#include "tools/verb.h"

namespace bn::tools {

Verb kind_verb(const Kind& kind);

}  // namespace bn::tools
