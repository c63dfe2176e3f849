// Which textures there are to report on: files and folders to textures, encodings of one put together.

#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bn/error.h"
#include "bn/report.h"
#include "bn/spectrum.h"
#include "bn/texture.h"

namespace bn::report {

/// A scalar texture: one channel of a picture, or of a stack of them.
struct Texture {
  std::string name;  ///< as the user would name it
  Shape shape;
  ChannelSamples samples;
  SampleType type = SampleType::u8;
  std::optional<Metadata> metadata;
  std::vector<std::string> also;  ///< other encodings of it
  std::optional<double> seconds;  ///< that its job took
  /// What it has in common with earlier channels of its file: "is channel 0 moved by (5, 3)". It should be
  /// nothing.
  std::vector<std::string> relations;
  std::string independence;  ///< a sentence that says so, for channels that are independent; else empty
};

/// The retarget tiles of one mask or stack of masks and one set of options, in scatter form, in the order of
/// their slices and of their motions by row.
struct RetargetSet {
  struct Tile {
    TileRecord record;
    Grid<Offset> move;
    int slice = 0;  ///< of the stack that its seeds start from
  };
  std::string name;
  std::vector<std::string> files;
  Metadata metadata;  ///< of its first file; tiles and recipe are that file's
  std::vector<Tile> tiles;
  int slices = 1;  ///< of the stack that its tiles lead through
  /// Of its mask or stack, if that is at hand with all the tiles need.
  std::optional<Grid<std::int32_t>> levels;
  std::optional<Grid<std::int32_t>> to;  ///< of the next frame's mask, where a file of its own has it
  std::string mask_name;
  std::optional<double> seconds;
};

struct Collection {
  std::vector<Texture> textures;
  std::vector<RetargetSet> retarget_sets;
  std::vector<std::string> notes;
  std::optional<ErrorInfo> first_fault;  ///< of what could not be read
};

Collection collect(const ReportOptions& options, const Execution& execution);

}  // namespace bn::report
