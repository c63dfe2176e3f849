// Annealing in recipes.

#pragma once

#include <optional>

#include "bake/recipe_reader.h"
#include "bn/bake.h"

namespace bn {

/// What `method = "anneal"` brings along; nothing for the exact method, whose table has none of its keys.
/// `set` has been read but for its method and outputs.
std::optional<AnnealMethod> parse_anneal(TableReader& table, const RetargetEntry& set);

}  // namespace bn
