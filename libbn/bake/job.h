// The work of a bake, one function a kind of job. A job knows its files' full paths and the recipe
// that goes into each; where they came from (a bake's folder or a single command) is not its business.

#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bn/bake.h"

namespace bn {

/// A file to be made.
struct JobFile {
  std::filesystem::path path;  ///< where it is written
  std::string name;            ///< what the record calls it
  std::string recipe;          ///< the text stored in it
};

using OnFile = std::function<void(const FileRecord&)>;

/// Makes a mask and writes it as entry.outputs[i] to files[i].
JobRecord run_mask_job(const MaskEntry& entry, const std::vector<JobFile>& files, const Execution& execution,
                       const OnFile& on_file);

/// The image that retarget tiles are made for.
struct Source {
  std::filesystem::path path;
  int channel = 0;  ///< the first one
  std::string hash;
  bool is_mask = false;        ///< its metadata says that this toolkit made it as a mask
  std::vector<Levels> levels;  ///< of each channel; the exact solver reads the first
};
Source read_source(const std::filesystem::path& path, const std::vector<int>& channels,
                   const Execution& execution);
/// The channels that an entry's energy is of.
std::vector<int> channels_of(const RetargetEntry& entry);

/// The entry's dither step, `auto` resolved.
Offset step_of(const RetargetEntry& entry, const Source& source);

/// What a user should know of this source under these options: a constant image, no permutation ...
std::vector<std::string> source_notes(const Source& source, const RetargetOptions& options);

/// Solves a retarget set and writes it as entry.outputs[i] to files[i].
JobRecord run_retarget_job(const RetargetEntry& entry, const Source& source,
                           const std::vector<JobFile>& files, const Execution& execution,
                           const OnFile& on_file);

/// Writes a tile that was made elsewhere as entry.outputs[0], after checking its permutation and energies.
JobRecord write_made_tile(const RetargetEntry& entry, const Source& source, const JobFile& file,
                          const RetargetTile& tile);

/// The part of a file's metadata that follows from the recipe and the source alone, without the
/// energies. A file whose metadata differs in it is not the file the recipe asks for.
Metadata mask_metadata(const MaskEntry& entry, const JobFile& file);
Metadata retarget_metadata(const RetargetEntry& entry, const RetargetOutput& output, const Source& source,
                           const JobFile& file);

/// The largest motion range of a tile whose variants all differ on its torus.
inline int largest_motion(Extent size) { return (std::min(size.width, size.height) - 1) / 2; }

/// Number of the motion (x, y) among those of range `range`, row by row.
inline std::size_t motion_index(Offset motion, int range) {
  return static_cast<std::size_t>((motion.y + range) * (2 * range + 1) + motion.x + range);
}

}  // namespace bn
