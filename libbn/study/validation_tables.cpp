// The study's numbers as text: CSV for programs, Markdown for people.

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "render/camera.h"
#include "study/validation.h"

namespace bn::study {
namespace {

std::string known(double value) { return value < 0.0 ? "" : fmt::format("{:.6g}", value); }

int first_counted(int frames) { return (frames + 1) / 2; }

}  // namespace

std::string errors_csv(const std::vector<SceneResult>& results) {
  std::string text = "scene,variant,frame,region";
  for (const double blur : kBlurs_px) text += blur == 0.0 ? ",rmse" : fmt::format(",rmse_blur_{}", blur);
  text += ",power_to_0.1,reference_power_to_0.1";
  for (std::size_t i = 0; i < kBandEdges.size(); ++i)
    text += fmt::format(",power_{}_{}", i == 0 ? 0.0 : kBandEdges[i - 1], kBandEdges[i]);
  text += ",flicker,rmse_running_average,rmse_exponential_average,rmse_exponential_average_blur_1.5\n";
  for (const SceneResult& result : results) {
    for (const Sequence& sequence : result.sequences) {
      for (const auto& [key, m] : sequence.measures) {
        text += fmt::format("{},{},{},{}", result.scene.name, sequence.variant.name, key.first,
                            result.regions[key.second].name);
        for (const double rms : m.rms) text += fmt::format(",{:.6g}", rms);
        text += fmt::format(",{:.6g},{:.6g}", m.low_frequency, m.reference_low_frequency);
        for (const double power : m.bands) text += fmt::format(",{:.6g}", power);
        text += fmt::format(",{},{},{},{}\n", known(m.flicker), known(m.running), known(m.exponential),
                            known(m.exponential_blurred));
      }
    }
  }
  return text;
}

std::string radial_csv(const std::vector<SceneResult>& results) {
  std::string text = "scene,variant,frame,region,frequency,power\n";
  for (const SceneResult& result : results) {
    for (const Sequence& sequence : result.sequences) {
      for (const auto& [key, m] : sequence.measures) {
        for (std::size_t i = 0; i < m.radial.power.size(); ++i) {
          if (std::isnan(m.radial.power[i])) continue;
          text +=
              fmt::format("{},{},{},{},{:.5f},{:.5g}\n", result.scene.name, sequence.variant.name, key.first,
                          result.regions[key.second].name, m.radial.frequency[i], m.radial.power[i]);
        }
      }
    }
  }
  return text;
}

std::string passes_csv(const std::vector<SceneResult>& results) {
  std::string text = "scene,variant,pass,milliseconds,percent_of_frame,bytes\n";
  for (const SceneResult& result : results) {
    for (const Sequence& sequence : result.sequences) {
      double sum = 0.0;
      for (const PassTime& time : sequence.passes) sum += time.milliseconds;
      for (const PassTime& time : sequence.passes) {
        text +=
            fmt::format("{},{},{},{:.4f},{:.3f},{}\n", result.scene.name, sequence.variant.name, time.pass,
                        time.milliseconds, 100.0 * time.milliseconds / std::max(sum, 1e-9), time.bytes);
      }
    }
  }
  return text;
}

std::string summary_csv(const std::vector<SceneResult>& results) {
  std::string text = "scene,variant,region,db_against_white\n";
  for (const SceneResult& result : results) {
    for (const Sequence& sequence : result.sequences) {
      for (std::size_t r = 0; r < result.regions.size(); ++r) {
        const auto db = result.against_white(sequence, r, first_counted(result.frames));
        if (!db) continue;
        text += fmt::format("{},{},{},{:.2f}\n", result.scene.name, sequence.variant.name,
                            result.regions[r].name, *db);
      }
    }
  }
  return text;
}

std::string study_json(const std::vector<SceneResult>& results, const StudyOptions& options,
                       const std::string& device) {
  nlohmann::ordered_json json{{"size", {options.screen.width, options.screen.height}},
                              {"bounces", options.bounces},
                              {"frames", options.frames},
                              {"first_counted", first_counted(options.frames)},
                              {"block", options.block},
                              {"jitter", options.jitter},
                              {"sort_by_light", options.sort_by_light},
                              {"seed", options.seed},
                              {"reference_paths", options.reference_samples},
                              {"device", device},
                              {"scenes", nlohmann::json::array()}};
  for (const SceneResult& result : results) {
    bool moves = false;
    for (int frame = 1; frame <= options.frames; ++frame) moves |= !render::same_view(result.scene, frame, 0);
    json["scenes"].push_back({{"name", result.scene.name},
                              {"about", result.scene.about},
                              {"moves", moves},
                              {"reference_rmse", result.reference_rms}});
  }
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string report_md(const std::vector<SceneResult>& results, const StudyOptions& options,
                      const std::string& device) {
  std::string text = fmt::format(
      "# Validation\n\n{}x{} pixels, 1 path a pixel, {} bounces, {} frames, sort blocks of {}{}{}, on {}.\n\n"
      "Region columns: error at 0 < f <= {} cycles per pixel against white noise, dB, over frames {}..{}, "
      "the\n"
      "converged picture's own error taken off, as everywhere. The rest is of the whole picture at the last "
      "frame:\nRMSE, RMSE after a blur of 1.5 pixels, change of the blurred error from frame to frame along "
      "the motion, RMSE of\nthe exponential average (0.1), and of that after the blur.\n",
      options.screen.width, options.screen.height, options.bounces, options.frames + 1, options.block,
      options.jitter ? ", jittered" : "", options.sort_by_light ? ", sorted by light" : "", device,
      kLowFrequency, first_counted(options.frames), options.frames);
  for (const SceneResult& result : results) {
    text +=
        fmt::format("\n## {}\n\nConverged pictures: {} paths a pixel, own RMS error {:.4g}.\n\n| variant |",
                    result.scene.name, options.reference_samples, result.reference_rms);
    for (const Region& region : result.regions) text += fmt::format(" {} |", region.name);
    text += " RMSE | blurred | flicker | averaged | averaged and blurred |\n|---|";
    for (std::size_t i = 0; i < result.regions.size() + 5; ++i) text += "---|";
    text += "\n";
    for (const Sequence& sequence : result.sequences) {
      text += fmt::format("| {} |", sequence.variant.name);
      for (std::size_t r = 0; r < result.regions.size(); ++r) {
        const auto db = result.against_white(sequence, r, first_counted(result.frames));
        text += db ? fmt::format(" {:.1f} |", *db) : " |";
      }
      const Measure& m = sequence.measures.at({result.frames, 0});
      text += fmt::format(" {:.4f} | {:.4f} | {} | {} | {} |\n", m.rms[kNoBlur], m.rms[kShownBlur],
                          known(m.flicker), known(m.exponential), known(m.exponential_blurred));
    }
    text += "\n| variant | pass | ms | share | KiB |\n|---|---|---|---|---|\n";
    for (const Sequence& sequence : result.sequences) {
      double sum = 0.0;
      for (const PassTime& time : sequence.passes) sum += time.milliseconds;
      for (const PassTime& time : sequence.passes) {
        if (sequence.variant.name != name_of(Method::reproject)) continue;  // it has every pass
        text += fmt::format("| {} | {} | {:.2f} | {:.1f} % | {} |\n", sequence.variant.name, time.pass,
                            time.milliseconds, 100.0 * time.milliseconds / sum, time.bytes / 1024);
      }
    }
  }
  return text;
}

}  // namespace bn::study
