// The keys of every kind of texture, as Markdown tables for docs/recipes.md.

#pragma once

#include <string>

namespace bn::tools {

std::string recipe_tables();

}  // namespace bn::tools
