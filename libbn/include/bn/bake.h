// bn/bake.h - floor 3: from a recipe to files with proofs, and back from files to a verdict.
//
//   recipe (TOML) --parse_recipe--> Recipe --plan_bake--> BakePlan    what would be done, nothing written
//                                   Recipe --bake-------> files, manifest.json, contact sheet
//   files --verify_path--> VerifyItem...                             every figure recomputed
//
// docs/recipes.md lists every key of a recipe; the names are those of noise.h, retarget.h and
// texture.h.

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "bn/execution.h"
#include "bn/kind.h"
#include "bn/kinds.h"
#include "bn/texture.h"
#include "bn/value.h"

namespace bn {

// --- recipes -------------------------------------------------------------------------------------

/// Version of the recipe language; a recipe states it as `version = 1`.
inline constexpr int kRecipeVersion = 1;

/// Limits that a recipe from anywhere is held to.
inline constexpr std::size_t kMaxRecipeBytes = std::size_t{1} << 20;
inline constexpr int kMaxRecipeEntries = 1024;  ///< tables of each kind
inline constexpr int kMaxOutputs = 64;          ///< of one entry

struct Recipe {
  std::string name;              ///< file name for messages
  std::filesystem::path folder;  ///< what `image` paths are relative to
  std::string text;              ///< as read, goes whole into the manifest
  /// In the order of the kinds, and of the text within a kind. Shared, since nobody changes them.
  std::vector<std::shared_ptr<const Entry>> entries;
  std::string contact_sheet = "contact_sheet.png";  ///< empty: none
};

/// Reads TOML. Checks all that can be checked without looking at other files: syntax, unknown keys
/// (with a suggestion), types, ranges, duplicate names and paths, references between entries, paths
/// that leave the output folder.
/// Errors: invalid_input or over_limit; the message has one line for every mistake found, each with
/// name:line, the allowed range and a remedy. Safe for hostile text.
Recipe parse_recipe(std::string_view text, const std::string& name, const std::filesystem::path& folder);

/// parse_recipe() of a file. Errors: also io, and over_limit above kMaxRecipeBytes.
Recipe read_recipe(const std::filesystem::path& path);

/// The number-th of the entries that a table with `count` stands for: its name and paths have the number, its
/// seeds are later ones. Errors: invalid_input (a path without one place for a number, as in mask_%03d.png).
std::shared_ptr<Entry> numbered_entry(const Entry& entry, int number);

/// A recipe as TOML with every key written out: parsing it gives the same entries back.
std::string recipe_text(const Recipe& recipe);

// --- plan ----------------------------------------------------------------------------------------

/// One step of a bake.
struct PlannedJob {
  std::string kind;                     ///< the entry's kind: "mask", "retarget"; or "contact-sheet"
  std::string name;                     ///< the entry's name
  std::vector<std::string> files = {};  ///< relative to the output folder, in the order they are written
  double estimated_seconds = 0.0;       ///< on one core; a guide for progress, not a promise
  std::uint64_t memory_bytes = 0;       ///< estimated peak
  bool up_to_date = false;              ///< results of an earlier bake hold, so the job would be skipped
};

struct BakePlan {
  std::vector<PlannedJob> jobs;    ///< in the order in which they are done: what others build on comes first
  double estimated_seconds = 0.0;  ///< of the jobs that are not up to date, on one core
  std::uint64_t memory_bytes = 0;
};

struct BakeOptions {
  std::filesystem::path out_dir = "out";  ///< made if missing, with its parents
  bool force = false;                     ///< do every job again, also those that are up to date
};

/// What bake() would do, found without writing or computing: also checks everything that needs the
/// file system (source images with their channels and sizes, formats, folders, permissions, memory).
/// Errors: io, invalid_input, over_limit; each with the recipe's line.
BakePlan plan_bake(const Recipe& recipe, const BakeOptions& options, const Execution& execution = {});

// --- bake ----------------------------------------------------------------------------------------

/// What the manifest says of a file.
struct FileRecord {
  std::string path;  ///< relative to the output folder
  std::string kind;  ///< "mask", "retarget-tile", "retarget-atlas", "contact-sheet"
  std::string pixel_hash;
  std::vector<TileRecord> tiles = {};  ///< energies and bounds; empty for masks
};

/// What became of a job.
struct JobRecord {
  std::string kind;  ///< as PlannedJob::kind
  std::string name;
  bool skipped = false;  ///< its results were up to date
  double seconds = 0.0;  ///< wall time of making it; of the earlier bake if skipped
  Facts facts = {};      ///< Made::facts
  std::vector<FileRecord> files = {};
  std::vector<TileRecord> tiles = {};   ///< Made::tiles
  std::vector<std::string> notes = {};  ///< what a user should know: a constant source, no permutation, ...
};

struct BakeResult {
  std::vector<JobRecord> jobs;  ///< in the order of the plan
  std::filesystem::path manifest;
  double seconds = 0.0;
};

// Events of a bake, as they happen. Calls come one at a time but from any thread, and must be quick
// and not throw.
struct JobStarted {
  const PlannedJob& job;
  int index;  ///< 0..count-1
  int count;
};
struct BakeProgress {
  double done;                         ///< share of the whole bake, 0..1, never backwards, ends at 1
  double seconds;                      ///< since the start
  std::optional<double> seconds_left;  ///< none until there is something to extrapolate from
};
struct FileWritten {
  const FileRecord& file;
};
struct JobFinished {  ///< also for a skipped one, which has no JobStarted
  const JobRecord& job;
  int index;
  int count;
};
using BakeEvent = std::variant<JobStarted, BakeProgress, FileWritten, JobFinished>;
using BakeEvents = std::function<void(const BakeEvent&)>;

/// Makes what the recipe names, in options.out_dir: files, contact sheet, manifest.json.
///
/// Plans first: every error that plan_bake() finds comes before any work. A job whose files stand
/// (listed in the manifest, same pixel hash, same recipe, same algorithm version, same source) is
/// skipped. Every file is written whole or not at all, and the manifest after every job, so a stop,
/// a crash or a kill loses at most the job in hand; the next bake goes on and ends with the same
/// bytes as an uninterrupted one. The folder is locked: a second bake into it fails with io.
/// Errors: those of plan_bake(); cancelled, after a stop. Threads: execution.threads; they change no
/// byte. execution.progress is called too, with BakeProgress::done.
BakeResult bake(const Recipe& recipe, const BakeOptions& options, const Execution& execution = {},
                const BakeEvents& events = {});

/// Makes one entry, whose inputs are files, through the same path as a bake, without manifest, lock or
/// contact sheet, and never skips. Output paths may lead anywhere, input files are relative to the current
/// folder; the recipe inside each file makes that file again when saved beside it. Errors: as bake().
JobRecord make_entry(const Entry& entry, const Execution& execution = {}, const BakeEvents& events = {});

/// Makes one entry in memory: every output's picture with the metadata that its file would carry, nothing
/// written. `recipe_folder` is what input files are relative to. Errors: as bake().
struct BakedFile {
  std::string path;
  Image image;
  Metadata metadata;
};
struct BakedEntry {
  JobRecord record;
  std::vector<BakedFile> files;
};
BakedEntry bake_entry(const Entry& entry, const Execution& execution = {});

/// Writes `tile`, which was made elsewhere (an Annealing that was watched), as the one output of `entry`, a
/// tile. That entry.anneal makes this tile again is the caller's word; its permutation and energies are
/// recomputed, its lower bound is bn verify's to check. Errors: as make_entry(), and verification_failed.
JobRecord write_retarget(const RetargetEntry& entry, const RetargetTile& tile,
                         const Execution& execution = {});

// --- verify --------------------------------------------------------------------------------------

/// One claim of a file and whether it held. The checks: "metadata" (there, and complete), "foreign" (never
/// passes: nothing there says that this toolkit wrote it), "hash"
/// (pixels as recorded), "recipe" (parses and agrees with the recorded figures), "pixels" (a mask:
/// made again, equal), "source" (there, with the recorded hash), "bijection", "radius", "energy",
/// "bound", "manifest" (file listed in a manifest is there, with the same hash).
struct VerifyItem {
  std::filesystem::path file;
  std::string check;
  bool pass = false;
  std::string detail;  ///< the figures on a pass; what differs on a failure
};

/// Checks one file, or every file of our formats (.png .exr .tif .tiff .h .bin) in a folder and
/// below and what its manifest.json lists. Recomputes everything: masks are baked and retarget tiles
/// solved again from the source their metadata names, so it takes about as long as the bake.
/// A file that cannot be read, or has no metadata of ours, is a failed item, not an exception.
/// `path` may also be the pattern of a volume. Errors: io (path missing), cancelled, over_limit.
std::vector<VerifyItem> verify_path(const std::filesystem::path& path, const Execution& execution = {});

/// A retarget tile that another program made, and what is known of it.
struct ForeignTile {
  std::filesystem::path tile;  ///< red is x, green is y; 8bit or 16bit
  std::filesystem::path mask;
  std::filesystem::path to = {};  ///< the mask of the next frame; empty: `mask`, moved by the step
  int channel = 0;                ///< of both masks
  Offset step = {};
  Offset motion = {};
  int zero_level = 128;  ///< the sample that means no move: 128 as this toolkit stores moves, or a radius
  MoveForm form = MoveForm::scatter;
  Metric metric = Metric::l1;
  Reach reach = Reach::chebyshev;
  int radius = 0;  ///< what no move may pass; 0: the tile's own farthest move
};

/// Checks such a tile: "bijection" (of the torus), "radius", "energy" (recomputed, with the identity's) and
/// "bound" (the proven optimum of that radius, and how far above it the tile is; it always passes). Errors:
/// those of read_image(); invalid_input (mask and tile of different sizes, a radius that is out of range).
std::vector<VerifyItem> verify_tile(const ForeignTile& tile, const Execution& execution = {});

}  // namespace bn
