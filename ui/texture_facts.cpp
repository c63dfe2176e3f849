// What the Texture view says in words: the verdict, the metadata, the figures of merit with their thresholds.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "bn/judgement.h"
#include "bn/report.h"
#include "ui/app.h"
#include "ui/recipe_text.h"
#include "ui/texture_view.h"
#include "ui/widgets.h"

namespace bn::ui {
namespace {

const std::array<std::string, 5> kThresholds{"fitting", "none", "blue", "white", "stbn"};

std::string figure_text(double value) { return std::isnan(value) ? "–" : fmt::format("{:.3g}", value); }

std::string range_text(const JudgedFigure& figure) {
  if (std::isinf(figure.low) && std::isinf(figure.high)) return "";
  if (std::isinf(figure.high)) return fmt::format("≥ {:.3g}", figure.low);
  if (std::isinf(figure.low) || figure.low == 0.0) return fmt::format("≤ {:.3g}", figure.high);
  return fmt::format("{:.3g} … {:.3g}", figure.low, figure.high);
}

struct Row {
  std::string key;   ///< of JudgedFigure
  std::string name;  ///< for the reader
  double value;
};

std::vector<Row> rows_of(const FiguresOfMerit& f) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < f.bands.mean.size(); ++i) {
    rows.push_back({fmt::format("bands[{}]", i),
                    fmt::format("Power, f {}…{}", i == 0 ? 0.0 : kBandEdges[i - 1], kBandEdges[i]),
                    f.bands.mean[i]});
  }
  rows.push_back({"peak", "Peak power", f.peak});
  rows.push_back({"peak_frequency", "Peak frequency", f.peak_frequency});
  rows.push_back({"anisotropy_db_mean", "Anisotropy, mean dB", f.anisotropy_db_mean});
  rows.push_back({"anisotropy_db_max", "Anisotropy, max dB", f.anisotropy_db_max});
  for (std::size_t i = 0; i < kResidualSigmas.size(); ++i) {
    rows.push_back({"", fmt::format("After blur σ {:.1f}, dB", kResidualSigmas[i]), f.gauss_residual_db[i]});
  }
  rows.push_back({"histogram_max_deviation", "Histogram deviation", f.histogram_max_deviation});
  if (f.shape.depth > 1) {
    rows.push_back({"temporal_power_at_0", "Power in time at 0", f.temporal_power_at_0});
    rows.push_back({"filtered_residual_db", "Left by blur and average, dB", f.filtered_residual_db});
    rows.push_back({"temporal_power_low", "Power in time, f 0…0.125", f.temporal_power_low});
  }
  return rows;
}

/// What the entry of kThresholds asks for.
std::optional<Check> check_of(int thresholds, Check fitting) {
  constexpr std::array<std::optional<Check>, 3> kNamed{Check::blue, Check::white, Check::stbn};
  if (thresholds == 0) return fitting;
  return thresholds == 1 ? std::nullopt : kNamed.at(static_cast<std::size_t>(thresholds) - 2);
}

}  // namespace

void TextureView::draw_facts(App& app) {
  heading("File");
  value("Name", texture_->path.filename().string(), texture_->path.string());
  draw_verdict();
  draw_metadata();
  if (texture_->images.size() == 1 && !is_retarget(*texture_) &&
      button("Anneal it", true, "Take this image to the Run view")) {
    app.run.open(texture_->path);
    app.show(Tab::run);
  }
  draw_figures();
}

void TextureView::draw_verdict() {
  if (!texture_->metadata) {
    if (texture_->metadata_fault.empty()) {
      value("Verified", "no metadata of ours", palette().dim_text,
            "Nothing is claimed, so nothing can be verified.");
    } else {
      value("Verified", "metadata damaged: " + texture_->metadata_fault, palette().bad);
    }
    return;
  }
  if (verifying_.running()) {
    value("Verified", fmt::format("computing … {:.0f} %", 100.0 * verifying_.progress()), palette().dim_text,
          "Every figure of the file is computed again.");
    return;
  }
  if (!verdict_) return;
  const auto& items = *verdict_;
  const auto passed =
      std::count_if(items.begin(), items.end(), [](const VerifyItem& item) { return item.pass; });
  const bool all = passed == static_cast<std::ptrdiff_t>(items.size());
  value("Verified", fmt::format("{}, {} of {} checks", all ? "pass" : "FAIL", passed, items.size()),
        all ? palette().good : palette().bad, "As by bn verify.");
  if (!ImGui::TreeNodeEx("Checks", all ? 0 : ImGuiTreeNodeFlags_DefaultOpen)) return items::record("Checks");
  items::record("Checks");
  for (const VerifyItem& item : items) {
    ImGui::PushStyleColor(ImGuiCol_Text, item.pass ? palette().good : palette().bad);
    ImGui::TextUnformatted(item.pass ? "✓" : "✗");
    ImGui::PopStyleColor();
    ImGui::SameLine();
    ImGui::TextWrapped("%s%s%s", item.check.c_str(), item.detail.empty() ? "" : ": ", item.detail.c_str());
  }
  ImGui::TreePop();
}

void TextureView::draw_metadata() {
  const Image& first = texture_->images[0];
  const int slices = slice_count(*texture_, section_.cut);
  const Extent size = slice_size(*texture_, section_.cut);
  const char* parts = motion_range(*texture_) > 0 ? "motions" : "slices";
  value("Size", slices > 1 ? fmt::format("{} × {}, {} {}", size.width, size.height, slices, parts)
                           : fmt::format("{} × {}", size.width, size.height));
  value("Samples", fmt::format("{} × {}", first.channels, name_of(first.type)));
  // Our own files say how they are cut.
  if (section_.cut.count() > 1 && texture_->metadata) {
    value("Columns", fmt::format("{}", section_.cut.columns));
    value("Rows", fmt::format("{}", section_.cut.rows));
  } else if (texture_->images.size() == 1 && !texture_->metadata) {
    std::int64_t columns = section_.cut.columns, rows = section_.cut.rows;
    const bool changed = field("Columns", columns, 1, first.size.width, "Of an atlas of equal tiles") |
                         field("Rows", rows, 1, first.size.height, "Of an atlas of equal tiles");
    const AtlasCut cut{static_cast<int>(columns), static_cast<int>(rows)};
    if (changed && fits(*texture_, cut)) section_.cut = cut;
  }
  if (!texture_->metadata) return;
  const Metadata& m = *texture_->metadata;
  value("Kind", m.kind);
  value("Algorithm", fmt::format("{}, version {}", m.algorithm, m.algorithm_version));
  if (const auto& a = texture_->annealing) {
    const std::string budget = short_number(static_cast<double>(a->proposals)) + " proposals";
    const bool stopped = a->stop_after > 0;
    value("Annealed",
          stopped ? fmt::format("{}, stopped after {} of {}", a->schedule,
                                short_number(static_cast<double>(a->stop_after)), budget)
                  : fmt::format("{}, {}", a->schedule, budget),
          stopped ? palette().warn : palette().text);
  }
  const auto reach = m.facts.get<std::string>("reach");
  if (const auto seed = m.facts.get<std::int64_t>("seed")) value("Seed", fmt::format("{}", *seed));
  if (const auto step = m.facts.get<Offset>("step")) value("Step", fmt::format("({}, {})", step->x, step->y));
  if (const auto radius = m.facts.get<int>("radius"))
    value("Radius", fmt::format("{}{}", *radius, reach ? ", " + *reach : ""));
  for (const auto& [name, key] : {std::pair{"Metric", "metric"}, {"Form", "form"}, {"Source", "source"}}) {
    if (const auto word = m.facts.get<std::string>(key)) value(name, *word);
  }
  draw_tile_record();
  value("Pixel hash", texture_->hash_fits ? "as recorded" : "not the recorded one",
        texture_->hash_fits ? palette().good : palette().bad, m.pixel_hash);
  if (ImGui::TreeNode("Recipe")) {
    show_recipe(m.recipe);
    ImGui::TreePop();
  }
  items::record("Recipe");
}

void TextureView::draw_tile_record() {
  const auto& tiles = texture_->metadata->tiles;
  const bool one_each = static_cast<int>(tiles.size()) == slice_count(*texture_, section_.cut);
  if (tiles.empty() || !(one_each || tiles.size() == 1)) return;
  const TileRecord& tile = tiles[tiles.size() == 1 ? 0 : static_cast<std::size_t>(slice_)];
  const auto share = [&](std::int64_t energy) {
    return tile.start_energy > 0
               ? fmt::format("{} ({:.3f} %)", energy,
                             100.0 * static_cast<double>(energy) / static_cast<double>(tile.start_energy))
               : fmt::format("{}", energy);
  };
  value("Motion", fmt::format("({}, {})", tile.motion.x, tile.motion.y));
  value("Energy", share(tile.energy), "In levels, and as a share of the start energy");
  if (tile.energy == tile.lower_bound) {
    value("Optimum", "proven", palette().good, "No permutation within reach has less energy.");
  } else {
    value("Lower bound", share(tile.lower_bound), "Proven: no permutation within reach has less.");
  }
}

void TextureView::draw_figures() {
  if (is_retarget(*texture_)) return;  // a tile's figure is its energy
  heading("Figures of merit");
  if (const std::string of = channel_text(); !of.empty()) {
    note(of);
    items::record("Figures of channel", of);
  }
  combo("Thresholds", kThresholds, thresholds_,
        "As bn spectrum --check; fitting: stbn for stacks, else blue");
  if (!analysis_) return note(analysing_.running() ? "Transforming …" : "");
  const FiguresOfMerit& figures = analysis_->figures;
  std::vector<JudgedFigure> judged;
  if (const auto check = check_of(thresholds_, natural_check(figures.shape, texture_->metadata))) {
    judged = judge(figures, *check);
    const bool all =
        std::all_of(judged.begin(), judged.end(), [](const auto& figure) { return figure.passed; });
    value("Check", all ? "pass" : "FAIL", all ? palette().good : palette().bad);
    if (const double score = grade(figures, *check).score; !std::isnan(score)) {
      value("Grade", fmt::format("{:.0f} of 100", score),
            "100: as good as the best known of its size; 0: no better than white noise");
    }
  }
  if (!ImGui::BeginTable("figures", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) return;
  ImGui::TableSetupColumn("figure", 0, 2.2f);
  ImGui::TableSetupColumn("value", 0, 1.0f);
  ImGui::TableSetupColumn("allowed", 0, 1.3f);
  for (const Row& row : rows_of(figures)) {
    const auto found =
        std::find_if(judged.begin(), judged.end(), [&](const auto& j) { return j.figure == row.key; });
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, palette().dim_text);
    ImGui::TextUnformatted(row.name.c_str());
    ImGui::PopStyleColor();
    ImGui::TableNextColumn();
    const bool missed = found != judged.end() && !found->passed;
    ImGui::PushStyleColor(ImGuiCol_Text, missed ? palette().bad : palette().text);
    ImGui::TextUnformatted(figure_text(row.value).c_str());
    ImGui::PopStyleColor();
    items::record(row.name, figure_text(row.value));
    ImGui::TableNextColumn();
    if (found == judged.end()) continue;
    ImGui::PushStyleColor(ImGuiCol_Text, missed ? palette().bad : palette().good);
    ImGui::Text("%s %s", missed ? "✗" : "✓", range_text(*found).c_str());
    ImGui::PopStyleColor();
  }
  ImGui::EndTable();
}

}  // namespace bn::ui
