// Two forms for people: one texture gets a line a figure, with what is allowed and what the best known read;
// several get a line each, verdict first, name last, so that 80 columns show what matters. Reasons follow in
// words.

#include "tools/spectrum_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/output.h"

namespace bn::tools {
namespace {

using Json = nlohmann::ordered_json;

std::string_view check_name(Check kind) {
  return kind == Check::blue ? "blue" : kind == Check::white ? "white" : "stbn";
}

std::string size_of(const Shape& shape) {
  std::string size = fmt::format("{}x{}", shape.width, shape.height);
  return shape.depth > 1 ? size + fmt::format("x{}", shape.depth) : size;
}

std::string_view verdict_of(const SpectrumRow& row) {
  if (!row.set_aside.empty() || !row.judgement) return "-";
  if (!row.relation.empty()) return "FAIL";
  switch (row.judgement->outcome) {
    case Judgement::Outcome::good:
      return "pass";
    case Judgement::Outcome::weak:
      return "weak";
    case Judgement::Outcome::failed:
      return "FAIL";
    case Judgement::Outcome::cannot_tell:
      break;
  }
  return "small";
}

std::string number(double value) { return std::isnan(value) ? "-" : fmt::format("{:.3g}", value); }
std::string score(double value) { return std::isnan(value) ? "-" : fmt::format("{:.0f}", value); }

std::string channel_of(const SpectrumRow& row) {
  return row.channel_name.empty() ? std::to_string(row.channel) : row.channel_name;
}

/// "rgba.png:2"; of a name that is too long for its column the end.
std::string short_name(const SpectrumRow& row, std::size_t width) {
  const std::string name = row.only_channel ? row.file : fmt::format("{}:{}", row.file, channel_of(row));
  return name.size() <= width ? name : "..." + name.substr(name.size() - width + 3);
}

std::string reasons_of(const Judgement& judgement) {
  std::string text;
  for (const std::string& reason : judgement.reasons) text += paragraph(reason, 6);
  if (!judgement.not_judged.empty() && judgement.outcome != Judgement::Outcome::cannot_tell) {
    std::string names;
    for (const std::string& name : judgement.not_judged)
      names += (names.empty() ? "" : "; ") + label_of(name);
    text += paragraph("too small to judge: " + names, 6);
  }
  return text;
}

std::string allowed(const JudgedFigure& figure) {
  if (std::isinf(figure.high)) return "> 0";
  if (std::isinf(figure.low) || figure.low == 0.0) return "<= " + number(figure.high);
  return fmt::format("{:.3g}..{:.3g}", figure.low, figure.high);
}

/// Every figure of one texture in a line of its own.
std::string figures_in_full(const SpectrumRow& row) {
  const FiguresOfMerit& f = row.figures;
  const Json values = Json::parse(bn::to_json(f));
  std::string text =
      fmt::format("{:<31}{:>11}  {:<13}{:>11}{:>7}\n", "figure", "value", "allowed", "best known", "score");
  const auto line = [&](const std::string& name, const std::string& label, const std::string& value) {
    std::string limits, best, points;
    if (row.judgement) {
      for (const JudgedFigure& judged : row.judgement->judged) {
        if (judged.figure == name) limits = allowed(judged) + (judged.passed ? "" : " FAIL");
      }
    }
    for (const GradePart& part : row.grade.parts) {
      if (part.figure != name) continue;
      if (name != "anisotropy_db_mean") best = fmt::format("{:.2g}", part.best);
      points = score(part.score);
    }
    std::string cells = fmt::format("{:<31}{:>11}  {:<13}{:>11}{:>7}", label, value, limits, best, points);
    cells.erase(cells.find_last_not_of(' ') + 1);
    text += cells + "\n";
  };
  for (std::size_t b = 0; b < f.bands.mean.size(); ++b) {
    const std::string name = fmt::format("bands[{}]", b);
    line(name, label_of(name), number(f.bands.mean[b]));
  }
  if (f.shape.depth > 1) {
    line("temporal_power_at_0", label_of("temporal_power_at_0"), number(f.temporal_power_at_0));
    line("temporal_power_low", label_of("temporal_power_low"), number(f.temporal_power_low));
    line("filtered_residual_db", label_of("filtered_residual_db"), number(f.filtered_residual_db));
  }
  line("anisotropy_db_mean", label_of("anisotropy_db_mean"), number(f.anisotropy_db_mean));
  line("anisotropy_db_max", label_of("anisotropy_db_max"), number(f.anisotropy_db_max));
  if (f.distribution == Distribution::uniform) {
    line("histogram_max_deviation", label_of("histogram_max_deviation"), number(f.histogram_max_deviation));
  } else {
    line("distribution_distance", label_of("distribution_distance"), number(f.distribution_distance));
  }
  line("peak", "peak of the radial power", number(f.peak));
  line("peak_frequency", "its frequency, cycles/pixel", number(f.peak_frequency));
  for (std::size_t s = 0; s < kResidualSigmas.size(); ++s) {
    line("", fmt::format("left by a blur of {:.1f} px, dB", kResidualSigmas[s]),
         number(f.gauss_residual_db[s]));
  }
  return text + "Power is against white noise, which reads 1; f in cycles/pixel.\n";
}

std::string one_texture(const SpectrumRow& row) {
  std::string head = size_of(row.figures.shape);
  if (row.judgement) head += fmt::format(", {}: {}", verdict_of(row), row.judgement->headline);
  if (!std::isnan(row.grade.score)) {
    head += fmt::format(", grade {} of 100", score(row.grade.score));
    if (!row.grade.weakest.empty()) head += fmt::format(" (by {})", label_of(row.grade.weakest));
  }
  head = paragraph(head, 0);
  if (row.judgement) head += reasons_of(*row.judgement);
  return row.name() + "\n" + head + "\n" + figures_in_full(row);
}

std::string table(const std::vector<SpectrumRow>& rows) {
  const bool one_size = std::all_of(rows.begin(), rows.end(), [&](const auto& row) {
    return row.figures.shape == rows.front().figures.shape;
  });
  std::size_t size_width = 0;
  if (!one_size) {
    for (const auto& row : rows) size_width = std::max(size_width, size_of(row.figures.shape).size() + 1);
  }
  std::string text = one_size ? size_of(rows.front().figures.shape) + ". " : "";
  text += "Power against white noise (1), by f in cycles/pixel; grade of 100.\n";
  const std::string head =
      fmt::format("{:<7} {:>5} {:<{}}{:>8} {:>10} {:>10} {:>9}  ", "verdict", "grade", one_size ? "" : "size",
                  size_width, "0-.0625", ".0625-.125", ".125-.1875", ".1875-.25");
  const bool channels =
      std::any_of(rows.begin(), rows.end(), [](const auto& row) { return !row.only_channel; });
  text += head + (channels ? "texture:channel\n" : "texture\n");
  for (const SpectrumRow& row : rows) {
    const auto& bands = row.figures.bands.mean;
    text += fmt::format("{:<7} {:>5} {:<{}}{:>8} {:>10} {:>10} {:>9}  {}\n", verdict_of(row),
                        row.set_aside.empty() ? score(row.grade.score) : "-",
                        one_size ? "" : size_of(row.figures.shape), size_width, number(bands[0]),
                        number(bands[1]), number(bands[2]), number(bands[3]),
                        short_name(row, kTextColumns - head.size()));
  }
  return text;
}

/// Why textures fail or are not judged, each in a paragraph.
std::string reasons_in_words(const std::vector<SpectrumRow>& rows) {
  std::string text;
  for (const SpectrumRow& row : rows) {
    if (!row.set_aside.empty()) {
      text += fmt::format("-     {}\n{}", row.name(), paragraph(row.set_aside, 6));
    } else if (row.judgement && !reasons_of(*row.judgement).empty()) {
      text += fmt::format("{:<5} {}\n{}", verdict_of(row), row.name(), reasons_of(*row.judgement));
    }
  }
  return text;
}

/// The pairs that say something new: a channel is named by the first one that it has something in common
/// with.
std::vector<const ChannelPair*> related_pairs(const SpectrumResult& result) {
  std::vector<const ChannelPair*> related;
  for (const ChannelPair& pair : result.pairs) {
    const bool known = std::any_of(related.begin(), related.end(), [&](const ChannelPair* other) {
      return other->file == pair.file && other->second == pair.second;
    });
    if (!pair.relation.empty() && !known) related.push_back(&pair);
  }
  return related;
}

/// The channels of each file against each other.
std::string pairs_in_words(const SpectrumResult& result) {
  std::string text;
  const std::vector<const ChannelPair*> related = related_pairs(result);
  for (std::size_t i = 0; i < result.pairs.size();) {
    const std::string& file = result.pairs[i].file;
    double largest = 0.0, limit = 0.0;
    bool tellable = true;
    for (; i < result.pairs.size() && result.pairs[i].file == file; ++i) {
      const CrossSpectrum& cross = result.pairs[i].cross;
      tellable &= cross.can_tell();
      largest = std::max(largest, std::abs(cross.peak_correlation));
      limit = std::max(limit, cross.limit);
    }
    std::string relations;
    for (const ChannelPair* pair : related) {
      if (pair->file == file)
        relations += paragraph(fmt::format("channel {} {}", pair->second_label, pair->relation), 6);
    }
    text += fmt::format("{:<5} {}\n", relations.empty() ? "" : result.check ? "FAIL" : "note", file);
    if (!relations.empty()) {
      text += relations;
    } else if (tellable) {
      text += paragraph(
          fmt::format("the channels are independent: correlation at most {:.3f} at any displacement "
                      "(chance: {:.3f})",
                      largest, limit),
          6);
    } else {
      text += paragraph("the channels are too small to tell whether they are independent", 6);
    }
  }
  return text;
}

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json to_json(const Grade& grade) {
  Json parts = Json::array();
  for (const GradePart& part : grade.parts) {
    parts.push_back({{"figure", part.figure},
                     {"value", finite(part.value)},
                     {"best", finite(part.best)},
                     {"ratio_db", finite(part.ratio_db)},
                     {"score", finite(part.score)}});
  }
  return {{"score", finite(grade.score)},
          {"weakest", grade.weakest.empty() ? Json(nullptr) : Json(grade.weakest)},
          {"parts", parts}};
}

void add_judgement(const SpectrumRow& row, Json& json) {
  const Judgement& judgement = *row.judgement;
  const bool independent = row.relation.empty();
  json["verdict"] = independent ? name_of(judgement.outcome) : name_of(Judgement::Outcome::failed);
  json["headline"] = judgement.headline;
  const bool untold = independent && judgement.outcome == Judgement::Outcome::cannot_tell;
  json["passed"] = untold ? Json(nullptr) : Json(independent && judgement.passed());
  json["reasons"] = judgement.reasons;
  if (!independent) json["reasons"].push_back(row.relation);
  json["failures"] = Json::array();
  for (const JudgedFigure& figure : judgement.judged) {
    if (figure.passed) continue;
    json["failures"].push_back({{"figure", figure.figure},
                                {"label", label_of(figure.figure)},
                                {"value", finite(figure.value)},
                                {"low", finite(figure.low)},
                                {"high", finite(figure.high)}});
  }
  json["not_judged"] = judgement.not_judged;
  json["findings"] = Json::array();
  for (const Finding& finding : judgement.findings) {
    json["findings"].push_back({{"cause", name_of(finding.cause)},
                                {"text", finding.text},
                                {"number", finite(finding.number)},
                                {"offset", {finding.x, finding.y, finding.z}}});
  }
}

}  // namespace

std::string SpectrumRow::name() const {
  return only_channel ? file : fmt::format("{}, channel {}", file, channel_of(*this));
}

std::string to_text(const SpectrumResult& result) {
  std::string text;
  if (result.rows.size() == 1 && result.rows.front().set_aside.empty()) {
    text += one_texture(result.rows.front());
  } else if (!result.rows.empty()) {
    text += table(result.rows);
    // What explains all channels comes before what each of them reads.
    for (const auto& [file, finding] : result.file_findings)
      text += fmt::format("FAIL  {}\n{}", file, paragraph(finding, 6));
    text += reasons_in_words(result.rows);
  }
  text += pairs_in_words(result);
  for (const auto& [file, error] : result.faults) {
    text += fmt::format("ERROR {}\n{}", file, paragraph(error.what, 6));
  }
  for (const std::string& note : result.notes) text += paragraph("note: " + note, 0);
  return text;
}

Json to_json(const SpectrumResult& result) {
  Json json{{"check", result.check ? Json(check_name(*result.check)) : Json(nullptr)},
            {"textures", Json::array()},
            {"channel_pairs", Json::array()},
            {"errors", Json::array()},
            {"notes", result.notes}};
  for (const SpectrumRow& row : result.rows) {
    Json item{{"file", row.file}, {"channel", row.channel}};
    if (!row.channel_name.empty()) item["channel_name"] = row.channel_name;
    item.update(Json::parse(bn::to_json(row.figures)));
    item["grade"] = to_json(row.grade);
    if (!row.set_aside.empty()) item["set_aside"] = row.set_aside;
    if (row.judgement) add_judgement(row, item);
    json["textures"].push_back(std::move(item));
  }
  for (const ChannelPair& pair : result.pairs) {
    const CrossSpectrum& cross = pair.cross;
    Json coherence = Json::array();
    for (const double value : cross.coherence) coherence.push_back(finite(value));
    json["channel_pairs"].push_back(
        {{"file", pair.file},
         {"channels", {pair.first, pair.second}},
         {"correlation", finite(cross.correlation)},
         {"peak_correlation", finite(cross.peak_correlation)},
         {"peak_offset", {cross.peak_x, cross.peak_y, cross.peak_z}},
         {"limit", finite(cross.limit)},
         {"coherence", coherence},
         {"independent", cross.can_tell() ? Json(cross.independent()) : Json(nullptr)},
         {"relation", pair.relation.empty() ? Json(nullptr) : Json(pair.relation)}});
  }
  for (const auto& [file, error] : result.faults) {
    json["errors"].push_back(
        {{"file", file}, {"exit_code", static_cast<int>(error.code)}, {"message", Error(error).what()}});
  }
  for (const auto& [file, finding] : result.file_findings)
    json["file_findings"].push_back(fmt::format("{}: {}", file, finding));
  return json;
}

std::vector<std::string> failures_of(const SpectrumResult& result) {
  std::vector<std::string> failures;
  if (!result.check) return failures;
  for (const auto& [file, finding] : result.file_findings)
    failures.push_back(fmt::format("{}: {}", file, finding));
  for (const SpectrumRow& row : result.rows) {
    if (!row.judgement || row.judgement->outcome != Judgement::Outcome::failed) continue;
    const std::vector<std::string>& reasons = row.judgement->reasons;
    failures.push_back(fmt::format("{}: {}", row.name(), reasons.front()));
    if (reasons.size() > 1) failures.back() += fmt::format(" (and {} more)", reasons.size() - 1);
  }
  for (const ChannelPair* pair : related_pairs(result)) {
    failures.push_back(fmt::format("{}: channel {} {}", pair->file, pair->second_label, pair->relation));
  }
  return failures;
}

}  // namespace bn::tools
