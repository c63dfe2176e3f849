// What may go wrong with one file must not touch the others, so each is read and analysed before anything of
// it is added to the result.

#include "tools/spectrum_analyst.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bn/error.h"
#include "bn/report.h"
#include "tools/channel.h"

namespace bn::tools {

/// The channels of one picture, or of a volume.
struct StackedTexture {
  std::string name;
  Shape shape;
  std::vector<ChannelSamples> channels;
  std::vector<std::string> channel_names;
  Check natural_check;

  std::string label(int channel) const { return channel_label(channel, channel_names); }
};

namespace {

constexpr std::size_t kPrintValues = 4096;

/// Whether a file of ours is something else than a texture to be judged.
bool is_no_texture(const Volume& volume) {
  if (!volume.metadata) return false;
  const std::string& kind = volume.metadata->kind;
  return kind.starts_with("retarget") || kind == "contact-sheet" || kind == "spectrum";
}

}  // namespace

/// Nothing for a file in a folder that is no mask.
std::optional<StackedTexture> SpectrumAnalyst::read_texture(const SpectrumInput& input) {
  const Volume volume = read_volume(input.paths, {}, session_.execution);
  if (input.found && is_no_texture(volume)) return std::nullopt;
  if (volume.metadata && volume.metadata->kind == "spatiotemporal-mask" && volume.image.depth == 1)
    ++single_slices_;
  StackedTexture texture{.name = input.paths.front().string(),
                         .shape = volume.image.shape(),
                         .channels = {},
                         .channel_names = volume.channel_names,
                         .natural_check = natural_check(volume.image.shape(), volume.metadata)};
  if (texture.shape.depth > 1) texture.name += fmt::format(" ({} slices)", texture.shape.depth);
  for (int c = 0; c < volume.image.channels; ++c)
    texture.channels.push_back(samples_of_channel(volume.image, c));
  result_.notes.insert(result_.notes.end(), volume.notes.begin(), volume.notes.end());
  return texture;
}

void SpectrumAnalyst::look_at(const SpectrumInput& input) {
  try {
    const std::optional<StackedTexture> texture = read_texture(input);
    if (!texture) return void(++passed_over_);
    look_at(*texture);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::cancelled) throw;
    result_.faults.push_back({input.paths.front().string(), error.info()});
  }
}

void SpectrumAnalyst::finish() {
  if (single_slices_ > 1) {
    result_.notes.push_back(
        fmt::format("{} files say that they are slices; --volume judges them as one volume, in time too",
                    single_slices_));
  }
  if (passed_over_ > 0) {
    result_.notes.push_back(fmt::format(
        "{} file{} in the folders {} no mask and {} passed over", passed_over_, passed_over_ == 1 ? "" : "s",
        passed_over_ == 1 ? "is" : "are", passed_over_ == 1 ? "was" : "were"));
  }
  if (failed_ > 0 && prints_.size() > 1) {
    result_.notes.push_back(
        fmt::format("the average leaves out {} that fail{}", failed_, failed_ == 1 ? "s" : ""));
  }
  if (!one_size_ && prints_.size() > 1) {
    result_.notes.push_back("the textures differ in size, so there is no average");
  } else if (average_ && average_->textures > 1) {
    SpectrumRow row;
    row.file = "average";
    row.figures = figures_of_merit(*average_, worst_deviation_);
    row.figures.distribution = settings_.distribution;
    row.figures.distribution_distance = worst_distance_;
    judge(row, {{}, row.figures.shape, 0.0, 1.0}, {{}, row.figures});
    result_.rows.push_back(std::move(row));
  }
}

void SpectrumAnalyst::look_at(const StackedTexture& texture) {
  const auto count = static_cast<int>(texture.channels.size());
  natural_check_ = texture.natural_check;
  if (settings_.check == Check::stbn && texture.shape.depth == 1) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = "one picture, and stbn judges the slices of a volume",
                 .where = texture.name,
                 .limit = "two slices and more",
                 .remedy = "name a folder or all slices and add --volume, or use --check blue"});
  }
  std::vector<Samples> samples;
  for (const ChannelSamples& channel : texture.channels) {
    samples.push_back(
        {channel.value, texture.shape, channel.low, std::max(channel.high, channel.low + 1e-300)});
  }
  const std::vector<int> wanted = channels_to_judge(texture);
  // Analysed before anything is added: a file with a fault leaves no row.
  std::vector<Analysis> analyses;
  for (const int c : wanted) {
    const Samples& s = samples[static_cast<std::size_t>(c)];
    try {
      analyses.push_back(
          analyse(s.values, s.shape, s.low, s.high, session_.execution, settings_.distribution));
    } catch (const Error& error) {
      ErrorInfo info = error.info();
      info.where = texture.name;
      throw Error(std::move(info));
    }
  }
  bool failed = false;
  std::vector<int> judged;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const int c = wanted[i];
    const Samples& s = samples[static_cast<std::size_t>(c)];
    SpectrumRow row;
    row.file = texture.name;
    row.channel = c;
    if (!texture.channel_names.empty()) row.channel_name = texture.label(c);
    row.only_channel = count == 1;
    row.figures = analyses[i].figures;
    row.set_aside = aside_of(texture, c);
    if (row.set_aside.empty()) {
      judge(row, s, analyses[i]);
      failed |= row.judgement && !row.judgement->passed();
      bool again = false;
      for (const int other : judged) {
        again |= is_again(texture, samples, other, c);
        if (row.relation.empty() && !result_.pairs.empty() && result_.pairs.back().second == c) {
          row.relation = result_.pairs.back().relation;
        }
      }
      judged.push_back(c);
      if (row.judgement && row.judgement->outcome == Judgement::Outcome::failed) {
        ++failed_;  // what is broken says nothing of the others
      } else if (!again) {
        take_into_average(row.name(), s, analyses[i]);
      }
    }
    result_.rows.push_back(std::move(row));
  }
  if (failed && settings_.channel == "all") {
    for (const Finding& finding : diagnose_alpha(samples)) {
      result_.file_findings.push_back({texture.name, finding.text});
    }
  }
}

void SpectrumAnalyst::judge(SpectrumRow& row, const Samples& samples, const Analysis& analysis) {
  if (settings_.check) {
    row.judgement = judge_texture(samples, analysis, *settings_.check, session_.execution);
    row.grade = row.judgement->grade;
  } else {
    row.grade = grade(row.figures, natural_check_);
  }
}

/// Grey that is stored as colour is one texture.
std::vector<int> SpectrumAnalyst::channels_to_judge(const StackedTexture& texture) {
  const auto& channels = texture.channels;
  if (settings_.channel != "all") {
    return {find_channel(settings_.channel, static_cast<int>(channels.size()), texture.channel_names,
                         texture.name)};
  }
  std::vector<int> wanted;
  const bool grey = channels.size() >= 3 && channels[1].value == channels[0].value &&
                    channels[2].value == channels[0].value &&
                    (channels.size() != 4 || channels[3].value != channels[0].value);
  for (int c = 0; c < std::ssize(channels); ++c) {
    if (!grey || c == 0 || c > 2) wanted.push_back(c);
  }
  if (grey) {
    result_.notes.push_back(
        fmt::format("{}: channels 0, 1 and 2 are equal, grey stored as colour; judged once", texture.name));
  }
  return wanted;
}

std::string SpectrumAnalyst::aside_of(const StackedTexture& texture, int c) const {
  const std::size_t count = texture.channels.size();
  if (settings_.channel != "all" || count == 1) return {};
  const auto constant = [](const ChannelSamples& channel) {
    return std::all_of(channel.value.begin(), channel.value.end(),
                       [&](double value) { return value == channel.value.front(); });
  };
  const ChannelSamples& channel = texture.channels[static_cast<std::size_t>(c)];
  if (!constant(channel) || std::all_of(texture.channels.begin(), texture.channels.end(), constant))
    return {};
  const double value = channel.value.front();
  const bool opaque = (count == 2 || count == 4) && c + 1 == static_cast<int>(count) &&
                      value == (channel.high > 2.0 ? channel.high - 1.0 : 1.0);
  return opaque ? "not judged: it is constant, an opaque alpha channel"
                : fmt::format("not judged: it is constant, every value is {:.6g}", value);
}

/// Compares two channels; whether the second is the first, wherever it stands.
bool SpectrumAnalyst::is_again(const StackedTexture& texture, const std::vector<Samples>& samples, int a,
                               int b) {
  const CrossSpectrum cross =
      cross_spectrum(samples[static_cast<std::size_t>(a)].values, samples[static_cast<std::size_t>(b)].values,
                     texture.shape, session_.execution);
  if (std::isnan(cross.correlation)) return false;  // a constant one has failed already
  result_.pairs.push_back({texture.name, a, b, texture.label(b), cross,
                           relation_of(cross, fmt::format("channel {}", texture.label(a)))});
  return !result_.pairs.back().relation.empty() && std::abs(cross.peak_correlation) > 0.9;
}

/// Once for each texture, in whatever encodings and places it comes.
void SpectrumAnalyst::take_into_average(const std::string& name, const Samples& samples,
                                        const Analysis& analysis) {
  if (const std::string twin = known_as(name, samples); !twin.empty()) {
    result_.notes.push_back(
        fmt::format("{} is the same texture as {}: no independent sample, so counted once", name, twin));
    return;
  }
  worst_deviation_ = std::max(worst_deviation_, analysis.figures.histogram_max_deviation);
  if (settings_.distribution != Distribution::uniform) {
    worst_distance_ = std::isnan(worst_distance_)
                          ? analysis.figures.distribution_distance
                          : std::max(worst_distance_, analysis.figures.distribution_distance);
  }
  if (!average_) {
    average_ = analysis.power;
  } else if (one_size_ && average_->shape == analysis.power.shape) {
    accumulate(*average_, analysis.power);
  } else {
    one_size_ = false;
  }
}

/// The name of an earlier texture whose ranks are these but for rounding, or "".
std::string SpectrumAnalyst::known_as(const std::string& name, const Samples& samples) {
  Print print{name, samples.shape, {}};
  const std::vector<double> rank = midranks(samples.values, session_.execution);
  const std::size_t every = std::max<std::size_t>(1, rank.size() / kPrintValues);
  double mean = 0.0, square = 0.0;
  for (std::size_t i = 0; i < rank.size(); i += every) print.rank.push_back(rank[i]);
  for (const double r : print.rank) mean += r / static_cast<double>(print.rank.size());
  for (double& r : print.rank) r -= mean, square += r * r;
  for (double& r : print.rank) r /= std::sqrt(std::max(square, 1e-300));
  for (const Print& other : prints_) {
    if (other.shape != print.shape) continue;
    double correlation = 0.0;
    for (std::size_t i = 0; i < print.rank.size(); ++i) correlation += print.rank[i] * other.rank[i];
    if (correlation > 0.98) return other.name;
  }
  prints_.push_back(std::move(print));
  return {};
}

}  // namespace bn::tools
