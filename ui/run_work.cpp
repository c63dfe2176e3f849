// What the Run view does beside drawing: loading, previewing, starting and saving, off the window's thread
// where it takes time.

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bn/error.h"
#include "ui/app.h"
#include "ui/run_view.h"

namespace bn::ui {
bool same(const RetargetOptions& a, const RetargetOptions& b) {
  return a.step == b.step && a.motion == b.motion && a.radius == b.radius && a.reach == b.reach &&
         a.metric == b.metric && a.wrap == b.wrap;
}

void RunView::load_source(App& app) {
  const SourceChoice choice = settings_.source();
  if (!ImGui::IsAnyItemActive() &&
      !(choice == loaded_choice_ && (source_ || load_failed_ || loading_.running()))) {
    loaded_choice_ = choice;
    source_.reset();
    load_failed_ = false;
    loading_.start([choice](const Execution& execution) { return bn::ui::load_source(choice, execution); });
  }
  try {
    if (auto source = loading_.poll()) source_ = std::make_shared<const Source>(std::move(*source));
  } catch (...) {
    load_failed_ = true;
    start_wanted_ = false;
    // Nothing chosen yet is no error until someone wants to start.
    if (!choice.file.empty() || choice.baked) app.report_in_flight();
  }
}

void RunView::make_plan(App& app) {
  if (source_ && !ImGui::IsAnyItemActive()) {
    if (std::string now = settings_.all_text(); now != planned_) {
      planned_ = std::move(now);
      planning_.start(
          [source = source_, settings = settings_](const Execution& execution) {
            return plan_of(settings.problem(*source), settings.options(), execution);
          },
          1);
    }
  }
  try {
    if (auto plan = planning_.poll()) {
      plan_ = std::move(plan);
      refusal_.reset();
    }
  } catch (const Error& error) {
    plan_.reset();
    if (error.code() != ErrorCode::cancelled) refusal_ = error.info();
  } catch (...) {
    plan_.reset();
    app.report_in_flight();
  }
}

void RunView::begin_run(App& app) {
  try {
    check_source(*source_);
    if (refusal_ && !planning_.running()) throw Error(*refusal_);
    auto entry = std::make_shared<RunEntry>();
    entry->number = runs_ + 1;
    entry->source = source_;
    entry->settings = settings_;
    entry->settings_text = settings_.all_text();
    RunSetup setup{settings_.problem(*source_), settings_.options(), settings_.threads};
    if (Optimum::exists_for(setup.problem)) {
      const bool known = entry_ && entry_->optimum && entry_->source == source_ &&
                         same(entry_->run->setup().problem.retarget, setup.problem.retarget);
      entry->optimum = known ? entry_->optimum : std::make_shared<Optimum>(setup.problem);
    }
    if (entry_) entry_->run->stop();
    entry->run = std::make_shared<Run>(std::move(setup), start_paused_);
    ++runs_;
    entry_ = std::move(entry);
    told_ = Phase::preparing;
    app.compare.add(entry_);
  } catch (...) {
    app.report_in_flight();
  }
}

void RunView::begin_when_ready(App& app) {
  if (!start_wanted_) return;
  if (source_ && settings_.source() == loaded_choice_) {
    start_wanted_ = false;
    begin_run(app);
  } else if (load_failed_) {
    start_wanted_ = false;
  }
}

void RunView::update(App& app) {
  load_source(app);
  make_plan(app);
  begin_when_ready(app);
  try {
    if (auto saved = saving_.poll())
      app.say(fmt::format("Saved {}: {}", saved->file.string(), saved->detail));
  } catch (...) {
    app.report_in_flight();
  }
  if (!entry_) return;
  if (entry_->optimum) entry_->optimum->poll();
  const Standing standing = entry_->run->standing();
  if (standing.phase == std::exchange(told_, standing.phase)) return;
  if (standing.error) app.report(Error(*standing.error));
  if (standing.phase == Phase::finished) {
    app.say(fmt::format("{} has finished: energy {}", entry_->name(), entry_->run->result()->tile.energy));
  }
}

bool RunView::can_save() const {
  if (!entry_ || saving_.running()) return false;
  const auto result = entry_->run->result();
  return result && result->proposals > 0;
}

void RunView::save(App& app, const std::filesystem::path& file) {
  const auto result = entry_->run->result();
  if (!result) return;  // it goes on, since the user was asked for a name
  try {
    RetargetEntry entry = entry_->settings.entry(*result, file);
    RetargetTile tile = result->tile;
    const RetargetTile* optimum = entry_->optimum ? entry_->optimum->tile() : nullptr;
    const bool residual = entry.anneal.residual_sigma_px > 0.0;
    // Nothing but 0 is proven of a residual; what is not proven yet is -1.
    tile.lower_bound = residual ? 0 : optimum != nullptr ? optimum->lower_bound : -1;
    saving_.start([entry, tile, source = entry_->source, file](const Execution& execution) mutable {
      if (source->choice.baked) {
        // A tile names its source; a mask that was baked on the spot becomes a file beside it.
        MaskEntry mask;
        mask.name = file.stem().string() + "-mask";
        mask.void_and_cluster = source->choice.mask;
        mask.outputs = {{.path = (file.parent_path() / (mask.name + ".png")).string()}};
        make_entry(mask, execution);
        entry.image = mask.outputs[0].path;
      } else {
        entry.image = source->choice.file.string();
      }
      if (tile.lower_bound < 0) {
        RetargetOptions bound = entry.problem;
        bound.step = entry.step ? *entry.step : auto_step(source->levels.value.size()).step;
        bound.motion = entry.outputs[0].motion;
        bound.gap = 0.01;
        tile.lower_bound = solve_retarget(source->levels.value, bound, execution).lower_bound;
      }
      write_retarget(entry, tile, execution);
      std::string detail = fmt::format("energy {}, at least {}", tile.energy, tile.lower_bound);
      if (const std::int64_t made = entry.anneal.options.stop_after; made > 0) {
        detail += fmt::format("; stopped after {} of {} proposals", short_number(static_cast<double>(made)),
                              short_number(static_cast<double>(entry.anneal.options.proposals)));
      }
      return Saved{file, detail};
    });
  } catch (...) {
    app.report_in_flight();
  }
}

void RunView::ask_save(App& app) {
  app.ask("Save the texture", FileChooser::Want::save, save_path_,
          [this, &app](const std::filesystem::path& path) {
            save_path_ = path.string();
            save(app, path);
          });
}

}  // namespace bn::ui
