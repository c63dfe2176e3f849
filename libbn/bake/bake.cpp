// Runs a plan: entries in the order of what they build on, those of equal rank beside each other unless their
// kind uses all threads by itself; then the contact sheet. After every job the manifest says what is there.

#include <algorithm>
#include <chrono>
#include <mutex>

#include "bake/bake_meter.h"
#include "bake/contact_sheet.h"
#include "bake/folder_lock.h"
#include "bake/inputs.h"
#include "bake/up_to_date.h"
#include "bake/write_entry.h"
#include "bn/bake.h"

namespace bn {

using namespace baking;

namespace {

namespace fs = std::filesystem;

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

    const std::vector<std::size_t> order = baking_order(recipe_);
    for (std::size_t done = 0; done < order.size();) done += do_group(order, done);
    if (!recipe_.contact_sheet.empty()) do_contact_sheet(order.size());

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
      const JobRecord* job = find_job(earlier_, plan_.jobs[i].kind, plan_.jobs[i].name);
      if (job) records_[i] = *job;
    }
  }

  /// Makes the entry at `first` of the order, and beside it those after it that wait for none of them.
  /// Returns how many.
  std::size_t do_group(const std::vector<std::size_t>& order, std::size_t first) {
    const auto entry_at = [&](std::size_t i) { return recipe_.entries[order[i]]; };
    std::size_t end = first + 1;
    const auto may_join = [&](const Entry& entry) {
      if (entry.kind().one_at_a_time) return false;
      for (const auto& source : input_entries(recipe_, entry)) {
        for (std::size_t i = first; i < end; ++i) {
          if (entry_at(i) == source) return false;
        }
      }
      return true;
    };
    if (!entry_at(first)->kind().one_at_a_time) {
      while (end < order.size() && may_join(*entry_at(end))) ++end;
    }
    const std::size_t count = end - first;
    if (count == 1) {
      do_entry(first, *entry_at(first), execution_);
      return 1;
    }
    Execution share = execution_;
    share.threads =
        std::max(1, thread_count(execution_) / static_cast<int>(std::min<std::size_t>(count, 1024)));
    parallel_for(execution_, static_cast<std::int64_t>(count), [&](std::int64_t i) {
      const std::size_t job = first + static_cast<std::size_t>(i);
      do_entry(job, *entry_at(job), share);
    });
    return count;
  }

  void do_entry(std::size_t index, const Entry& planned, const Execution& share) {
    const auto files = output_files(recipe_, planned, options_.out_dir);
    std::shared_ptr<Entry> entry = planned.clone();
    const fs::path checkpoint = files.front().path.string() + ".checkpoint";
    entry->keep_checkpoint_in(checkpoint);
    std::error_code ignored;
    if (options_.force && !entry->checkpoint().empty()) fs::remove(checkpoint, ignored);
    std::vector<Input> inputs;
    for (const fs::path& path : input_paths(recipe_, planned, options_.out_dir))
      inputs.push_back(read_input(path, execution_));
    auto earlier =
        up_to_date(planned.kind().table, planned.name, files, earlier_, execution_,
                   [&](std::size_t i) { return planned.metadata(i, inputs, files[i].path.parent_path()); });
    do_job(index, share, std::move(earlier), [&](const Execution& execution, const OnFile& on_file) {
      return write_entry(*entry, inputs, files, execution, on_file);
    });
  }

  void do_contact_sheet(std::size_t index) {
    const OutputFile file = contact_sheet_file(recipe_, options_.out_dir);
    std::vector<JobRecord> others;
    for (std::size_t i = 0; i < index; ++i) others.push_back(*records_[i]);
    std::optional<JobRecord> earlier;
    if (std::all_of(others.begin(), others.end(), [](auto& job) { return job.skipped; })) {
      earlier = up_to_date(kContactSheetKind, kContactSheetJob, {file}, earlier_, execution_,
                           [](std::size_t) { return contact_sheet_metadata(); });
    }
    do_job(index, execution_, std::move(earlier), [&](const Execution& execution, const OnFile& on_file) {
      const auto start = std::chrono::steady_clock::now();
      JobRecord job{.kind = kContactSheetKind, .name = kContactSheetJob};
      Metadata metadata = contact_sheet_metadata();
      metadata.recipe = file.recipe;
      const Image sheet = draw_contact_sheet(recipe_, options_.out_dir, others, execution);
      write_image(file.path, sheet, metadata);
      job.files.push_back(
          {.path = file.name, .kind = kContactSheetKind, .pixel_hash = pixel_hash(sheet), .tiles = {}});
      on_file(job.files.back());
      job.seconds = seconds_since(start);
      return job;
    });
  }

  /// Makes a job unless its earlier results hold, and records it.
  template <class Run>
  void do_job(std::size_t index, const Execution& share, std::optional<JobRecord> record, Run run) {
    throw_if_stopped(execution_);
    const int number = static_cast<int>(index), count = static_cast<int>(plan_.jobs.size());
    if (!record) {
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
      record = run(inner, [&](const FileRecord& file) {
        const std::lock_guard lock(mutex_);
        if (events_) events_(FileWritten{file});
      });
    }
    const std::lock_guard lock(mutex_);
    records_[index] = std::move(record);
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

}  // namespace

BakeResult bake(const Recipe& recipe, const BakeOptions& options, const Execution& execution,
                const BakeEvents& events) {
  return Baker(recipe, options, execution, events).run();
}

}  // namespace bn
