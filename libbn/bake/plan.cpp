// What a bake would do. Everything that can fail without computing fails here.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "bake/contact_sheet.h"
#include "bake/layout.h"
#include "bake/mistakes.h"
#include "bake/standing.h"
#include "bn/bake.h"
#include "bn/error.h"

namespace bn {
namespace {

namespace fs = std::filesystem;

// Measured on one core of a Zen 5 machine; they only pace the progress bar.
constexpr double kMaskSecondsPerPixel = 0.3e-6;
constexpr double kRetargetSecondsPerPixel = 1.5e-6;  // up to 128 x 128, then growing with the side
constexpr double kContactSheetSeconds = 0.3;
constexpr std::uint64_t kMaskBytesPerPixel = 12 + 8;     // the solver; encoding and writing
constexpr std::uint64_t kSolverBytesPerPixel = 64;       // of a tile in work
constexpr std::uint64_t kTileBytesPerPixel = 8 + 3 + 3;  // of a finished tile: moves, image, atlas

/// Of one tile.
double annealing_seconds(const AnnealMethod& method) {
  constexpr double kSecondsPerProposal = 6e-10, kSecondsPerFilteredOne = 1e-7;
  return static_cast<double>(method.options.proposals) * method.options.chains.count *
         (method.residual_sigma_px > 0.0 ? kSecondsPerFilteredOne : kSecondsPerProposal);
}

/// The nearest folder of `path` that exists.
fs::path existing_folder(fs::path path) {
  path = fs::absolute(path).lexically_normal();
  std::error_code failed;
  while (!fs::exists(path, failed) && path.has_relative_path()) path = path.parent_path();
  return path;
}

class Planner {
 public:
  Planner(const Recipe& recipe, const BakeOptions& options, const Execution& execution)
      : recipe_(recipe), options_(options), execution_(execution), mistakes_(recipe.name) {}

  BakePlan plan() {
    thread_count(execution_);
    check_out_dir();
    if (!options_.force) earlier_ = earlier_manifest(options_.out_dir);
    for (std::size_t i = 0; i < recipe_.masks.size(); ++i) plan_mask(static_cast<int>(i));
    for (std::size_t i = 0; i < recipe_.retargets.size(); ++i) plan_retarget(static_cast<int>(i));
    if (!recipe_.contact_sheet.empty()) plan_contact_sheet();
    for (const RetargetEntry& entry : recipe_.retargets) check_source_survives(entry);
    mistakes_.throw_if_any();
    for (const PlannedJob& job : plan_.jobs) {
      if (!job.stands) plan_.estimated_seconds += job.estimated_seconds;
      plan_.memory_bytes = std::max(plan_.memory_bytes, job.memory_bytes);
    }
    return std::move(plan_);
  }

 private:
  void check_out_dir() {
    const fs::path folder = existing_folder(options_.out_dir);
    if (!fs::is_directory(folder)) {
      throw Error({.code = ErrorCode::io,
                   .what = "is a file, no folder",
                   .where = folder.string(),
                   .limit = "",
                   .remedy = "name another output folder with --out"});
    }
    if (::access(folder.c_str(), W_OK | X_OK) != 0) {
      throw Error({.code = ErrorCode::io,
                   .what = "no permission to write into this folder",
                   .where = folder.string(),
                   .limit = "",
                   .remedy = "change its permissions or name another output folder with --out"});
    }
  }

  /// Notes as a mistake in `line` what `check` throws as invalid input.
  template <class Check>
  bool passes(int line, const std::string& what, Check check) {
    try {
      check();
      return true;
    } catch (const Error& error) {
      if (error.code() != ErrorCode::invalid_input) throw;
      const ErrorInfo& info = error.info();
      mistakes_.add(line, fmt::format("{}: {}", what, info.what), info.limit, info.remedy);
      return false;
    }
  }

  void check_file(int line, const std::string& what, const std::string& path, SampleType type, int channels) {
    // The folders of a new bake do not exist yet; the nearest one that does answers for them.
    const fs::path file = options_.out_dir / path;
    const fs::path probe = existing_folder(file.parent_path()) / file.filename();
    passes(line, fmt::format("{}: output '{}'", what, path), [&] { check_writable(probe, type, channels); });
  }

  void plan_mask(int index) {
    const MaskEntry& entry = recipe_.masks[static_cast<std::size_t>(index)];
    const auto pixels = static_cast<double>(entry.options.size.area());
    PlannedJob job{.kind = JobKind::mask,
                   .entry = index,
                   .name = entry.name,
                   .files = {},
                   .estimated_seconds = pixels * kMaskSecondsPerPixel,
                   .memory_bytes = static_cast<std::uint64_t>(entry.options.size.area()) * kMaskBytesPerPixel,
                   .stands = false};
    for (const MaskOutput& output : entry.outputs) {
      job.files.push_back(output.path);
      check_file(output.line, fmt::format("mask '{}'", entry.name), output.path, output.type, 1);
    }
    check_memory(execution_, job.memory_bytes,
                 fmt::format("{}:{}: mask '{}'", recipe_.name, entry.line, entry.name));
    job.stands = standing_mask(entry, mask_files(entry, options_.out_dir), earlier_, execution_).has_value();
    plan_.jobs.push_back(std::move(job));
  }

  void plan_retarget(int index) {
    const RetargetEntry& entry = recipe_.retargets[static_cast<std::size_t>(index)];
    const std::string what = fmt::format("retarget '{}'", entry.name);
    PlannedJob job{.kind = JobKind::retarget, .entry = index, .name = entry.name, .files = {}};
    for (const RetargetOutput& output : entry.outputs) {
      job.files.push_back(output.path);
      check_file(output.line, what, output.path, SampleType::u8, 3);
    }
    Extent size;
    std::optional<Source> source;
    const fs::path path = source_path(recipe_, entry, options_.out_dir);
    if (const MaskEntry* mask = mask_of(recipe_, entry)) {
      size = mask->options.size;
      const auto made_by = static_cast<std::size_t>(mask - recipe_.masks.data());
      if (plan_.jobs[made_by].stands) source = read_source(path, {0}, execution_);
    } else {
      if (!passes(entry.line, fmt::format("{}: image '{}'", what, entry.image),
                  [&] { source = read_source(path, channels_of(entry), execution_); }))
        return;
      size = source->levels[0].value.size();
      if (entry.motion > largest_motion(size)) {
        mistakes_.add(entry.line,
                      fmt::format("{}: motion {} is larger than the tile of {}x{}", what, entry.motion,
                                  size.width, size.height),
                      fmt::format("0..{}", largest_motion(size)));
      }
    }
    const int side = 2 * entry.motion + 1, tiles = side * side;
    const auto pixels = static_cast<double>(size.area());
    job.estimated_seconds =
        tiles * pixels * kRetargetSecondsPerPixel * std::max(1.0, std::sqrt(pixels) / 128.0);
    if (entry.anneal) job.estimated_seconds += tiles * annealing_seconds(*entry.anneal);
    const std::uint64_t at_once = static_cast<std::uint64_t>(std::min(thread_count(execution_), tiles));
    job.memory_bytes =
        static_cast<std::uint64_t>(size.area()) *
        (at_once * kSolverBytesPerPixel + static_cast<std::uint64_t>(tiles) * kTileBytesPerPixel);
    check_memory(execution_, job.memory_bytes, fmt::format("{}:{}: {}", recipe_.name, entry.line, what));
    if (source) {
      const auto files = retarget_files(recipe_, entry, options_.out_dir);
      job.stands = standing_retarget(entry, *source, files, earlier_, execution_).has_value();
    }
    plan_.jobs.push_back(std::move(job));
  }

  void check_source_survives(const RetargetEntry& entry) {
    if (entry.image.empty()) return;
    for (const PlannedJob& job : plan_.jobs) {
      for (const std::string& file : job.files) {
        if (!is_same_file(options_.out_dir / file, recipe_.folder / entry.image)) continue;
        mistakes_.add(entry.line,
                      fmt::format("retarget '{}': image '{}' would be replaced by the output '{}' of '{}'",
                                  entry.name, entry.image, file, job.name),
                      "", "give the output another path, or bake into another folder");
      }
    }
  }

  void plan_contact_sheet() {
    check_file(0, "contact_sheet", recipe_.contact_sheet, SampleType::u8, 3);
    const bool others_stand =
        std::all_of(plan_.jobs.begin(), plan_.jobs.end(), [](auto& job) { return job.stands; });
    const JobFile file = contact_sheet_file(recipe_, options_.out_dir);
    plan_.jobs.push_back(
        {.kind = JobKind::contact_sheet,
         .entry = 0,
         .name = kContactSheetJob,
         .files = {file.name},
         .estimated_seconds = kContactSheetSeconds,
         .memory_bytes = std::uint64_t{64} << 20,
         .stands = others_stand && standing_contact_sheet(file, earlier_, execution_).has_value()});
  }

  const Recipe& recipe_;
  const BakeOptions& options_;
  const Execution& execution_;
  Mistakes mistakes_;
  Manifest earlier_;
  BakePlan plan_;
};

}  // namespace

BakePlan plan_bake(const Recipe& recipe, const BakeOptions& options, const Execution& execution) {
  return Planner(recipe, options, execution).plan();
}

}  // namespace bn
