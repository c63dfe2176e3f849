// The options of [[retarget]] and of its outputs, and which of them fit together.

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "bake/kinds/alike.h"
#include "bake/kinds/retarget_source.h"
#include "bake/paths.h"
#include "bn/error.h"
#include "bn/kinds.h"

namespace bn {

using namespace baking;

namespace {

constexpr int kMaxStep = 1 << 24;  // far above any tile's side; keeps every product within 64 bits
constexpr std::int64_t kMany = std::numeric_limits<std::int64_t>::max();
constexpr double kAny = std::numeric_limits<double>::infinity();

/// The options that only annealing has. `when` says whether the entry anneals.
void declare_annealing(Options& options, RetargetEntry& entry) {
  AnnealMethod& method = entry.anneal;
  AnnealOptions& run = method.options;
  ScheduleParameters& parameters = run.parameters;
  const std::size_t first = options.list().size();
  constexpr std::size_t kMaxChannels = 16;
  options
      .integers("channels", method.channels, 0, 63, kMaxChannels,
                "Channels of the image; the energy is the weighted sum over them.")
      .without("channel")
      .if_unset("`channel` alone");
  options
      .integers("weights", method.weights, 1, 1000, kMaxChannels,
                "One for each channel, of its differences in levels.")
      .if_unset("1 each");
  options
      .real("residual_sigma", method.residual_sigma_px, 0.0, 8.0,
            "0, or 0.3 and above: minimise what a Gaussian blur of this width leaves of the difference; "
            "needs metric l2.")
      .in("pixels");
  std::vector<std::string> schedules;
  for (const auto schedule : schedule_names()) schedules.emplace_back(schedule);
  options.word(
      "schedule", std::move(schedules), "How annealing cools.", [&run] { return Value(run.schedule); },
      [&run](const Value& given) { run.schedule = std::get<std::string>(given); });
  Option& factor =
      options.real("factor", parameters.factor, 0.0, 1.0,
                   "The factor a of exponential and inverse (a proposal) or of kirkpatrick (a stage; below "
                   "1), in place of one that meets the end temperature.");
  factor.above_least = true;
  options.real("slope", parameters.slope, 0.0, kAny,
               "Of linear: the fall of the temperature with each proposal.");
  options.real("hajek_c", parameters.hajek_c, 0.0, kAny, "The constant c of hajek.").above_least = true;
  options
      .integer("stages", parameters.stages, 1, 1'000'000,
               "Of kirkpatrick: so many stages share the proposals.")
      .if_unset("100");
  options
      .integer("accepted_per_stage", parameters.accepted_per_stage, 1, kMany,
               "Of kirkpatrick: a stage ends after so many accepted swaps.")
      .if_unset("0.2 % of a stage");
  options
      .integer("tried_per_stage", parameters.tried_per_stage, 1, kMany,
               "Of kirkpatrick: or after so many proposals.")
      .if_unset("proposals / stages");
  options
      .integer("frozen_stages", parameters.frozen_stages, 1, 1'000'000,
               "Of kirkpatrick: the run ends after so many stages in a row without a change.")
      .if_unset("3");
  options
      .integer("proposals", run.proposals, 1, std::int64_t{1} << 62,
               "Budget of each tile and chain, in proposals of a swap.")
      .formerly("budget");
  options.seed("seed", run.seed, "Of the random numbers.");
  using Rule = StartTemperature::Rule;
  constexpr double kHottest = 1e15;
  options.number(
      "start_temperature", 0.0, kHottest, "Where the temperature starts; 0: automatic.",
      [&run] { return Value(run.start.rule == Rule::given ? run.start.value : 0.0); },
      [&run](const Value& given) {
        const double value = std::get<double>(given);
        if (value > 0.0) run.start = {Rule::given, value};
      });
  options
      .number(
          "initial_acceptance", 0.0, 1.0,
          "In place of a start temperature: the share of worsening swaps that is accepted at the start, at "
          "least "
          "0.001; 1 accepts everything; 0: automatic.",
          [&run] {
            return Value(run.start.rule == Rule::everything   ? 1.0
                         : run.start.rule == Rule::acceptance ? run.start.value
                                                              : 0.0);
          },
          [&run](const Value& given) {
            const double value = std::get<double>(given);
            if (value > 0.0) run.start = {value == 1.0 ? Rule::everything : Rule::acceptance, value};
          })
      .without("start_temperature");
  options.real("end_temperature", run.end_temperature, 0.0, kHottest,
               "Where the temperature ends; 0: automatic.");
  options.integer("chains", run.chains.count, 1, 256, "Chains to run; with tempering at least 2.");
  options.choice<ChainOptions::Coupling>(
      "coupling", run.chains.coupling,
      {{"independent", ChainOptions::Coupling::independent},
       {"tempering", ChainOptions::Coupling::tempering}},
      "Of several chains: keep the best of them, or temper between start and end temperature.");
  options
      .integer(
          "swap_distance", run.swap_distance_px, 0, 64,
          "Farthest apart, per axis, of two swapped seeds, at most twice the radius; 0: 5/3 of the radius.")
      .in("pixels");
  options
      .integer("stop_after", run.stop_after, 0, std::int64_t{1} << 62,
               "Above 0: end after so many proposals, cooled as for all of them; makes a stopped run again.")
      .from_edition(2);
  for (std::size_t i = first; i < options.list().size(); ++i)
    options.list()[i].only_if([&entry] { return entry.anneals; }, "method = \"anneal\"");
}

}  // namespace

Options RetargetEntry::options() {
  Options options;
  const auto reads_image = [this] { return !image.empty(); };
  options.text("image", image, "The source: an image file.").naming_file();
  options.integer("channel", channel, 0, 63, "The channel of the image, 0 for red.")
      .only_if([this] { return !image.empty() && !(anneals && !anneal.channels.empty()); },
               "image = \"path\", and without channels");
  options.text("mask", mask, "The source: the name of a [[mask]] or [[spatiotemporal]].")
      .naming_entry({"mask", "spatiotemporal"})
      .only_in_recipes();
  options
      .text("to", to,
            "The mask of the next frame, where it is not the source moved by the step: an image file.")
      .naming_file()
      .from_edition(2)
      .only_if(reads_image, "image = \"path\"");
  options.text("to_mask", to_mask, "The same: the name of a [[mask]] or [[spatiotemporal]].")
      .naming_entry({"mask", "spatiotemporal"})
      .only_in_recipes()
      .from_edition(2)
      .only_if([this] { return !mask.empty(); }, "mask = \"name\"");
  options
      .choice<SampleType>(
          "levels", levels, sample_types(),
          "The samples of the mask that the renderer reads; the mask must have an output of them.")
      .only_in_recipes()
      .only_if([this] { return image.empty(); }, "mask = \"name\"");
  options
      .offset(
          "step", step, -kMaxStep, kMaxStep, "auto",
          "How far the mask moves from frame to frame; auto picks a step with a long orbit, and 0,0 between "
          "two masks or slices.")
      .in("pixels");
  options.integer("radius", problem.radius, 1, 32, "The farthest that a seed may move.").in("pixels");
  options.choice<Reach>("reach", problem.reach,
                        {{"chebyshev", Reach::chebyshev}, {"euclidean", Reach::euclidean}},
                        "How that distance is measured: in a square or in a disc.");
  options.choice<Metric>("metric", problem.metric, {{"l1", Metric::l1}, {"l2", Metric::l2}},
                         "Cost of a difference of levels: its size or its square.");
  options.boolean("wrap", problem.wrap,
                  "Whether seeds may cross the tile's border; false for a tile used alone.");
  options
      .integer("motion", motion, 0, 8,
               "Range of motions in x and y: 0 makes one tile, 4 the 81 of a 9x9 atlas.")
      .in("pixels");
  options
      .choice<bool>("method", anneals, {{"exact", false}, {"anneal", true}},
                    "The proven optimum, or simulated annealing.")
      .from_edition(2);
  declare_annealing(options, *this);
  options.boolean("volume", volume, "Whether the slices are one volume, whose seeds move between slices too.")
      .from_edition(2)
      .only_if([this] { return anneals; }, "method = \"anneal\"");
  options
      .integer("step_z", step_z, -kMaxStep, kMaxStep, "How far the volume moves along z from frame to frame.")
      .in("slices")
      .from_edition(2)
      .only_if([this] { return anneals && volume; }, "method = \"anneal\" and volume = true");
  Option& gap =
      options.real("gap", problem.gap, 0.0, 1.0,
                   "Stop when the energy is proven to be within this share of the optimum; 0: prove it.");
  gap.percent = true;
  gap.only_if([this] { return !anneals; }, "method = \"exact\"");
  // Annealing's channels are the image's.
  Option* channels = options.find("channels");
  channels->only_if([this, reads_image] { return anneals && reads_image(); },
                    "method = \"anneal\" and image = \"path\"");
  return options;
}

void RetargetEntry::check(const Complain& complain) const {
  if (mask.empty() == image.empty()) {
    complain(image.empty() ? "mask" : "image", image.empty() ? "is missing" : "stands beside a mask",
             "either mask = \"name\" or image = \"path\"", "");
  }
  if (!anneals) return;
  if (volume && anneal.residual_sigma_px > 0.0)
    complain("residual_sigma", "is of flat tiles", "0 with volume = true", "");
  if (volume && motion > 0) complain("motion", fmt::format("is {}", motion), "0 with volume = true", "");
  const AnnealOptions& run = anneal.options;
  if (run.start.rule == StartTemperature::Rule::given && run.end_temperature > run.start.value) {
    complain("end_temperature", fmt::format("is {}, above the start", run.end_temperature),
             fmt::format("at most {}", run.start.value), "");
  }
  if (run.swap_distance_px > 2 * problem.radius) {
    complain("swap_distance", fmt::format("is {}", run.swap_distance_px),
             fmt::format("0..{}, twice the radius", 2 * problem.radius), "");
  }
  const std::size_t count = std::max<std::size_t>(1, anneal.channels.size());
  if (!anneal.weights.empty() && anneal.weights.size() != count) {
    complain("weights", fmt::format("has {} elements", anneal.weights.size()),
             fmt::format("{}, one for each channel", count), "");
  }
  // 0 is no filter; what is above has a range of its own.
  if (anneal.residual_sigma_px > 0.0 && anneal.residual_sigma_px < 0.3) {
    complain("residual_sigma", fmt::format("is {}", anneal.residual_sigma_px), "0, or 0.3..8 pixels", "");
  }
  if (anneal.residual_sigma_px > 0.0 && problem.metric != Metric::l2) {
    complain("residual_sigma", "needs the squares of differences", "only with metric = \"l2\"", "");
  }
  // The library says what else is wrong, in the words of recipes.
  try {
    check_anneal_options(run);
  } catch (const Error& error) {
    complain_of(error.info(), complain);
  }
}

void RetargetEntry::default_output(std::size_t output) {
  outputs.at(output).kind = motion > 0 ? RetargetOutput::Kind::atlas : RetargetOutput::Kind::tile;
  outputs.at(output).type.reset();
}

Options RetargetEntry::output_options(std::size_t output) {
  RetargetOutput& file = outputs.at(output);
  Options options;
  options
      .choice<RetargetOutput::Kind>(
          "kind", file.kind, {{"tile", RetargetOutput::Kind::tile}, {"atlas", RetargetOutput::Kind::atlas}},
          "One tile, or the tiles of all motions in one image.")
      .if_unset("\"atlas\" if `motion` > 0, else \"tile\"")
      .only_in_recipes();
  options.choice<MoveForm>("form", file.form, {{"scatter", MoveForm::scatter}, {"gather", MoveForm::gather}},
                           "What a pixel says: where its seed goes, or where its seed comes from.");
  options
      .word(
          "type", {"8bit", "half", "float"},
          "What the samples of the file are: 8bit holds x + 128 and y + 128, the others x and y.",
          [this, output] { return Value(std::string(name_of(output_type(output)))); },
          [&file](const Value& given) {
            const std::string& word = std::get<std::string>(given);
            file.type = word == "half" ? SampleType::f16 : word == "float" ? SampleType::f32 : SampleType::u8;
          })
      .if_unset("float for .exr, else 8bit")
      .from_edition(2);
  options.offset("motion", file.motion, -motion, motion, "Of a tile: its motion.")
      .only_in_recipes()
      .only_if([&file] { return file.kind == RetargetOutput::Kind::tile; }, "kind = \"tile\"");
  return options;
}

SampleType RetargetEntry::output_type(std::size_t output) const {
  return outputs.at(output).type.value_or(natural_type(path_of(output)));
}

}  // namespace bn
