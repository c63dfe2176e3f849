#include "ui/compare_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ui/app.h"
#include "ui/compare_export.h"
#include "ui/flow.h"
#include "ui/keys.h"
#include "ui/parameters.h"
#include "ui/widgets.h"

namespace bn::ui {
namespace {

constexpr std::size_t kMostKept = 16;

/// Columns left of `share` from a, the others from b.
Picture split(const Picture& a, const Picture& b, double share) {
  Picture both = a;
  const auto width = static_cast<std::size_t>(a.size.width);
  const auto first = static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(width) + 0.5);
  const auto channels = static_cast<std::size_t>(a.channels);
  for (std::size_t y = 0; y < static_cast<std::size_t>(a.size.height); ++y) {
    const std::size_t from = y * width + first, to = (y + 1) * width;
    std::copy(b.values.begin() + static_cast<std::ptrdiff_t>(from * channels),
              b.values.begin() + static_cast<std::ptrdiff_t>(to * channels),
              both.values.begin() + static_cast<std::ptrdiff_t>(from * channels));
    if (both.colours.empty()) continue;
    std::copy(b.colours.begin() + static_cast<std::ptrdiff_t>(from),
              b.colours.begin() + static_cast<std::ptrdiff_t>(to),
              both.colours.begin() + static_cast<std::ptrdiff_t>(from));
  }
  return both;
}

}  // namespace

void CompareView::parameters(Parameters& p) {
  p("compare.what", what_, 0, 2);
  p("compare.mode", mode_, 0, 2);
  p("compare.split", split_, 0.0, 1.0);
  p("compare.over", over_, 0, 1);
  p("compare.folder", export_folder_);
  if (p.loading()) compose_ = true;
}

bool CompareView::busy() const {
  return exporting_.running() || !leaving_.empty() ||
         std::any_of(kept_.begin(), kept_.end(), [](const Kept& k) { return !k.entry->run->has_ended(); });
}

void CompareView::add(std::shared_ptr<RunEntry> entry) {
  (find(a_.number) == nullptr ? a_ : b_) = {
      .number = entry->number, .placement = {}, .what = -1, .picture = {}};
  const auto is_taken = [&](int repeat) {
    return std::any_of(kept_.begin(), kept_.end(), [&](const Kept& k) {
      return k.repeat == repeat && k.entry->settings.schedule == entry->settings.schedule;
    });
  };
  int repeat = 0;
  while (is_taken(repeat)) ++repeat;
  kept_.push_back({.entry = std::move(entry), .repeat = repeat});
  if (kept_.size() <= kMostKept) return;
  const auto oldest =
      std::find_if(kept_.begin(), kept_.end(), [](const Kept& k) { return k.entry->run->has_ended(); });
  if (oldest != kept_.end()) kept_.erase(oldest);
}

const RunEntry* CompareView::find(int number) const {
  const auto found =
      std::find_if(kept_.begin(), kept_.end(), [&](const Kept& k) { return k.entry->number == number; });
  return found == kept_.end() ? nullptr : found->entry.get();
}

void CompareView::remove(int number) {
  const auto found =
      std::find_if(kept_.begin(), kept_.end(), [&](const Kept& k) { return k.entry->number == number; });
  if (found == kept_.end()) return;
  found->entry->run->stop();
  leaving_.push_back(found->entry);
  kept_.erase(found);
}

void CompareView::update(App& app) {
  for (const Kept& kept : kept_) {
    if (kept.entry->optimum) kept.entry->optimum->poll();
  }
  std::erase_if(leaving_, [](const auto& entry) { return entry->run->has_ended(); });
  try {
    if (const auto done = exporting_.poll()) app.say(*done);
  } catch (...) {
    app.report_in_flight();
  }
}

void CompareView::start_export(App& app, const std::filesystem::path& folder) {
  std::vector<ExportedRun> runs;
  for (const Kept& kept : kept_) {
    if (!kept.shown) continue;
    const RunEntry& entry = *kept.entry;
    const RunStanding figures = standing_of(entry);
    const RetargetTile* optimum = entry.optimum ? entry.optimum->tile() : nullptr;
    const std::int64_t bound = optimum != nullptr ? optimum->energy : 0;
    runs.push_back({.name = fmt::format("{}-{}", entry.number, entry.settings.schedule_name()),
                    .schedule = entry.settings.schedule_name(),
                    .radius = entry.settings.radius,
                    .proposals = figures.proposals,
                    .seed = static_cast<std::uint64_t>(entry.settings.seed),
                    .seconds = figures.seconds,
                    .energy = figures.energy,
                    .optimum = bound,
                    .trace_csv = entry.run->trace().csv(bound)});
  }
  export_folder_ = folder;
  app.say("Exporting …");
  exporting_.start(
      [runs, folder](const Execution& execution) { return export_runs(runs, folder, execution); });
}

void CompareView::draw(App& app) {
  update(app);
  if (kept_.empty()) {
    begin_panel("none");
    begin_centred("what to do", "Nothing to compare yet");
    note(
        "Every run that you start is kept here. Start one in the Run view, change its schedule, its budget "
        "or "
        "its seed, and start again: their curves share a plot, their pictures stand side by side.");
    if (main_button("Go to Run")) app.show(Tab::run);
    end_centred();
    end_panel();
    return;
  }
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float rows = static_cast<float>(std::min<std::size_t>(kept_.size(), 6)) + 1.0f;
  const float table = rows * (ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().CellPadding.y) +
                      ImGui::GetFrameHeightWithSpacing() + 2 * ImGui::GetStyle().WindowPadding.y +
                      (room.x < em(76) ? ImGui::GetStyle().ScrollbarSize : 0.0f);
  begin_panel("runs", {0, std::min(table, room.y * 0.45f)});
  draw_table();
  const bool any = std::any_of(kept_.begin(), kept_.end(), [](const Kept& k) { return k.shown; });
  if (button("Export …", any && !exporting_.running(),
             "The shown runs as CSV, and their figures as gnuplot and SVG, into a folder")) {
    app.ask("Export into a folder", FileChooser::Want::folder, export_folder_,
            [this, &app](const std::filesystem::path& path) { start_export(app, path); });
  }
  end_panel();
  const ImVec2 rest = ImGui::GetContentRegionAvail();
  const bool wide = rest.x > em(48);
  const float high = wide ? std::max(em(34), rest.y) : em(36);
  begin_panel("curves", {wide ? rest.x * 0.5f : 0.0f, high});
  draw_plots(ImGui::GetContentRegionAvail());
  end_panel();
  if (wide) ImGui::SameLine();
  begin_panel("pictures", {0, high});
  draw_pictures(ImGui::GetContentRegionAvail());
  end_panel();
  set_label_width(8);
}

void CompareView::draw_plots(ImVec2 size) {
  std::vector<DrawnRun> drawn;
  for (const Kept& kept : kept_) {
    if (kept.shown) drawn.push_back({kept.entry.get(), kept.colour()});
  }
  const float before = ImGui::GetCursorPosY();
  set_label_width(0);
  static constexpr const char* kOver[] = {"proposals", "seconds"};
  if (choice("Over", kOver, over_, "What the curves are drawn over")) plot_link_ = {};
  const float gap = ImGui::GetStyle().ItemSpacing.y, height = size.y - (ImGui::GetCursorPosY() - before);
  const float first = std::max(em(10), height * 0.38f),
              second = std::max(em(10), (height - first - 2 * gap) * 0.5f);
  const Over over = over_ == 0 ? Over::proposals : Over::seconds;
  Figure energy = energy_figure(drawn, over), temperature = temperature_figure(drawn, over);
  // The plots stand below each other on one axis, which the last one names.
  energy.x.name.clear();
  temperature.x.name.clear();
  energy_plot_.draw("Energies", energy, {size.x, first}, plot_link_);
  temperature_plot_.draw("Temperatures", temperature, {size.x, second}, plot_link_);
  acceptance_plot_.draw("Acceptances", acceptance_figure(drawn, over), {size.x, second}, plot_link_);
}

/// Makes the side's picture again if its run has gone on. True: it did.
bool CompareView::refresh(Side& side) {
  const RunEntry* entry = find(side.number);
  if (entry == nullptr) {
    const bool had = side.picture.size.area() > 0;
    side = {.number = 0, .placement = {}, .what = -1, .picture = {}};
    return had;
  }
  auto placement = entry->run->placement();
  if (!placement || (placement == side.placement && side.what == what_)) return false;
  side.placement = std::move(placement);
  side.what = what_;
  const Grid<std::int32_t>& levels = entry->source->levels.value;
  const RetargetOptions& options = entry->run->setup().problem.retarget;
  const Grid<Offset>& move = side.placement->move;
  side.picture = what_ == 0   ? permuted_picture(levels, move)
                 : what_ == 1 ? difference_picture(levels, move, options.step, 8)
                              : offset_picture(move, options);
  return true;
}

/// Any two of the runs; the columns A and B of the table do the same.
void CompareView::choose_pair(float width) {
  std::vector<std::string> names;
  for (const Kept& kept : kept_) names.push_back(kept.entry->name());
  if (!ImGui::BeginTable("pair", 2, ImGuiTableFlags_SizingStretchSame, {width, 0})) return;
  set_label_width(1.2f);
  for (const auto& [label, side] : {std::pair<const char*, Side*>{"A", &a_}, {"B", &b_}}) {
    ImGui::TableNextColumn();
    const auto chosen = std::find_if(kept_.begin(), kept_.end(),
                                     [&](const Kept& kept) { return kept.entry->number == side->number; });
    int index = chosen == kept_.end() ? -1 : static_cast<int>(chosen - kept_.begin());
    if (combo(label, names, index, "The run on this side")) {
      *side = {.number = kept_[static_cast<std::size_t>(index)].entry->number,
               .placement = {},
               .what = -1,
               .picture = {}};
    }
  }
  set_label_width(0);
  ImGui::EndTable();
}

void CompareView::draw_pictures(ImVec2 size) {
  const float before = ImGui::GetCursorPosY();
  set_label_width(0);
  static constexpr const char* kWhat[] = {"permuted", "difference", "offsets"};
  choice("##what", kWhat, what_);
  const RunEntry* first = find(a_.number);
  if (what_ == 2 && first != nullptr) {
    ImGui::SameLine();
    legend_.draw(ImGui::GetFrameHeight(), longest_move(first->run->setup().problem.retarget));
  }
  static constexpr const char* kModes[] = {"A | B", "Flip", "Split"};
  flow(choice_width("", kModes), em(1.0f));
  if (choice("##mode", kModes, mode_,
             "Side by side; one in the other's place (X changes over); A to the left of a line, B to its "
             "right")) {
    compose_ = true;
  }
  draw_link_controls(link_);
  if (mode_ == 1) {
    flow(button_width("Change over"));
    if (button("Change over", true, "Show the other one (X)") || shortcut("x"))
      flipped_ = !flipped_, compose_ = true;
  }
  if (mode_ == 2) {
    flow(em(8));
    if (slider("##split", split_, 0.0, 1.0, "split at %.2f")) compose_ = true;
  }
  const bool new_a = refresh(a_), new_b = refresh(b_);
  const bool same_size = a_.picture.size == b_.picture.size && a_.picture.size.area() > 0;
  if (mode_ == 0) {
    if (new_a || compose_) view_a_.set(a_.picture);
    if (new_b || compose_) view_b_.set(b_.picture);
  } else if (new_a || new_b || compose_) {
    const Side& front = flipped_ ? b_ : a_;
    if (mode_ == 2 && same_size)
      view_a_.set(split(a_.picture, b_.picture, split_));
    else
      view_a_.set(front.picture.size.area() > 0 ? front.picture : a_.picture);
  }
  compose_ = false;
  choose_pair(size.x);
  const auto title = [&](const char* letter, const Side& side) {
    const RunEntry* entry = find(side.number);
    return entry == nullptr ? fmt::format("{}: choose a run", letter)
                            : fmt::format("{}: {}, energy {}", letter, entry->name(),
                                          side.placement ? side.placement->energy : 0);
  };
  const float rest = size.y - (ImGui::GetCursorPosY() - before) - ImGui::GetTextLineHeightWithSpacing();
  if (mode_ == 0) {
    const float gap = ImGui::GetStyle().ItemSpacing.x, width = 0.5f * (size.x - gap);
    ImGui::BeginGroup();
    ImGui::TextUnformatted(title("A", a_).c_str());
    view_a_.draw("Picture A", link_, {width, rest});
    ImGui::EndGroup();
    ImGui::SameLine(0, gap);
    ImGui::BeginGroup();
    ImGui::TextUnformatted(title("B", b_).c_str());
    view_b_.draw("Picture B", link_, {width, rest});
    ImGui::EndGroup();
    return;
  }
  const std::string text = mode_ == 1  ? (flipped_ ? title("B", b_) : title("A", a_))
                           : same_size ? title("A", a_) + "  |  " + title("B", b_)
                                       : "A and B differ in size";
  ImGui::TextUnformatted(text.c_str());
  items::record("Shown picture", text);
  view_a_.draw("Picture", link_, {size.x, rest});
}

}  // namespace bn::ui
