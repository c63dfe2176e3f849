// Spectra and figures as others read them: JSON, CSV, pictures.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bn/error.h"
#include "bn/spectrum.h"
#include "spectrum/transform.h"

namespace bn {
using namespace spectrum;
namespace {

std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

template <class Values>
std::string array(const Values& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + number(value);
  return "[" + text + "]";
}

std::string cell(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

void append_curve(const PowerSpectrum& power, std::string_view axis, std::string& text) {
  const RadialCurve curve = radial_power(power);
  for (std::size_t j = 0; j < curve.power.size(); ++j) {
    text += fmt::format("{},{},{},{},{}\n", axis, curve.frequency[j], cell(curve.power[j]),
                        cell(curve.anisotropy_db[j]), curve.count[j]);
  }
}

}  // namespace

std::string to_json(const FiguresOfMerit& figures) {
  std::string text = fmt::format(
      "{{\"size\": [{}, {}], \"depth\": {}, \"textures\": {}, \"bands\": {}, \"peak\": {}, "
      "\"peak_frequency\": {}, \"anisotropy_db_mean\": {}, \"anisotropy_db_max\": {}, "
      "\"gauss_residual_db\": {}, \"histogram_max_deviation\": {}, \"distribution\": \"{}\"",
      figures.shape.width, figures.shape.height, figures.shape.depth, figures.textures,
      array(figures.bands.mean), number(figures.peak), number(figures.peak_frequency),
      number(figures.anisotropy_db_mean), number(figures.anisotropy_db_max), array(figures.gauss_residual_db),
      number(figures.histogram_max_deviation), name_of(figures.distribution));
  if (figures.distribution != Distribution::uniform) {
    text += fmt::format(", \"distribution_distance\": {}", number(figures.distribution_distance));
  }
  if (figures.shape.depth > 1) {
    text +=
        fmt::format(", \"temporal_power_at_0\": {}, \"temporal_power_low\": {}, \"filtered_residual_db\": {}",
                    number(figures.temporal_power_at_0), number(figures.temporal_power_low),
                    number(figures.filtered_residual_db));
  }
  return text + "}";
}

std::string curves_csv(const PowerSpectrum& power) {
  std::string text = "axis,frequency,power,anisotropy_db,count\n";
  if (power.shape.depth == 1) {
    append_curve(power, "space", text);
  } else {
    append_curve(project(power, Projection::xy), "space", text);
    append_curve(project(power, Projection::z), "time", text);
  }
  return text;
}

Grid<std::uint8_t> log_picture(const PowerSpectrum& power, double low_db, double high_db) {
  if (!(low_db < high_db)) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = fmt::format("{} to {} dB", low_db, high_db),
                 .where = "spectrum picture",
                 .limit = "an upper end above the lower",
                 .remedy = ""});
  }
  const Grid<double> plane = centred_power(power);
  Grid<std::uint8_t> picture(plane.size());
  for (std::size_t i = 0; i < plane.count(); ++i) {
    const double level = (10.0 * std::log10(std::max(plane[i], 1e-300)) - low_db) / (high_db - low_db);
    picture[i] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(level, 0.0, 1.0)));
  }
  return picture;
}

}  // namespace bn
