#include "ui/bake_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

#include "bn/error.h"
#include "ui/app.h"
#include "ui/recipe_text.h"
#include "ui/texture_file.h"
#include "ui/widgets.h"

namespace bn::ui {
namespace {

std::string seconds_text(double seconds) {
  return seconds < 10.0    ? fmt::format("{:.2f} s", seconds)
         : seconds < 120.0 ? fmt::format("{:.0f} s", seconds)
                           : fmt::format("{:.0f} min", seconds / 60.0);
}

/// An estimate, with no more digits than it deserves.
std::string about_text(double seconds) {
  if (seconds < 0.1) return "< 0.1 s";
  return "~ " + (seconds < 10.0 ? fmt::format("{:.1f} s", seconds) : seconds_text(seconds));
}

std::string energy_text(const std::vector<TileRecord>& tiles) {
  if (tiles.empty()) return "";
  std::int64_t least = tiles[0].energy, most = least;
  bool proven = true;
  for (const TileRecord& tile : tiles) {
    least = std::min(least, tile.energy);
    most = std::max(most, tile.energy);
    proven &= tile.energy == tile.lower_bound;
  }
  return (least == most ? fmt::format("{}", least) : fmt::format("{} … {}", least, most)) +
         (proven ? ", proven" : "");
}

}  // namespace

/// Written by the bake's threads, read by the window.
struct BakeView::Watch {
  std::mutex mutex;
  int running = -1;                               ///< the job in hand
  std::vector<std::optional<JobRecord>> records;  ///< by job
  double done = 0.0;
  std::optional<double> seconds_left;

  void operator()(const JobStarted& event) { running = event.index; }
  void operator()(const BakeProgress& event) {
    done = event.done;
    seconds_left = event.seconds_left;
  }
  void operator()(const FileWritten&) {}
  void operator()(const JobFinished& event) {
    records[static_cast<std::size_t>(event.index)] = event.job;
    running = -1;
  }
};

void BakeView::open(const std::filesystem::path& recipe) {
  recipe_path_ = recipe;
  planned_path_.clear();
  fresh_ = true;
}

void BakeView::parameters(Parameters& p) {
  p("bake.recipe", recipe_path_);
  p("bake.out", out_dir_);
  p("bake.force", force_);
  p("bake.threads", threads_, 0, 1024);
}

BakeOptions BakeView::options() const { return {.out_dir = out_dir_, .force = force_}; }

void BakeView::plan() {
  planned_path_ = recipe_path_;
  planned_out_ = out_dir_;
  watch_.reset();
  planning_.start([path = recipe_path_, options = options()](const Execution& execution) {
    Recipe recipe = read_recipe(path);
    BakePlan plan = plan_bake(recipe, options, execution);
    return Planned{std::move(recipe), std::move(plan)};
  });
}

void BakeView::bake() {
  watch_ = std::make_shared<Watch>();
  watch_->records.resize(planned_->plan.jobs.size());
  baking_.start(
      [watch = watch_, recipe = planned_->recipe, options = options()](const Execution& execution) {
        return bn::bake(recipe, options, execution, [&](const BakeEvent& event) {
          const std::lock_guard lock(watch->mutex);
          std::visit(*watch, event);
        });
      },
      threads_);
}

void BakeView::update(App& app) {
  const bool wanted = planned_path_ != recipe_path_ || planned_out_ != out_dir_;
  if (wanted && !recipe_path_.empty() && !baking_.running() && !ImGui::IsAnyItemActive()) plan();
  try {
    if (auto planned = planning_.poll()) {
      planned_ = std::move(*planned);
      if (std::exchange(fresh_, false)) app.say(fmt::format("Opened {}", recipe_path_.filename().string()));
      read_sheet();
    }
  } catch (...) {
    planned_.reset();
    app.report_in_flight();
  }
  try {
    if (auto result = baking_.poll()) {
      app.say(fmt::format("Baked into {} in {:.2f} s", out_dir_, result->seconds));
      read_sheet();
    }
  } catch (const Error& error) {
    if (error.code() == ErrorCode::cancelled) {
      app.say("Stopped; Bake goes on where it stopped.");
    } else {
      app.report(error);
    }
  } catch (...) {
    app.report_in_flight();
  }
}

/// In the background, where it is there.
void BakeView::read_sheet() {
  reading_.stop();
  const auto path = std::filesystem::path(planned_out_) / planned_->recipe.contact_sheet;
  std::error_code error;
  if (planned_->recipe.contact_sheet.empty() || !std::filesystem::is_regular_file(path, error))
    return sheet_.clear();
  reading_.start([path](const Execution& execution) {
    return std::make_shared<const Picture>(picture_of(read_texture(path, execution), {}));
  });
}

void BakeView::draw_sheet(float height) {
  try {
    if (auto sheet = reading_.poll()) sheet_.set(std::move(*sheet));
  } catch (const Error&) {
    sheet_.clear();  // a file of that name that is no picture; the plan says what will become of it
  }
  if (planned_->recipe.contact_sheet.empty()) return;
  heading("Contact sheet");
  if (sheet_.empty())
    return note(reading_.running() ? "Reading …" : "It stands here once the recipe is baked.");
  sheet_.draw("Contact sheet", sheet_link_, {ImGui::GetContentRegionAvail().x, height});
}

void BakeView::draw(App& app) {
  update(app);
  const float controls = std::min(em(24), ImGui::GetContentRegionAvail().x * 0.42f);
  begin_panel("bake", {recipe_path_.empty() ? 0.0f : controls, 0});
  if (recipe_path_.empty()) {
    begin_centred("what to do", "No recipe yet");
    note("Drop a recipe (.toml) here: it names masks and retarget tiles, which are made into one folder.");
    if (button("Open a recipe …")) app.ask_open();
    end_centred();
    end_panel();
    return;
  }
  draw_controls(app);
  end_panel();
  ImGui::SameLine();
  ImGui::PushStyleColor(ImGuiCol_ChildBg, ImVec4(0, 0, 0, 0));
  ImGui::BeginChild("right", {0, 0});
  ImGui::PopStyleColor();
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const bool wide = room.x > em(48);
  begin_panel("jobs", wide ? ImVec2(room.x * 0.62f, 0) : ImVec2(0, room.y * 0.6f));
  if (planned_) {
    // In a narrow window the picture comes first; in a wide one there is room for it below the jobs.
    if (!wide) draw_sheet(em(10));
    draw_jobs(app);
    if (wide) draw_sheet(std::max(em(16), ImGui::GetContentRegionAvail().y - em(3)));
  }
  if (!planned_) note(planning_.running() ? "Planning …" : "There is no plan.");
  end_panel();
  if (wide) ImGui::SameLine();
  begin_panel("recipe");
  if (planned_) draw_recipe();
  end_panel();
  ImGui::EndChild();
}

void BakeView::draw_controls(App& app) {
  heading("Recipe");
  value("File", recipe_path_.filename().string(), recipe_path_.string());
  const bool baking = baking_.running();
  ImGui::BeginDisabled(baking);
  field("Into folder", out_dir_, "Made if it is missing. What stands there already is kept.");
  slider("Threads", threads_, 0, 64, "0: all cores. Changes no byte.");
  checkbox("Make everything again", force_);
  ImGui::EndDisabled();
  ImGui::Spacing();
  if (main_button("Bake", planned_.has_value() && !baking && !planning_.running())) bake();
  ImGui::SameLine();
  if (button("Stop", baking, "What is finished stays; Bake goes on from there")) baking_.request_stop();
  if (button("Read again", !baking, "After the recipe or the folder has changed")) plan();
  ImGui::SameLine();
  if (button("Open another …", !baking)) app.ask_open();
  if (watch_) {
    const std::lock_guard lock(watch_->mutex);
    const std::string left =
        watch_->seconds_left && baking ? ", " + seconds_text(*watch_->seconds_left) + " left" : "";
    progress_bar("Progress", watch_->done, fmt::format("{:.0f} %{}", 100.0 * watch_->done, left));
  }
  if (!planned_) return;
  const BakePlan& plan = planned_->plan;
  const auto stand =
      std::count_if(plan.jobs.begin(), plan.jobs.end(), [](const auto& job) { return job.up_to_date; });
  heading("Plan");
  value("Jobs", stand > 0 ? fmt::format("{}, of which {} are up to date", plan.jobs.size(), stand)
                          : fmt::format("{}", plan.jobs.size()));
  const bool nothing = stand == static_cast<std::ptrdiff_t>(plan.jobs.size());
  value("Time", nothing ? "nothing to make" : about_text(plan.estimated_seconds),
        "Of what is to be made, on one core");
  value("Memory",
        fmt::format("about {:.0f} MiB", static_cast<double>(plan.memory_bytes) / (1024.0 * 1024.0)));
}

void BakeView::draw_jobs(App& app) {
  heading("Jobs");
  const BakePlan& plan = planned_->plan;
  // Where there is no room for all columns, time and energy stand below the job's name.
  const bool narrow = ImGui::GetWindowWidth() < em(40);  // whether it scrolls or not
  if (!ImGui::BeginTable("jobs", narrow ? 3 : 5, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp))
    return;
  ImGui::TableSetupColumn("State", 0, narrow ? 1.1f : 0.9f);
  ImGui::TableSetupColumn("Job", 0, 1.9f);
  if (!narrow) ImGui::TableSetupColumn("Time", 0, 0.9f);
  if (!narrow) ImGui::TableSetupColumn("Energy", 0, 1.6f);
  ImGui::TableSetupColumn("Files", 0, 2.7f);
  ImGui::TableHeadersRow();
  for (int i = 0; i < static_cast<int>(plan.jobs.size()); ++i) draw_job(app, i, narrow);
  ImGui::EndTable();
}

void BakeView::draw_job(App& app, int index, bool narrow) {
  const PlannedJob& job = planned_->plan.jobs[static_cast<std::size_t>(index)];
  std::optional<JobRecord> record;
  bool running = false;
  if (watch_) {
    const std::lock_guard lock(watch_->mutex);
    record = watch_->records[static_cast<std::size_t>(index)];
    running = watch_->running == index && baking_.running();
  }
  const bool stands = record ? record->skipped : job.up_to_date;
  const char* state = running                      ? "running"
                      : record && !record->skipped ? "baked"
                      : stands                     ? "up to date"
                                                   : "to bake";
  const ImU32 colour = running ? palette().accent : record || stands ? palette().good : palette().dim_text;
  ImGui::PushID(index);
  ImGui::TableNextColumn();
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(state);
  ImGui::PopStyleColor();
  items::record(fmt::format("{} {}", job.kind, job.name), state);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(job.name.c_str());
  note(job.kind);
  if (!narrow) ImGui::TableNextColumn();
  ImGui::TextUnformatted(record && !record->skipped ? seconds_text(record->seconds).c_str()
                                                    : about_text(job.estimated_seconds).c_str());
  if (!narrow) ImGui::TableNextColumn();
  if (record) ImGui::TextWrapped("%s", energy_text(record->tiles).c_str());
  ImGui::TableNextColumn();
  for (const std::string& file : job.files) {
    // What is there can be opened.
    if (record || stands) {
      if (selectable(file.c_str(), false)) app.open(std::filesystem::path(planned_out_) / file);
      tooltip("Open in the Texture view");
    } else {
      note(file);
    }
  }
  if (record) {
    for (const std::string& text : record->notes) note(text);
  }
  ImGui::PopID();
}

void BakeView::draw_recipe() {
  heading("Text");
  show_recipe(planned_->recipe.text);
}

}  // namespace bn::ui
