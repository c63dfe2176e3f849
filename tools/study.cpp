// bn study: the measurements behind the documentation.

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "bn_study/fft.h"
#include "tools/verb.h"

namespace bn::tools {
namespace {

using Json = nlohmann::ordered_json;

std::string markdown(const std::vector<FftStudyRow>& rows) {
  std::string text = "| side | transform | type | ms | relative error |\n|---:|---|---|---:|---:|\n";
  for (const auto& row : rows) {
    text += fmt::format("| {} | {} | {} | {:.3g} | {:.2g} |\n", row.side, row.method, row.type,
                        row.seconds * 1e3, row.relative_error);
  }
  return text;
}

}  // namespace

Verb study_fft_verb() {
  const auto json = std::make_shared<bool>(false);
  Verb verb;
  verb.name = "study fft";
  verb.summary = "Measure speed against error of the Fourier transforms.";
  verb.examples = {{"bn study fft", "the table of docs/spectrum.md, about a minute"}};
  verb.details =
      "Transforms pictures of white noise on one thread, in float and double, by bn and by OpenImageIO, and "
      "holds the "
      "results against sums in long double. Times are processor time, the median of repeated runs; errors "
      "are root "
      "mean square, relative to the spectrum's. 1021 is a prime.";
  verb.arguments.flag("--json", *json, true, "Print JSON.");
  verb.run = [json](Session& session) {
    const auto rows = study_fft({64, 256, 1000, 1021, 1024, 4096}, session.execution_showing("transforms"));
    session.progress.finish();
    if (!*json) return session.output.tell(markdown(rows));
    Json result = Json::array();
    for (const auto& row : rows) {
      result.push_back({{"side", row.side},
                        {"method", row.method},
                        {"type", row.type},
                        {"seconds", row.seconds},
                        {"relative_error", row.relative_error}});
    }
    session.output.write_result(result, true);
  };
  return verb;
}

}  // namespace bn::tools
