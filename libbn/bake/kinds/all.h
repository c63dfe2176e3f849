// The kinds that ship, each defined in the file of its name.

#pragma once

#include "bn/kind.h"

namespace bn::baking {

const Kind& mask_kind();
const Kind& retarget_kind();
const Kind& spatiotemporal_kind();
const Kind& vector_kind();

}  // namespace bn::baking
