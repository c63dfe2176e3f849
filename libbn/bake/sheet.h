// The drawing of a contact sheet, from what stands in files; which files those are is contact_sheet.cpp's
// business.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bn/execution.h"
#include "bn/retarget.h"
#include "bn/texture.h"

namespace bn::baking {

/// A retarget set.
struct SheetSet {
  std::string name;
  std::string about;          ///< one line under the name
  Grid<std::int32_t> levels;  ///< of the mask D
  Grid<std::int32_t> to;      ///< of the next frame's mask T; D itself for a mask that moves
  std::string source;         ///< what D is made of
  Offset step;
  int radius = 1;
  int motion = 0;  ///< motions -motion..motion
  std::vector<TileRecord> tiles;
  TileRecord plain;                   ///< of no motion
  std::optional<Grid<Offset>> tile;   ///< of no motion, scatter
  std::optional<Grid<Offset>> atlas;  ///< all motions as stored
};

/// A mask that no set uses.
struct SheetMask {
  std::string name;
  std::string size;   ///< "64 x 64"
  std::string about;  ///< "sigma 1.9, seed 1"
  Grid<std::int32_t> levels;
  int distinct = 0;
};

/// A spatiotemporal mask.
struct SheetStack {
  std::string name;
  std::string about;          ///< one line under the name
  Grid<std::int32_t> levels;  ///< a volume
  int distinct = 0;
};

/// `left_out`: how many more there are. Errors: cancelled.
Image draw_sheet(const std::vector<SheetSet>& sets, const std::vector<SheetStack>& stacks,
                 const std::vector<SheetMask>& masks, int left_out, const Execution& execution);

}  // namespace bn::baking
