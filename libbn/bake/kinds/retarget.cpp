// [[retarget]]: the retarget tiles of one mask or image, for every motion within a range.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "bake/kinds/all.h"
#include "bake/kinds/retarget_source.h"
#include "bake/paths.h"
#include "bn/error.h"
#include "bn/kinds.h"

namespace bn {

using namespace baking;

std::string_view name_of(MoveForm form) { return form == MoveForm::scatter ? "scatter" : "gather"; }
std::string_view name_of(Reach reach) { return reach == Reach::chebyshev ? "chebyshev" : "euclidean"; }
std::string_view name_of(Metric metric) { return metric == Metric::l1 ? "l1" : "l2"; }

const Kind& baking::retarget_kind() {
  static const Kind kind{
      .table = "retarget",
      .title = "Retarget tiles",
      .verb = "retarget",
      .summary = "Make the retarget tiles of a mask, with a proof of how good they are.",
      .details =
          "A retarget tile says where the seed of each pixel goes so that seeds sorted like this frame's "
          "dither mask are "
          "sorted like the next frame's, which is the same mask moved by the step. The tile is a bijection "
          "of the torus, "
          "moves nothing farther than the radius, and has the least energy possible; lower_bound is the "
          "proof. Any image "
          "serves as a mask: 8 bit, 16 bit or float.\n\n"
          "With --to the next frame has another mask. A stack of slices (a folder, slice_%03d.png, .ktx2, "
          ".dds, .exr, .bin, .h) has a tile for each slice, to the next one, and the last to the first; with "
          "--volume true, annealed, seeds move between slices too.\n\n"
          "With --motion N > 0 the printed energies are those of motion 0,0, optimal speaks for all, and "
          "--json lists "
          "every motion.",
      .examples =
          {{"bn retarget mask.png --step 48,36 --radius 6 -o tile.png",
            "the optimal tile for one dither step"},
           {"bn retarget mask.png --motion 4 -o atlas.png",
            "all 81 motions of -4..4 pixels in one 9x9 atlas"},
           {"bn retarget mask.png --channel 0 --step 48,36 --radius 6",
            "only the figures; nothing is written"},
           {"bn retarget large.exr --gap 0.5% -o tile.png --json",
            "stop within a certified 0.5 % of the optimum"},
           {"bn retarget a.png --to b.png -o tile.png", "from one mask to another"},
           {"bn retarget slice_%03d.png -o retarget_%03d.png",
            "a stack: one proven tile a slice, to the next one, the last to the first"},
           {"bn retarget mask.png --method anneal --schedule kirkpatrick --seconds 2 --seed 1 -o tile.png",
            "anneal for two seconds; Ctrl-C and the same command again go on from tile.png.checkpoint"},
           {"bn retarget rgb.png --method anneal --channels 0,1,2 --weights 2,4,1 --proposals 1e9 -o "
            "tile.png",
            "one tile for three channels at once"},
           {"bn retarget mask.png --method anneal --metric l2 --residual-sigma 1.5 --proposals 1e8 -o "
            "tile.png",
            "the least difference as seen through a blur"}},
      .make = [] { return std::make_shared<RetargetEntry>(); },
      .one_at_a_time = true};
  return kind;
}

const Kind& RetargetEntry::kind() const { return baking::retarget_kind(); }

std::size_t RetargetEntry::input_output(const Entry& source) const {
  for (std::size_t i = 0; i < source.output_count(); ++i) {
    if (source.output_type(i) == levels) return i;
  }
  throw Error(
      {.code = ErrorCode::invalid_input,
       .what = fmt::format("{} '{}' has no {} output for the tiles to refer to", source.kind().table,
                           source.name, name_of(levels)),
       .where = name,
       .limit = "",
       .remedy = fmt::format("add {{ path = \"...\", type = \"{}\" }} to its outputs", name_of(levels))});
}

void RetargetEntry::check_inputs(const std::vector<Shape>& shapes, const Complain& complain) const {
  const bool second = !to.empty() || !to_mask.empty();
  if (second && shapes.size() > 1 && shapes[0] != shapes[1]) {
    complain(to.empty() ? "to_mask" : "to",
             fmt::format("is a mask of {}x{}x{}", shapes[1].width, shapes[1].height, shapes[1].depth),
             fmt::format("{}x{}x{}, as the source", shapes[0].width, shapes[0].height, shapes[0].depth), "");
  }
  if (!shapes.empty() && anneals && !volume && shapes[0].depth > 1) {
    complain("method", fmt::format("anneals one tile, and the source has {} slices", shapes[0].depth),
             "exact for a tile a slice, or volume = true", "");
  }
  if (!shapes.empty() && volume && shapes[0].depth == 1)
    complain("volume", "is true, and the source has one slice", "a source of several slices", "");
  for (const Shape shape : shapes) {
    const Extent size = shape.slice();
    const int most = std::min(8, largest_motion(size));
    if (motion <= most) continue;
    complain("motion", fmt::format("{} is larger than the tile of {}x{}", motion, size.width, size.height),
             fmt::format("0..{}", most), "");
  }
}

int RetargetEntry::output_channels(std::size_t output) const {
  // Few devices sample textures of three channels, and DXGI has no format for them but floats. So files for
  // devices hold x and y alone, or the move in a volume and alpha.
  const std::string extension = lower_case_extension(outputs.at(output).path);
  if (extension != ".dds" && extension != ".ktx2") return 3;
  return volume ? 4 : 2;
}

int RetargetEntry::output_depth(std::size_t, const std::vector<Shape>& input_shapes) const {
  return input_shapes.empty() ? 1 : input_shapes.front().depth;
}

Cost RetargetEntry::cost(const std::vector<Shape>& input_shapes, const Execution& execution) const {
  // Measured on one core of a Zen 5 machine; the seconds only pace the progress bar.
  constexpr double kSecondsPerPixel = 1.5e-6;  // up to 128 x 128, then growing with the side
  constexpr double kSecondsPerProposal = 6e-10, kSecondsPerFilteredProposal = 1e-7;
  constexpr std::uint64_t kSolverBytesPerPixel = 64;       // of a tile in work
  constexpr std::uint64_t kTileBytesPerPixel = 8 + 3 + 3;  // of a finished tile: moves, image, atlas
  const Shape shape = input_shapes.empty() ? Shape{0, 0, 1} : input_shapes.front();
  const Extent size = volume ? Extent{shape.width, shape.height * shape.depth} : shape.slice();
  const int tiles = (2 * motion + 1) * (2 * motion + 1) * (volume ? 1 : shape.depth);
  const auto pixels = static_cast<double>(size.area());
  Cost cost{.seconds = tiles * pixels * kSecondsPerPixel * std::max(1.0, std::sqrt(pixels) / 128.0)};
  if (anneals) {
    cost.seconds += tiles * static_cast<double>(anneal.options.proposals) * anneal.options.chains.count *
                    (anneal.residual_sigma_px > 0.0 ? kSecondsPerFilteredProposal : kSecondsPerProposal);
  }
  const auto at_once = static_cast<std::uint64_t>(std::min(thread_count(execution), tiles));
  cost.memory_bytes =
      static_cast<std::uint64_t>(size.area()) *
      (at_once * kSolverBytesPerPixel + static_cast<std::uint64_t>(tiles) * kTileBytesPerPixel);
  return cost;
}

Metadata RetargetEntry::metadata(std::size_t output, const std::vector<Input>& inputs,
                                 const std::filesystem::path& folder) const {
  const RetargetOutput& file = outputs.at(output);
  const Input& source = inputs.at(0);
  Metadata metadata;
  metadata.algorithm = anneals ? "retarget-anneal" : "retarget-exact";
  metadata.algorithm_version = anneals ? kAnnealVersion : kExactRetargetVersion;
  metadata.kind = file.kind == RetargetOutput::Kind::tile ? "retarget-tile" : "retarget-atlas";
  Facts& facts = metadata.facts;
  if (anneals) facts.add("seed", anneal.options.seed);
  const bool moves = source.image.depth == 1 && inputs.size() == 1;
  facts.add("step", step ? *step : moves ? auto_step(source.image.size).step : Offset{0, 0});
  if (volume) facts.add("step_z", step_z);
  facts.add("radius", problem.radius);
  facts.add("reach", name_of(problem.reach));
  facts.add("metric", name_of(problem.metric));
  facts.add("wrap", Value(problem.wrap));
  facts.add("form", name_of(file.form));
  const auto from = std::filesystem::absolute(folder / ".").lexically_normal();
  const auto relative = [&](const Input& input) {
    return std::filesystem::absolute(input.path).lexically_normal().lexically_relative(from).generic_string();
  };
  facts.add("source", relative(source));
  facts.add("source_channel", channels_of(*this).front());
  facts.add("source_hash", source.hash);
  if (inputs.size() > 1) {
    facts.add("to", relative(inputs[1]));
    facts.add("to_hash", inputs[1].hash);
  }
  return metadata;
}

namespace {

TileRecord record_of(const RetargetTile& tile, Offset motion) {
  return {.motion = motion,
          .start_energy = tile.start_energy,
          .energy = tile.energy,
          .lower_bound = tile.lower_bound};
}

/// An annealed tile's energy was kept by adding changes; here it is computed afresh.
void require_energy(const RetargetEntry& entry, const Source& source, const MadeTile& made_tile,
                    const RetargetOptions& options, Made& made) {
  const RetargetTile& tile = made_tile.tile;
  const std::int64_t recomputed = energy_of(entry, source, 0, tile.move, made_tile.move_z, options);
  if (recomputed != tile.energy) {
    throw Error({.code = ErrorCode::verification_failed,
                 .what = fmt::format("annealing says energy {}, its tile has {}", tile.energy, recomputed),
                 .where = fmt::format("{}, motion ({}, {})", entry.name, options.motion.x, options.motion.y),
                 .limit = "equal",
                 .remedy = "report it, with the image and the options"});
  }
  if (options.motion == Offset{0, 0}) made.facts.add("recomputed_energy", recomputed);
}

/// The 8 bit or half image with fewer channels, or with an opaque one more.
Image with_channels(Image image, int channels) {
  if (channels == image.channels) return image;
  constexpr std::uint16_t kHalfOne = 0x3c00;
  Image result{
      .size = image.size, .depth = image.depth, .channels = channels, .type = image.type, .samples = {}};
  const std::size_t sample = bytes_per_sample(image.type),
                    from = sample * static_cast<std::size_t>(image.channels),
                    to = sample * static_cast<std::size_t>(channels);
  const auto pixels = static_cast<std::size_t>(image.shape().count());
  result.samples.assign(pixels * to, std::byte{255});
  for (std::size_t i = 0; i < pixels; ++i) {
    std::byte* const pixel = result.samples.data() + i * to;
    std::memcpy(pixel, image.samples.data() + i * from, std::min(from, to));
    if (to > from && image.type == SampleType::f16) std::memcpy(pixel + from, &kHalfOne, sample);
  }
  return result;
}

/// One file: the tile of one motion, or the atlas of all, a slice for each slice of the source.
Picture picture_of(const RetargetEntry& entry, std::size_t output, const Source& source,
                   const std::vector<MadeTile>& tiles, const std::vector<TileRecord>& records) {
  const RetargetOutput& file = entry.outputs.at(output);
  const int side = 2 * entry.motion + 1;
  const auto motions = static_cast<std::size_t>(side * side);
  const bool is_tile = file.kind == RetargetOutput::Kind::tile;
  const std::size_t one = motion_index(file.motion, entry.motion);
  if (entry.volume) {
    return {.image = with_channels(encode_tile(entry, output, tiles.at(one), source),
                                   entry.output_channels(output)),
            .slices = SliceKind::depth,
            .tiles = {records.at(one)}};
  }
  Picture picture;
  std::vector<Image> slices;
  for (std::size_t first = 0; first < tiles.size(); first += motions) {
    if (is_tile) {
      slices.push_back(encode_tile(entry, output, tiles[first + one], source));
      picture.tiles.push_back(records[first + one]);
      continue;
    }
    std::vector<Image> all;
    for (std::size_t i = first; i < first + motions; ++i)
      all.push_back(encode_tile(entry, output, tiles[i], source));
    slices.push_back(make_atlas(all, side));
  }
  picture.image = slices.size() == 1 ? std::move(slices.front()) : stack_slices(slices);
  picture.image = with_channels(std::move(picture.image), entry.output_channels(output));
  if (!is_tile) picture.tiles = records;
  return picture;
}

}  // namespace

Made RetargetEntry::make(const std::vector<Input>& inputs, const Execution& execution) const {
  const Source source = source_of(inputs, channels_of(*this));
  check_inputs({source.first().shape()},
               [&](std::string_view key, std::string what, std::string limit, std::string remedy) {
                 throw Error({.code = ErrorCode::invalid_input,
                              .what = fmt::format("{} {}", key, what),
                              .where = std::string(key),
                              .limit = std::move(limit),
                              .remedy = std::move(remedy)});
               });
  RetargetOptions options = problem;
  options.step = step_of(*this, source);
  Made made;
  made.facts.add("step", options.step);
  if (source.moves()) made.facts.add("orbit_length", orbit_length(source.size(), options.step));
  if (source.depth() > 1) made.facts.add("slices", source.depth());
  if (anneals) made.facts.add("proposals", anneal.options.proposals);
  made.notes = source_notes(source, options);
  std::vector<MadeTile> tiles =
      anneals ? anneal_tiles(*this, source, execution) : solve_tiles(*this, source, execution);
  const int side = 2 * motion + 1, motions = side * side;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const int at = static_cast<int>(i) % motions;
    options.motion = {at % side - motion, at / side - motion};
    made.tiles.push_back(record_of(tiles[i].tile, options.motion));
    if (anneals) require_energy(*this, source, tiles[i], options, made);
  }
  made.picture = [this, source, tiles = std::move(tiles), records = made.tiles](std::size_t output) {
    return picture_of(*this, output, source, tiles, records);
  };
  return made;
}

void RetargetEntry::check_input_contents(const std::vector<Input>& inputs) const {
  source_of(inputs, channels_of(*this));
}

bool RetargetEntry::settle(const std::vector<Input>& inputs, const Execution& execution) {
  if (!anneals || anneal.seconds <= 0.0) return false;
  *this = with_budget_found(*this, source_of(inputs, channels_of(*this)), execution);
  return true;
}

Made RetargetEntry::made_elsewhere(const std::vector<Input>& inputs, const RetargetTile& tile) const {
  const RetargetOutput& output = outputs.at(0);
  const Source source = source_of(inputs, channels_of(*this));
  RetargetOptions options = problem;
  options.step = step_of(*this, source);
  options.motion = output.motion;
  const auto require = [](bool holds, const char* what) {
    if (holds) return;
    throw Error({.code = ErrorCode::verification_failed,
                 .what = what,
                 .where = "tile",
                 .limit = "the figures of its moves on this source",
                 .remedy = "make it for this source and these options"});
  };
  require(source.depth() == 1, "it is one tile, of a stack of slices");
  require(tile.move.size() == source.size(), "its size is not its source's");
  check_permutation(tile.move, options);
  require(energy_of(*this, source, 0, tile.move, {}, options) == tile.energy,
          "its energy is not that of its moves");
  const Grid<Offset> identity(source.size(), options.motion);
  require(energy_of(*this, source, 0, identity, {}, options) == tile.start_energy,
          "its start energy is not the identity's");
  require(tile.lower_bound <= tile.energy, "its lower bound is above its energy");
  Made made;
  made.facts.add("step", options.step);
  if (source.moves()) made.facts.add("orbit_length", orbit_length(source.size(), options.step));
  made.tiles = {record_of(tile, options.motion)};
  made.notes = source_notes(source, options);
  const Image moves = with_channels(
      encode_moves(output.form == MoveForm::scatter ? tile.move : invert_moves(tile.move), output_type(0)),
      output_channels(0));
  made.picture = [moves, tiles = made.tiles](std::size_t) { return Picture{.image = moves, .tiles = tiles}; };
  return made;
}

}  // namespace bn
