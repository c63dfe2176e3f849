// The table of the Compare view: a row a run, sorted by any column, the best of each problem marked.

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "ui/compare_view.h"
#include "ui/widgets.h"

namespace bn::ui {
namespace {

struct Column {
  const char* name;
  bool sorts;
};
constexpr Column kColumns[] = {{"Run", true},     {"A", false},      {"B", false},        {"Image", true},
                               {"Problem", true}, {"Start T", true}, {"Proposals", true}, {"Seed", true},
                               {"Energy", true},  {"Optimum", true}, {"Gap", true},       {"Time", true},
                               {"", false}};

std::string problem_text(const RunEntry& entry) {
  const RunSettings& s = entry.settings;
  static constexpr const char* kMetrics[] = {"L1", "L2", "blurred"};
  std::string text = fmt::format("radius {}, {}", s.radius, kMetrics[s.metric]);
  if (s.motion_x != 0 || s.motion_y != 0) text += fmt::format(", motion ({}, {})", s.motion_x, s.motion_y);
  return text;
}

/// Whether their energies can be held against each other.
bool same_problem(const RunEntry& a, const RunEntry& b) {
  const AnnealProblem &p = a.run->setup().problem, &q = b.run->setup().problem;
  return a.source->choice == b.source->choice && same(p.retarget, q.retarget) &&
         p.residual_sigma_px == q.residual_sigma_px;
}

/// What a column is sorted by: text, then number.
std::pair<std::string, double> sort_key(const RunEntry& entry, int column) {
  const RunStanding figures = standing_of(entry);
  const RetargetTile* optimum = entry.optimum ? entry.optimum->tile() : nullptr;
  const std::string name = kColumns[column].name;
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  if (name == "Image") return {entry.source->name, 0.0};
  if (name == "Problem") return {problem_text(entry), 0.0};
  if (name == "Start T") return {"", entry.run->standing().temperatures.start};
  if (name == "Proposals") return {"", static_cast<double>(figures.proposals)};
  if (name == "Seed") return {"", static_cast<double>(entry.settings.seed)};
  if (name == "Energy") return {"", static_cast<double>(figures.energy)};
  if (name == "Optimum") return {"", optimum != nullptr ? static_cast<double>(optimum->energy) : kUnknown};
  if (name == "Gap") return {"", gap_percent(entry, figures.energy).value_or(kUnknown)};
  if (name == "Time") return {"", figures.seconds};
  return {"", static_cast<double>(entry.number)};
}

}  // namespace

void CompareView::draw_table() {
  constexpr auto kFlags = ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_ScrollX |
                          ImGuiTableFlags_ScrollY | ImGuiTableFlags_Sortable;
  // ImGui's scrolling tables trip over a child window that is nowhere in sight.
  const ImVec2 room = ImGui::GetContentRegionAvail();
  if (!ImGui::IsRectVisible({room.x, room.y - ImGui::GetFrameHeightWithSpacing()})) return;
  if (!ImGui::BeginTable("runs", static_cast<int>(std::size(kColumns)), kFlags,
                         {0, -ImGui::GetFrameHeightWithSpacing()}))
    return;
  ImGui::TableSetupScrollFreeze(1, 1);
  for (const Column& column : kColumns) {
    ImGui::TableSetupColumn(column.name, column.sorts ? 0 : ImGuiTableColumnFlags_NoSort);
  }
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  for (const Column& column : kColumns) {
    ImGui::TableNextColumn();
    ImGui::TableHeader(column.name);
    if (column.sorts) items::record(fmt::format("Sort by {}", column.name));
  }
  std::vector<std::size_t> order(kept_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
  if (specs != nullptr && specs->SpecsCount > 0) {
    const auto key = [&](std::size_t i) { return sort_key(*kept_[i].entry, specs->Specs[0].ColumnIndex); };
    const bool down = specs->Specs[0].SortDirection == ImGuiSortDirection_Descending;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return down ? key(b) < key(a) : key(a) < key(b); });
  }
  removed_ = 0;
  int place = 0;
  for (const std::size_t i : order) {
    draw_row(kept_[i]);
    items::record(fmt::format("Row {}", ++place), fmt::format("{}", kept_[i].entry->number));
  }
  ImGui::EndTable();
  if (removed_ != 0) remove(removed_);
}

bool CompareView::is_best(const RunEntry& entry) const {
  bool others = false;
  for (const Kept& kept : kept_) {
    if (kept.entry.get() == &entry || !same_problem(*kept.entry, entry)) continue;
    others = true;
    if (standing_of(*kept.entry).energy < standing_of(entry).energy) return false;
  }
  return others;
}

void CompareView::draw_row(Kept& kept) {
  const RunEntry& entry = *kept.entry;
  const RunStanding figures = standing_of(entry);
  const auto gap = gap_percent(entry, figures.energy);
  const RetargetTile* optimum = entry.optimum ? entry.optimum->tile() : nullptr;
  ImGui::PushID(entry.number);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::PushStyleColor(ImGuiCol_CheckMark, kept.colour());
  checkbox(entry.name().c_str(), kept.shown, "Whether its curves are shown");
  ImGui::PopStyleColor();
  const auto pick = [&](const char* name, Side& side) {
    ImGui::TableNextColumn();
    if (ImGui::RadioButton(name, side.number == entry.number))
      side = {.number = entry.number, .placement = {}, .what = -1, .picture = {}};
    items::record(fmt::format("{} {}", name + 2, entry.number), side.number == entry.number ? "on" : "off");
  };
  pick("##A", a_);
  pick("##B", b_);
  const auto cell = [&](const char* name, const std::string& text, bool good = false) {
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, good ? palette().good : palette().text);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
    items::record(fmt::format("{} {}", name, entry.number), text);
  };
  cell("Image", entry.source->name);
  cell("Problem", problem_text(entry));
  cell("Start T", fmt::format("{:.4g}", entry.run->standing().temperatures.start));
  cell("Proposals", short_number(std::min(static_cast<double>(figures.proposals), entry.settings.proposals)));
  cell("Seed", fmt::format("{}", entry.settings.seed));
  const bool best = is_best(entry);
  cell("Energy", fmt::format("{}{}", figures.energy, best ? " best" : ""), best);
  cell("Optimum", optimum != nullptr ? fmt::format("{}", optimum->energy) : "–");
  cell("Gap", gap ? fmt::format("{:.2f} %", *gap) : "–");
  cell("Time", fmt::format("{:.2f} s", figures.seconds));
  ImGui::TableNextColumn();
  if (ImGui::SmallButton("Remove")) removed_ = entry.number;
  items::record(fmt::format("Remove {}", entry.number));
  ImGui::PopID();
}

}  // namespace bn::ui
