// Runs a plan: masks beside each other, then the retarget sets one after the other (each set solves
// its motions in parallel), then the contact sheet. After every job the manifest says what stands.

#include "bn/bake.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <numeric>

#include "bake/anneal_job.h"
#include "bake/contact_sheet.h"
#include "bake/folder_lock.h"
#include "bake/layout.h"
#include "bake/manifest.h"
#include "bake/standing.h"
#include "bn/error.h"

namespace bn {
namespace {

namespace fs = std::filesystem;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Share done and time left of a whole bake, from the shares of its jobs.
class BakeMeter {
 public:
  BakeMeter(const BakePlan& plan, const Execution& execution, const BakeEvents& events)
      : report_(execution.progress), events_(events), done_(plan.jobs.size(), 0.0) {
    for (const PlannedJob& job : plan.jobs) weights_.push_back(job.stands ? 0.0 : job.estimated_seconds);
    total_ = std::max(std::accumulate(weights_.begin(), weights_.end(), 0.0), 1e-9);
  }

  /// To be called by one thread at a time.
  void update(std::size_t job, double share) {
    done_[job] = std::max(done_[job], share);
    double sum = 0.0;
    for (std::size_t i = 0; i < done_.size(); ++i) sum += done_[i] * weights_[i];
    report(std::min(sum / total_, 1.0));
  }

  void finish() { report(1.0); }
  double seconds() const { return seconds_since(start_); }

 private:
  void report(double done) {
    constexpr double kNotch = 1.0 / 500.0;
    if (done < reported_ + kNotch && !(done >= 1.0 && reported_ < 1.0)) return;
    reported_ = done;
    BakeProgress progress{.done = done, .seconds = seconds(), .seconds_left = std::nullopt};
    // A first guess from less than this would jump about.
    if (done >= 0.01 && progress.seconds >= 0.2)
      progress.seconds_left = progress.seconds * (1.0 - done) / done;
    if (events_) events_(progress);
    if (report_) report_(done);
  }

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::function<void(double)> report_;
  const BakeEvents& events_;
  std::vector<double> done_, weights_;
  double total_ = 0.0;
  double reported_ = 0.0;
};

class Baker {
 public:
  Baker(const Recipe& recipe, const BakeOptions& options, const Execution& execution,
        const BakeEvents& events)
      : recipe_(recipe),
        options_(options),
        execution_(execution),
        events_(events),
        plan_(plan_bake(recipe, options, execution)),
        meter_(plan_, execution, events),
        records_(plan_.jobs.size()) {}

  BakeResult run() {
    make_folder(options_.out_dir);
    const FolderLock lock(options_.out_dir);
    for (const PlannedJob& job : plan_.jobs) {
      for (const std::string& file : job.files) make_folder((options_.out_dir / file).parent_path());
    }
    if (!options_.force) remember_earlier_bake();

    const std::size_t masks = recipe_.masks.size(), sets = recipe_.retargets.size();
    const int threads = thread_count(execution_);
    Execution share = execution_;
    share.threads = std::max(1, threads / std::max(1, static_cast<int>(std::min<std::size_t>(masks, 1024))));
    parallel_for(execution_, static_cast<std::int64_t>(masks),
                 [&](std::int64_t i) { do_mask(static_cast<std::size_t>(i), share); });
    for (std::size_t i = 0; i < sets; ++i) do_retarget(masks + i);
    if (!recipe_.contact_sheet.empty()) do_contact_sheet(masks + sets);

    complete_ = true;
    save_manifest();
    meter_.finish();
    BakeResult result{.jobs = {}, .manifest = options_.out_dir / kManifestName, .seconds = meter_.seconds()};
    for (const auto& record : records_) result.jobs.push_back(*record);
    return result;
  }

 private:
  /// Until a job's turn comes, what the earlier manifest says of it stays in the new one; without
  /// that a stopped bake would forget results that it has not come to yet.
  void remember_earlier_bake() {
    earlier_ = earlier_manifest(options_.out_dir);
    for (std::size_t i = 0; i < plan_.jobs.size(); ++i) {
      for (const JobRecord& job : earlier_.jobs) {
        if (job.kind == plan_.jobs[i].kind && job.name == plan_.jobs[i].name) records_[i] = job;
      }
    }
  }

  void do_mask(std::size_t index, const Execution& share) {
    const MaskEntry& entry = recipe_.masks[index];
    const auto files = mask_files(entry, options_.out_dir);
    do_job(index, share, standing_mask(entry, files, earlier_, execution_),
           [&](const Execution& execution, const OnFile& on_file) {
             return run_mask_job(entry, files, execution, on_file);
           });
  }

  void do_retarget(std::size_t index) {
    RetargetEntry entry = recipe_.retargets[index - recipe_.masks.size()];
    const auto files = retarget_files(recipe_, entry, options_.out_dir);
    if (entry.anneal) {
      entry.anneal->checkpoint = files.front().path.string() + ".checkpoint";
      std::error_code ignored;
      if (options_.force) fs::remove(entry.anneal->checkpoint, ignored);
    }
    const Source source =
        read_source(source_path(recipe_, entry, options_.out_dir), channels_of(entry), execution_);
    do_job(index, execution_, standing_retarget(entry, source, files, earlier_, execution_),
           [&](const Execution& execution, const OnFile& on_file) {
             return run_retarget_job(entry, source, files, execution, on_file);
           });
  }

  void do_contact_sheet(std::size_t index) {
    const JobFile file = contact_sheet_file(recipe_, options_.out_dir);
    std::vector<JobRecord> others;
    for (std::size_t i = 0; i < index; ++i) others.push_back(*records_[i]);
    const bool all_stand = std::all_of(others.begin(), others.end(), [](auto& job) { return job.skipped; });
    do_job(index, execution_, all_stand ? standing_contact_sheet(file, earlier_, execution_) : std::nullopt,
           [&](const Execution& execution, const OnFile& on_file) {
             const auto start = std::chrono::steady_clock::now();
             JobRecord job{.kind = JobKind::contact_sheet, .name = kContactSheetJob};
             const Image sheet = draw_contact_sheet(recipe_, options_.out_dir, others, execution);
             write_image(file.path, sheet, contact_sheet_metadata(file));
             job.files.push_back(
                 {.path = file.name, .kind = "contact-sheet", .pixel_hash = pixel_hash(sheet), .tiles = {}});
             on_file(job.files.back());
             job.seconds = seconds_since(start);
             return job;
           });
  }

  /// Makes a job unless it stands, and records it.
  template <class Run>
  void do_job(std::size_t index, const Execution& share, std::optional<JobRecord> standing, Run run) {
    throw_if_stopped(execution_);
    const int number = static_cast<int>(index), count = static_cast<int>(plan_.jobs.size());
    if (!standing) {
      {
        const std::lock_guard lock(mutex_);
        // From here on its old files are being replaced, and no sheet shows the new ones yet.
        records_[index].reset();
        if (!recipe_.contact_sheet.empty()) records_.back().reset();
        if (events_) events_(JobStarted{plan_.jobs[index], number, count});
      }
      Execution inner = share;
      inner.progress = [&](double done) {
        const std::lock_guard lock(mutex_);
        meter_.update(index, done);
      };
      standing = run(inner, [&](const FileRecord& file) {
        const std::lock_guard lock(mutex_);
        if (events_) events_(FileWritten{file});
      });
    }
    const std::lock_guard lock(mutex_);
    records_[index] = std::move(standing);
    if (!records_[index]->skipped) save_manifest();
    meter_.update(index, 1.0);
    if (events_) events_(JobFinished{*records_[index], number, count});
  }

  void save_manifest() const {
    Manifest manifest{.recipe = whole_text(recipe_), .complete = complete_, .jobs = {}};
    for (const auto& record : records_) {
      if (record) manifest.jobs.push_back(*record);
    }
    write_text_file(options_.out_dir / kManifestName, manifest_text(manifest));
  }

  const Recipe& recipe_;
  const BakeOptions& options_;
  const Execution& execution_;
  const BakeEvents& events_;
  BakePlan plan_;
  BakeMeter meter_;
  Manifest earlier_;
  std::mutex mutex_;  ///< over everything below, the meter and the events
  std::vector<std::optional<JobRecord>> records_;
  bool complete_ = false;
};

OnFile written(const BakeEvents& events) {
  return [&events](const FileRecord& file) {
    if (events) events(FileWritten{file});
  };
}

/// The recipe that a file will carry must be one: this holds the options to the ranges of a recipe,
/// and paths to text that TOML can hold, before any work.
void check_recipes(const std::vector<JobFile>& files) {
  for (const JobFile& file : files) {
    try {
      parse_recipe(file.recipe, file.name, "");
    } catch (const Error& error) {
      ErrorInfo info = error.info();
      info.where = file.name;  // the line is one of a text that nobody has seen
      throw Error(info);
    }
  }
}

/// Passes the progress of a single job on as that of a bake.
Execution metered(const Execution& execution, BakeMeter& meter) {
  Execution inner = execution;
  inner.progress = [&meter](double done) { meter.update(0, done); };
  return inner;
}

}  // namespace

BakeResult bake(const Recipe& recipe, const BakeOptions& options, const Execution& execution,
                const BakeEvents& events) {
  return Baker(recipe, options, execution, events).run();
}

JobRecord make_mask(const MaskEntry& entry, const Execution& execution, const BakeEvents& events) {
  const std::vector<JobFile> files = free_mask_files(entry);
  check_recipes(files);
  for (const MaskOutput& output : entry.outputs) check_writable(output.path, output.type, 1);
  BakePlan plan;
  plan.jobs = {{.kind = JobKind::mask, .name = entry.name, .files = {}, .estimated_seconds = 1.0}};
  BakeMeter meter(plan, execution, events);
  JobRecord job = run_mask_job(entry, files, metered(execution, meter), written(events));
  meter.finish();
  return job;
}

namespace {

/// What can be checked of an entry's outputs before the work starts.
std::vector<JobFile> checked_retarget_files(const RetargetEntry& entry) {
  const std::vector<JobFile> files = free_retarget_files(entry);
  check_recipes(files);
  for (const RetargetOutput& output : entry.outputs) {
    check_writable(output.path, SampleType::u8, 3);
    if (!is_same_file(output.path, entry.image)) continue;
    throw Error({.code = ErrorCode::invalid_input,
                 .what = "would replace the image that it is made for",
                 .where = output.path,
                 .limit = "",
                 .remedy = "write to another file"});
  }
  return files;
}

}  // namespace

JobRecord make_retarget(const RetargetEntry& given, const Execution& execution, const BakeEvents& events) {
  std::vector<JobFile> files = checked_retarget_files(given);
  const Source source = read_source(given.image, channels_of(given), execution);
  RetargetEntry entry = given;
  if (given.anneal && given.anneal->seconds > 0.0) {
    entry = with_budget_found(given, source, execution);
    files = free_retarget_files(entry);
  }
  BakePlan plan;
  plan.jobs = {{.kind = JobKind::retarget, .name = entry.name, .files = {}, .estimated_seconds = 1.0}};
  BakeMeter meter(plan, execution, events);
  JobRecord job = run_retarget_job(entry, source, files, metered(execution, meter), written(events));
  meter.finish();
  return job;
}

JobRecord write_retarget(const RetargetEntry& entry, const RetargetTile& tile, const Execution& execution) {
  if (entry.outputs.size() != 1 || entry.outputs[0].kind != RetargetOutput::Kind::tile) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = "an entry of several outputs, or an atlas",
                 .where = "outputs",
                 .limit = "one tile",
                 .remedy = ""});
  }
  const std::vector<JobFile> files = checked_retarget_files(entry);
  return write_made_tile(entry, read_source(entry.image, channels_of(entry), execution), files[0], tile);
}

}  // namespace bn
