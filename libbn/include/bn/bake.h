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
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "bn/execution.h"
#include "bn/grid.h"
#include "bn/noise.h"
#include "bn/retarget.h"
#include "bn/retarget_anneal.h"
#include "bn/texture.h"

namespace bn {

// --- recipes -------------------------------------------------------------------------------------

/// Version of the recipe language; a recipe states it as `version = 1`.
inline constexpr int kRecipeVersion = 1;

/// Limits that a recipe from anywhere is held to.
inline constexpr std::size_t kMaxRecipeBytes = std::size_t{1} << 20;
inline constexpr int kMaxRecipeEntries = 1024;  ///< masks, and as many retarget sets
inline constexpr int kMaxOutputs = 64;          ///< of one entry

/// One file of a mask.
struct MaskOutput {
  std::string path;  ///< relative to the output folder, extension decides the format
  SampleType type = SampleType::u8;
  int line = 0;  ///< in the recipe; 0: made by a program
};

/// `[[mask]]`: a blue-noise mask and its files. The only method so far is void-and-cluster.
struct MaskEntry {
  std::string name;
  VoidAndClusterOptions options = {};
  std::vector<MaskOutput> outputs = {};
  int line = 0;
};

/// What a pixel of a retarget tile says: where its seed goes, or where its seed comes from.
enum class MoveForm { scatter, gather };
std::string_view name_of(MoveForm form);
std::string_view name_of(Reach reach);
std::string_view name_of(Metric metric);

/// One file of a retarget set.
struct RetargetOutput {
  enum class Kind {
    tile,   ///< the tile of one motion
    atlas,  ///< all motions, (2 range + 1) tiles a row, tile (m.x + range, m.y + range)
  };
  std::string path;
  Kind kind = Kind::tile;
  MoveForm form = MoveForm::scatter;
  Offset motion = {};  ///< of a tile; (0, 0) is the plain retarget tile
  int line = 0;
};

/// `method = "anneal"` of a retarget entry: what bn/anneal.h anneals, and with which options.
struct AnnealMethod {
  AnnealOptions options = {};  ///< custom, lower_bound and checkpoint are not used
  /// Channels of the image, whose weighted sum is the energy; empty: the entry's one channel, of weight 1.
  std::vector<int> channels = {};
  std::vector<int> weights = {};   ///< one a channel, 1..1000; empty: 1 each
  double residual_sigma_px = 0.0;  ///< AnnealProblem's
  /// The rest is no part of a recipe, as it changes no byte once the budget is known.
  double seconds =
      0.0;  ///< above 0: a budget by the clock in place of options.proposals; make_retarget() only
  /// Where a run keeps its checkpoint, and goes on from if it is there; empty: nowhere. A bake sets it
  /// itself, beside the entry's first output.
  std::filesystem::path checkpoint = {};
  AnnealTrace* trace = nullptr;  ///< of one tile
};

/// `[[retarget]]`: the retarget tiles of one source for every motion within a range.
struct RetargetEntry {
  std::string name;
  /// The source: the name of a mask of this recipe ...
  std::string mask;
  /// ... or an image file, relative to Recipe::folder, and its channel. One of the two is empty.
  std::string image;
  int channel = 0;
  /// For a mask: the sample type whose levels the tiles are optimised for, which is what the
  /// renderer reads; the mask must have an output of it. An image has its own type.
  SampleType levels = SampleType::u8;
  std::optional<Offset> step = {};          ///< none: auto_step() of the source's size
  RetargetOptions options = {};             ///< step and motion are ignored
  std::optional<AnnealMethod> anneal = {};  ///< none: the exact solver, with options.gap
  int motion = 0;                           ///< range 0..8: (2 motion + 1)^2 tiles; 4 gives the 81 variants
  std::vector<RetargetOutput> outputs = {};
  int line = 0;
};

struct Recipe {
  std::string name;              ///< file name for messages
  std::filesystem::path folder;  ///< what `image` paths are relative to
  std::string text;              ///< as read, goes whole into the manifest
  std::vector<MaskEntry> masks;
  std::vector<RetargetEntry> retargets;
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

/// A recipe as TOML with every key written out: parsing it gives the same entries back.
std::string recipe_text(const Recipe& recipe);

// --- plan ----------------------------------------------------------------------------------------

enum class JobKind { mask, retarget, contact_sheet };
std::string_view name_of(JobKind kind);  ///< "mask", "retarget", "contact-sheet"

/// One step of a bake.
struct PlannedJob {
  JobKind kind;
  int entry = 0;                        ///< index into Recipe::masks or Recipe::retargets
  std::string name;                     ///< the entry's name
  std::vector<std::string> files = {};  ///< relative to the output folder, in the order they are written
  double estimated_seconds = 0.0;       ///< on one core; a guide for progress, not a promise
  std::uint64_t memory_bytes = 0;       ///< estimated peak
  bool stands = false;                  ///< results of an earlier bake stand, so the job would be skipped
};

struct BakePlan {
  std::vector<PlannedJob> jobs;    ///< in dependency order: masks, retarget sets, contact sheet
  double estimated_seconds = 0.0;  ///< of the jobs that do not stand, on one core
  std::uint64_t memory_bytes = 0;
};

struct BakeOptions {
  std::filesystem::path out_dir = "out";  ///< made if missing, with its parents
  bool force = false;                     ///< do every job again, whatever stands
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
  JobKind kind = JobKind::mask;
  std::string name;
  bool skipped = false;                           ///< its results stood already
  double seconds = 0.0;                           ///< wall time of making it; of the earlier bake if skipped
  std::optional<Offset> step = {};                ///< of a retarget set, `auto` resolved
  std::optional<std::int64_t> orbit_length = {};  ///< of that step
  std::vector<FileRecord> files = {};
  std::vector<TileRecord> tiles = {};          ///< of a retarget set: every motion, row by row
  std::optional<std::int64_t> proposals = {};  ///< the budget of each tile that was annealed now
  /// Of the plain tile, annealed now: computed afresh from its moves. Equals the energy that the run kept by
  /// adding changes; a job of which a tile's does not fails (verification_failed).
  std::optional<std::int64_t> recomputed_energy = {};
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

/// Makes one mask or one retarget set (entry.image; entry.mask must be empty) through the same path
/// as a bake, without manifest, lock or contact sheet, and never skips. Output paths may lead
/// anywhere, entry.image is relative to the current folder; the recipe inside each file makes that
/// file again when saved beside it. Errors: as bake().
JobRecord make_mask(const MaskEntry& entry, const Execution& execution = {}, const BakeEvents& events = {});
JobRecord make_retarget(const RetargetEntry& entry, const Execution& execution = {},
                        const BakeEvents& events = {});
/// Writes `tile`, which was made elsewhere (an Annealing that was watched), as the one output of `entry`, a
/// tile. That entry.anneal makes this tile again is the caller's word; its permutation and energies are
/// recomputed, its lower bound is bn verify's to check. Errors: as make_retarget(), and verification_failed.
JobRecord write_retarget(const RetargetEntry& entry, const RetargetTile& tile,
                         const Execution& execution = {});

// --- verify --------------------------------------------------------------------------------------

/// One claim of a file and whether it held. The checks: "metadata" (there, and complete), "hash"
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
/// Errors: io (path missing), cancelled, over_limit.
std::vector<VerifyItem> verify_path(const std::filesystem::path& path, const Execution& execution = {});

}  // namespace bn
