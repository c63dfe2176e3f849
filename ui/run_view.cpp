#include "ui/run_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "ui/app.h"
#include "ui/flow.h"
#include "ui/keys.h"
#include "ui/parameters.h"
#include "ui/widgets.h"

namespace bn::ui {
namespace {

constexpr const char* phase_name(Phase phase) {
  switch (phase) {
    case Phase::preparing:
      return "preparing";
    case Phase::running:
      return "running";
    case Phase::paused:
      return "paused";
    case Phase::finished:
      return "finished";
    case Phase::stopped:
      return "stopped";
    case Phase::failed:
      return "failed";
  }
  return "";
}

std::string time_text(double seconds) {
  if (seconds < 100.0) return fmt::format("{:.2f} s", seconds);
  if (seconds < 6000.0)
    return fmt::format("{:.0f} min {:02.0f} s", std::floor(seconds / 60.0), std::fmod(seconds, 60.0));
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

std::string percent_text(const std::optional<double>& percent) {
  if (!percent) return "–";
  return *percent < 1000.0 ? fmt::format("{:.1f} %", *percent) : fmt::format("{:.0f} %", *percent);
}

/// A figure under its name.
void figure_cell(const char* name, const std::string& text) {
  ImGui::BeginGroup();
  note(name);
  ImGui::TextUnformatted(text.c_str());
  ImGui::EndGroup();
  items::record(name, text);
}

}  // namespace

void RunView::parameters(Parameters& p) {
  settings_.parameters(p);
  pictures_.parameters(p);
  p("run.layout", layout_, 0, 2);
  p("run.save", save_path_);
}

bool RunView::busy() const {
  if (loading_.running() || planning_.running() || saving_.running() || start_wanted_ || pictures_.busy())
    return true;
  if (!entry_) return false;
  const Phase phase = entry_->run->standing().phase;
  return phase == Phase::preparing || phase == Phase::running || phase != told_ ||
         (entry_->optimum && entry_->optimum->solving());
}

void RunView::open(const std::filesystem::path& image) {
  settings_.bakes_mask = false;
  settings_.file = image;
}

void RunView::draw(App& app) {
  update(app);
  const float settings_width = std::min(em(24), ImGui::GetContentRegionAvail().x * 0.42f);
  begin_panel("settings", {settings_width, 0});
  draw_settings(app);
  end_panel();
  ImGui::SameLine();
  ImGui::PushStyleColor(ImGuiCol_ChildBg, ImVec4(0, 0, 0, 0));
  ImGui::BeginChild("run");
  ImGui::PopStyleColor();
  draw_controls(app);
  const Run* run = entry_ ? entry_->run.get() : nullptr;
  // What is shown is of the run, until the settings ask for another image.
  try {
    if (run != nullptr && entry_->source == source_) {
      pictures_.show(entry_->source, run->setup().problem.retarget, entry_->run->placement());
    } else if (source_) {
      pictures_.show(source_, settings_.retarget(*source_), nullptr);
    }
  } catch (...) {
    app.report_in_flight();
  }
  // In a narrow window pictures come before figures, each as high as it needs, and all of it scrolls.
  const bool narrow = ImGui::GetContentRegionAvail().x < em(40);
  if (!narrow) draw_standing();
  const ImVec2 room = ImGui::GetContentRegionAvail();
  if (layout_ != 1 && narrow) {
    const float pictures = std::max(em(19), room.y - em(2));
    begin_panel("pictures", {0, pictures + em(9)});
    pictures_.draw_controls_last({ImGui::GetContentRegionAvail().x, pictures});
    end_panel();
  } else if (layout_ != 1) {
    begin_panel("pictures", {0, layout_ == 2 ? std::max(em(20), room.y) : std::max(em(14), room.y * 0.42f)});
    pictures_.draw(ImGui::GetContentRegionAvail(), layout_ == 2);
    end_panel();
  }
  if (narrow) draw_standing();
  if (layout_ != 2) {
    begin_panel("plots", {0, narrow ? em(60) : std::max(em(20), ImGui::GetContentRegionAvail().y)});
    draw_plots(ImGui::GetContentRegionAvail());
    end_panel();
  }
  ImGui::EndChild();
  set_label_width(8);
}

void RunView::draw_settings(App& app) {
  set_label_width(6.5f);
  draw_image_settings(settings_, source_.get());
  if (!settings_.bakes_mask && button("Choose …")) {
    app.ask("Open an image", FileChooser::Want::open, settings_.file,
            [this](const std::filesystem::path& path) { open(path); });
  }
  draw_energy_settings(settings_, source_.get());
  draw_schedule_settings(settings_, plan_ ? &*plan_ : nullptr, refusal_ ? &*refusal_ : nullptr);
  draw_formula();
}

void RunView::draw_formula() {
  if (!plan_) return;
  const Formula formula = formula_of(plan_->schedule);
  ImGui::PushFont(mono_font());
  ImGui::TextWrapped("%s", formula.text.c_str());
  items::record("Formula", formula.text);
  ImGui::PopFont();
  const std::string where = fmt::format("{}", fmt::join(formula.where, "\n"));
  note(where);
  items::record("Where", where);
}

void RunView::handle_shortcuts(App& app) {
  const bool live = entry_ && !entry_->run->has_ended();
  if (shortcut("space")) {
    if (!live) {
      start_wanted_ = true, start_paused_ = false;
    } else if (entry_->run->standing().phase == Phase::paused) {
      entry_->run->start();
    } else {
      entry_->run->pause();
    }
  }
  if (shortcut("s") && live) entry_->run->sweep();
  if (shortcut("ctrl+s") && can_save()) ask_save(app);
}

void RunView::draw_controls(App& app) {
  handle_shortcuts(app);
  Run* run = entry_ ? entry_->run.get() : nullptr;
  const Phase phase = run != nullptr ? run->standing().phase : Phase::stopped;
  const bool live = run != nullptr && phase < Phase::finished, paused = phase == Phase::paused;
  const auto fresh = [&](bool as_paused) { start_wanted_ = true, start_paused_ = as_paused; };
  if (main_button(paused ? "Go on" : "Start", !live || paused, "Anneal with these settings (space)")) {
    live ? run->start() : fresh(false);
  }
  const auto next = [](const char* label, bool enabled, const char* hint, float gap = 0.5f) {
    flow(button_width(label), em(gap));
    return button(label, enabled, hint);
  };
  if (next("Pause", live && !paused, "Halt between two slices of the run (space)")) run->pause();
  if (next("One sweep", true, "Half as many proposals as pixels, then a pause (S)")) {
    live ? run->sweep() : fresh(true);
  }
  if (next("Restart", run != nullptr,
           "From the identity, with the settings as they are now; the run so far stays in Compare")) {
    fresh(false);
  }
  if (next("Stop", live, "For good; what was found stays")) run->stop();
  if (next("Save texture …", can_save(),
           "The best tile so far, as a file that bn verify proves (Ctrl+S); its recipe makes it again. Once "
           "the run "
           "has ended or is paused, after its first round",
           1.5f)) {
    ask_save(app);
  }
  set_label_width(0);
  static constexpr const char* kLayouts[] = {"All", "Plots", "Pictures"};
  flow(choice_width("", kLayouts), em(1.5f));
  choice("##layout", kLayouts, layout_);
}

void RunView::draw_standing() {
  const Standing standing = entry_ ? entry_->run->standing() : Standing{};
  const AnnealState& state = standing.state;
  const bool any = entry_ != nullptr && standing.phase != Phase::preparing && standing.phase != Phase::failed;
  const auto result = any && standing.phase >= Phase::finished ? entry_->run->result() : nullptr;
  const double budget = any ? static_cast<double>(entry_->run->setup().options.proposals) : 1.0;
  const std::int64_t energy = result ? result->tile.energy : state.energy;
  const auto gap = any ? gap_percent(*entry_, energy) : std::nullopt;
  const RetargetTile* optimum = any && entry_->optimum ? entry_->optimum->tile() : nullptr;

  const auto percent_of_start = [&](std::int64_t e) {
    return standing.start_energy > 0
               ? fmt::format(" ({:.2f} %)",
                             100.0 * static_cast<double>(e) / static_cast<double>(standing.start_energy))
               : "";
  };
  std::string bound = "–";
  if (any)
    bound = optimum                      ? fmt::format("{}", optimum->energy)
            : !entry_->optimum           ? "none"
            : entry_->optimum->solving() ? "solving …"
                                         : "failed";
  const bool outdated = entry_ && entry_->settings_text != settings_.all_text();
  const bool ended = entry_ && standing.phase >= Phase::finished;
  const std::pair<const char*, std::string> cells[] = {
      {"State", !entry_             ? "no run yet"
                : outdated && ended ? "changed"
                                    : phase_name(standing.phase)},
      {"Energy", any ? fmt::format("{}{}", energy, percent_of_start(energy)) : "–"},
      {"Optimum", bound},
      {"Gap", percent_text(gap)},
      {"Temperature", any ? fmt::format("{:.4g}", state.temperature) : "–"},
      {"Accepted", any && state.proposals > 0
                       ? fmt::format("{:.2f} %", 100.0 * static_cast<double>(state.accepted) /
                                                     static_cast<double>(state.proposals))
                       : "–"},
      {"Speed",
       standing.proposals_per_second > 0 ? short_number(standing.proposals_per_second, 3) + "/s" : "–"},
      {"Time", any ? time_text(state.seconds) : "–"},
      {"Left", standing.seconds_left ? time_text(*standing.seconds_left) : "–"}};
  constexpr float kWidths[] = {5.5f, 9.5f, 5.5f, 5.0f, 6.5f, 5.5f, 6.0f, 5.0f, 5.0f};
  constexpr std::size_t kCells = std::size(kWidths);
  // As many columns as there is room for, each as wide as its widest cell.
  const ImGuiStyle& style = ImGui::GetStyle();
  const float room = ImGui::GetContentRegionAvail().x - 2 * style.WindowPadding.x;
  std::array<float, kCells> places{};
  std::size_t columns = kCells + 1;
  for (float whole = room + 1.0f; whole > room && columns > 1;) {
    --columns;
    whole = 0.0f;
    for (std::size_t column = 0; column < columns; ++column) {
      places[column] = whole;
      float widest = 0.0f;
      for (std::size_t i = column; i < kCells; i += columns) widest = std::max(widest, em(kWidths[i]));
      whole += widest;
    }
    whole -= em(1.0f);  // the room right of the last one
  }
  const auto rows = static_cast<float>((kCells + columns - 1) / columns);
  const float cell = 2 * ImGui::GetTextLineHeightWithSpacing();
  begin_panel("standing",
              {0, rows * cell + ImGui::GetFrameHeight() +
                      (outdated ? ImGui::GetTextLineHeightWithSpacing() : 0.0f) + 2 * style.WindowPadding.y});
  if (outdated) {
    const std::string text =
        ended ? fmt::format("Settings changed; figures and curves are of the last run, {}.", entry_->name())
              : fmt::format("Settings changed; {} goes on with its own.", entry_->name());
    ImGui::PushStyleColor(ImGuiCol_Text, palette().warn);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
    items::record("Changed", text);
  }
  for (std::size_t i = 0; i < kCells; ++i) {
    if (i % columns != 0) ImGui::SameLine(style.WindowPadding.x + places[i % columns]);
    figure_cell(cells[i].first, cells[i].second);
  }
  progress_bar("Progress", std::min(1.0, static_cast<double>(state.proposals) / budget),
               any ? fmt::format("{} of {} proposals",
                                 short_number(std::min(static_cast<double>(state.proposals), budget), 3),
                                 short_number(budget))
                   : "");
  end_panel();
}

void RunView::draw_plots(ImVec2 size) {
  const float gap = ImGui::GetStyle().ItemSpacing.x, row_gap = ImGui::GetStyle().ItemSpacing.y;
  const int columns = std::clamp(static_cast<int>((size.x + gap) / (em(17) + gap)), 1, 3);
  const int rows = columns == 1 ? 5 : columns == 2 ? 3 : 2;
  const float width = (size.x - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns);
  const float height =
      std::max(em(9), (size.y - row_gap * static_cast<float>(rows - 1)) / static_cast<float>(rows));
  Figure energy, temperature, acceptance, surface;
  if (entry_) {
    const DrawnRun drawn[] = {{entry_.get(), schedule_colour(entry_->settings.schedule_name())}};
    energy = energy_figure(drawn);
    temperature = temperature_figure(drawn);
    acceptance = acceptance_figure(drawn);
    surface = surface_figure(*entry_);
  } else {
    energy.title = "Energy", temperature.title = "Temperature", acceptance.title = "Accepted";
    surface.title = kSurfaceTitle;
    for (Figure* figure : {&energy, &temperature, &acceptance, &surface})
      figure->empty = "starts with the run";
  }
  if (plan_) {
    // Before the run it is the preview; during it, what an adaptive schedule departs from.
    PlannedCurve planned = planned_curve(*plan_, 200);
    Curve curve;
    curve.name = "planned";
    curve.colour = palette().dim_text;
    curve.dashed = true;
    curve.x = std::move(planned.proposals);
    curve.y = std::move(planned.temperature);
    temperature.curves.push_back(std::move(curve));
    temperature.x.name = "proposals";
    temperature.x.low = 0.0;
    temperature.y.logarithmic = true;
    temperature.x.high = std::max(entry_ ? temperature.x.high : 0.0, static_cast<double>(plan_->proposals));
  }
  const float last_width = columns == 1 ? width : columns == 2 ? width : 2 * width + gap;
  energy_plot_.draw("Energy plot", energy, {width, height}, plot_link_);
  if (columns > 1) ImGui::SameLine();
  temperature_plot_.draw("Temperature plot", temperature, {width, height}, plot_link_);
  if (columns > 2) ImGui::SameLine();
  spectrum_plot_.draw("Power plot", pictures_.spectrum_figure(), {width, height}, spectrum_link_);
  if (columns == 2) ImGui::SameLine();
  acceptance_plot_.draw("Acceptance plot", acceptance, {width, height}, plot_link_);
  if (columns > 2) ImGui::SameLine();
  surface_plot_.draw("Surface plot", surface, {columns == 2 ? size.x : last_width, height}, plot_link_);
}

}  // namespace bn::ui
