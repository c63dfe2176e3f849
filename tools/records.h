// The library's records as JSON, in the words of flags and recipes. docs/bn.md documents them.

#pragma once

#include <nlohmann/json.hpp>

#include "bn/bake.h"

namespace bn::tools {

using Json = nlohmann::ordered_json;

Json to_json(Offset offset);  ///< [x, y]
Json to_json(Extent size);    ///< [width, height]
/// {key: value, ...}, in their order
Json to_json(const Facts& facts);
/// {motion, start_energy, energy, lower_bound, optimal}
Json to_json(const TileRecord& tile);
Json to_json(const FileRecord& file);
Json to_json(const JobRecord& job);
Json to_json(const PlannedJob& job);
Json to_json(const VerifyItem& item);

/// "3638, proven optimal", or "3562..3696 over 81 motions, at most 0.5 % above the optimum".
std::string energy_text(const std::vector<TileRecord>& tiles);

/// Seconds rounded to what a reader can use.
double rounded_seconds(double seconds);

}  // namespace bn::tools
