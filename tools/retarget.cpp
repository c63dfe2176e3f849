// bn retarget: the retarget tiles of one image, with their proofs.

#include <fmt/format.h>

#include <algorithm>

#include "tools/records.h"
#include "tools/verb.h"

namespace bn::tools {
namespace {

struct Settings {
  RetargetEntry entry;
  std::filesystem::path image;
  MoveForm form = MoveForm::scatter;
  std::filesystem::path out;
  bool json = false;
};

/// The energies as the atlas has them: one row a motion in y.
std::string energy_table(const std::vector<TileRecord>& tiles, int range) {
  std::size_t width = 0;
  for (const auto& tile : tiles) width = std::max(width, std::to_string(tile.energy).size() + 2);
  std::string text = fmt::format("\nenergy by motion, x {}..{} to the right, y downwards\n", -range, range);
  std::size_t index = 0;
  for (int y = -range; y <= range; ++y) {
    for (int x = -range; x <= range; ++x) text += fmt::format("{:>{}}", tiles[index++].energy, width);
    text += '\n';
  }
  return text;
}

void run(Settings& settings, Session& session) {
  RetargetEntry& entry = settings.entry;
  entry.name = "retarget";
  entry.image = settings.image.string();
  if (!settings.out.empty()) {
    entry.outputs = {{.path = settings.out.string(),
                      .kind = entry.motion > 0 ? RetargetOutput::Kind::atlas : RetargetOutput::Kind::tile,
                      .form = settings.form,
                      .motion = {0, 0}}};
  }
  const JobRecord job = make_retarget(entry, session.execution_showing("retarget"));
  session.progress.finish();
  for (const auto& note : job.notes) session.progress.note(note);

  Json result{{"source", entry.image},
              {"channel", entry.channel},
              {"step", to_json(job.step.value())},
              {"orbit_length", job.orbit_length.value()},
              {"radius", entry.options.radius},
              {"reach", name_of(entry.options.reach)},
              {"metric", name_of(entry.options.metric)},
              {"wrap", entry.options.wrap},
              {"motion", entry.motion}};
  // The plain tile, motion (0, 0), stands in the middle of its set.
  const TileRecord& plain = job.tiles.at(job.tiles.size() / 2);
  bool all_optimal = true;
  for (const auto& tile : job.tiles) all_optimal = all_optimal && tile.energy == tile.lower_bound;
  result["start_energy"] = plain.start_energy;
  result["energy"] = plain.energy;
  result["lower_bound"] = plain.lower_bound;
  result["optimal"] = all_optimal;
  result["seconds"] = rounded_seconds(job.seconds);
  if (!job.files.empty()) {
    result["file"] = job.files.front().path;
    result["form"] = name_of(settings.form);
    result["pixel_hash"] = job.files.front().pixel_hash;
  }
  if (settings.json && entry.motion > 0) {
    for (const auto& tile : job.tiles) result["tiles"].push_back(to_json(tile));
  }
  session.output.write_result(result, settings.json);
  if (!settings.json && entry.motion > 0) session.output.write(energy_table(job.tiles, entry.motion));
}

}  // namespace

Verb retarget_verb() {
  const auto settings = std::make_shared<Settings>();
  RetargetEntry& entry = settings->entry;
  RetargetOptions& options = entry.options;
  Verb verb;
  verb.name = "retarget";
  verb.summary = "Make the retarget tiles of a mask, with a proof of how good they are.";
  verb.examples = {
      {"bn retarget mask.png --step 48,36 --radius 6 -o tile.png", "the optimal tile for one dither step"},
      {"bn retarget mask.png --motion 4 -o atlas.png", "all 81 motions of -4..4 pixels in one 9x9 atlas"},
      {"bn retarget mask.png --channel 0 --step 48,36 --radius 6", "only the figures; nothing is written"},
      {"bn retarget large.exr --gap 0.5% -o tile.png --json",
       "stop within a certified 0.5 % of the optimum"}};
  verb.details =
      "A retarget tile says where the seed of each pixel goes so that seeds sorted like this frame's dither "
      "mask are "
      "sorted like the next frame's, which is the same mask moved by the step. The tile is a bijection of "
      "the torus, "
      "moves nothing farther than the radius, and has the least energy possible; lower_bound is the proof. "
      "Any image "
      "serves as a mask: 8 bit, 16 bit or float.\n\n"
      "With --motion N > 0 the printed energies are those of motion 0,0, optimal speaks for all, and --json "
      "lists every motion.";
  verb.arguments.positional("IMAGE", settings->image, file_path(),
                            "The mask: any image that OpenImageIO reads.");
  verb.arguments.option("--channel", entry.channel, integer_in(0, 63), "The channel to use, 0 for red.");
  verb.arguments.option(
      "--step", entry.step, offset_or_auto(),
      "How far the mask moves from frame to frame, in pixels; auto picks a step with a long orbit.");
  verb.arguments.option("--radius", options.radius, integer_in(1, 32),
                        "The farthest a seed may move, in pixels.");
  verb.arguments.option("--reach", options.reach,
                        choice_of<Reach>({{"chebyshev", Reach::chebyshev}, {"euclidean", Reach::euclidean}}),
                        "How that distance is measured: a square or a disc.");
  verb.arguments.option("--metric", options.metric,
                        choice_of<Metric>({{"l1", Metric::l1}, {"l2", Metric::l2}}),
                        "Cost of a difference of levels: its size or its square.");
  verb.arguments.flag("--no-wrap", options.wrap, false,
                      "No seed crosses the tile's border, for a tile used alone.");
  verb.arguments.option(
      "--motion", entry.motion, integer_in(0, 8),
      "Solve every motion of -N..N pixels in x and y; 0 makes one tile, 4 the 81 of a 9x9 atlas.");
  verb.arguments.option("--gap", options.gap, percentage_in(0, 100),
                        "Stop when the energy is proven to be within this of the optimum.");
  verb.arguments.option("--form", settings->form,
                        choice_of<MoveForm>({{"scatter", MoveForm::scatter}, {"gather", MoveForm::gather}}),
                        "What the file stores: where a seed goes, or where it comes from.");
  verb.arguments.option("--out", settings->out, file_path(),
                        "The file to write, 8 bit; .png, .exr, .tif, .h or .bin decides the format.", "-o");
  verb.arguments.flag("--json", settings->json, true, "Print the result as JSON.");
  verb.run = [settings](Session& session) { run(*settings, session); };
  return verb;
}

}  // namespace bn::tools
