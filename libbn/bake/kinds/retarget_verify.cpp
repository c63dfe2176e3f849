// Verification of retarget tiles: nothing that is recorded is believed. The tiles must be bijections within
// reach, energies are recomputed from their definition, and lower bounds are compared with a new proof.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>

#include "bake/inputs.h"
#include "bake/kinds/retarget_source.h"
#include "bn/error.h"

namespace bn {

using namespace baking;

namespace {

std::string text_of(const std::optional<Offset>& value) {
  return value ? fmt::format("({}, {})", value->x, value->y) : "none";
}

class TileVerifier {
 public:
  TileVerifier(const RetargetEntry& entry, const Image& image, const Metadata& metadata,
               const std::filesystem::path& folder, Checks& checks, const Execution& execution)
      : entry_(entry),
        image_(image),
        metadata_(metadata),
        folder_(folder),
        checks_(checks),
        execution_(execution) {}

  void verify() {
    if (!checks_.attempt("recipe", [&] { return check_recipe(); })) return;
    const std::size_t count = metadata_.tiles.size();
    std::vector<MadeTile> moves(count);  // in scatter form
    const bool bijective = checks_.attempt("bijection", [&] {
      for_each_tile([&](std::size_t i, const RetargetOptions&) {
        const int motions = motions_per_slice(), at = static_cast<int>(i);
        const Image tile =
            entry_.volume ? image_ : atlas_tile(slice_of(image_, at / motions), tile_size_, at % motions);
        moves[i] = decode_tile(entry_, 0, tile);
      });
      return fmt::format("{} of {} tiles", count, count);
    });
    if (!bijective) return;
    checks_.attempt("radius", [&] {
      for_each_tile([&](std::size_t i, const RetargetOptions& options) {
        if (!entry_.volume) return check_permutation(moves[i].tile.move, options);
        AnnealProblem shape;  // levels play no part in what a permutation may do
        shape.channels = {{.levels = Grid<std::int32_t>(moves[i].tile.move.size())}};
        shape.retarget = options;
        shape.depth = image_.depth;
        check_anneal_permutation(shape, moves[i].tile.move, moves[i].move_z);
      });
      return fmt::format("every move within {} {}", options_.radius, name_of(options_.reach));
    });
    Source source;
    if (!checks_.attempt("source", [&] { return read_source(source); })) return;
    checks_.attempt("energy", [&] { return check_energies(source, moves); });
    checks_.attempt("bound", [&] { return check_bounds(source); });
  }

 private:
  /// Every recorded option must be the recipe's.
  std::string check_recipe() {
    const Facts& facts = metadata_.facts;
    const auto expect = [](bool same, const char* what, const std::string& recipe,
                           const std::string& recorded) {
      if (!same) fail_check(fmt::format("{} is {} in the recipe, {} in the record", what, recipe, recorded));
    };
    const auto same_word = [&](const char* what, std::string_view recipe,
                               const std::optional<std::string>& recorded) {
      expect(recorded == recipe, what, std::string(recipe), recorded.value_or("none"));
    };
    const RetargetOutput& output = entry_.outputs.at(0);
    const auto step = facts.get<Offset>("step");
    if (!step) fail_check("the record has no step");
    expect(!entry_.step || entry_.step == step, "step", text_of(entry_.step), text_of(step));
    const auto radius = facts.get<int>("radius");
    expect(radius == entry_.problem.radius, "radius", fmt::format("{}", entry_.problem.radius),
           radius ? fmt::format("{}", *radius) : "none");
    same_word("reach", name_of(entry_.problem.reach), facts.get<std::string>("reach"));
    same_word("metric", name_of(entry_.problem.metric), facts.get<std::string>("metric"));
    same_word("form", name_of(output.form), facts.get<std::string>("form"));
    const auto wrap = facts.get<bool>("wrap");
    same_word("wrap", entry_.problem.wrap ? "true" : "false",
              wrap ? std::optional<std::string>(*wrap ? "true" : "false") : std::nullopt);
    const auto seed = facts.get<std::int64_t>("seed");
    const auto own_seed = static_cast<std::int64_t>(entry_.anneal.options.seed);
    if (entry_.anneals)
      expect(seed == own_seed, "seed", fmt::format("{}", own_seed), seed ? fmt::format("{}", *seed) : "none");
    const auto step_z = facts.get<int>("step_z");
    expect(step_z == (entry_.volume ? std::optional<int>(entry_.step_z) : std::nullopt), "step_z",
           fmt::format("{}", entry_.step_z), step_z ? fmt::format("{}", *step_z) : "none");
    constexpr std::array<std::string_view, 13> kKnown = {
        "seed", "step",   "step_z",         "radius",      "reach", "metric", "wrap",
        "form", "source", "source_channel", "source_hash", "to",    "to_hash"};
    for (const auto& [key, value] : facts) {
      if (std::find(kKnown.begin(), kKnown.end(), key) == kKnown.end())
        fail_check(fmt::format("{} is in the record and not in the recipe", key));
    }
    const bool is_tile = output.kind == RetargetOutput::Kind::tile;
    same_word("kind", is_tile ? "retarget-tile" : "retarget-atlas", metadata_.kind);
    const int side = is_tile ? 1 : 2 * entry_.motion + 1;
    const int count = static_cast<int>(metadata_.tiles.size()), motions = side * side;
    const int wanted = entry_.volume ? 1 : motions * image_.depth;
    expect(count == wanted, "number of tiles", fmt::format("{}", wanted), fmt::format("{}", count));
    for (int i = 0; i < count; ++i) {
      const Offset motion =
          is_tile ? output.motion
                  : Offset{i % motions % side - entry_.motion, i % motions / side - entry_.motion};
      const Offset recorded = metadata_.tiles[static_cast<std::size_t>(i)].motion;
      expect(motion == recorded, "motion", text_of(motion), text_of(recorded));
    }
    if (image_.size.width % side != 0 || image_.size.height % side != 0) {
      fail_check(
          fmt::format("{}x{} pixels hold no {}x{} tiles", image_.size.width, image_.size.height, side, side));
    }
    options_ = entry_.problem;
    options_.step = *step;
    tile_size_ = {image_.size.width / side, image_.size.height / side};
    return fmt::format("step ({}, {}), radius {} {}, {}, {}", options_.step.x, options_.step.y,
                       options_.radius, name_of(options_.reach), name_of(options_.metric),
                       name_of(output.form));
  }

  std::string read_source(Source& source) {
    const auto path = metadata_.facts.get<std::string>("source");
    const auto channel = metadata_.facts.get<int>("source_channel");
    const auto hash = metadata_.facts.get<std::string>("source_hash");
    if (!path || !channel || !hash) fail_check("the file names none");
    const std::vector<int> channels = channels_of(entry_);
    if (channels[0] != *channel) fail_check("the recipe reads another channel than the record says");
    std::vector<Input> inputs = {read_input(folder_ / *path, execution_)};
    const auto to_path = metadata_.facts.get<std::string>("to"),
               to_hash = metadata_.facts.get<std::string>("to_hash");
    const bool has_second = !entry_.to.empty() || !entry_.to_mask.empty();
    if (has_second != to_path.has_value() || has_second != to_hash.has_value())
      fail_check("the recipe and the record differ in the mask of the next frame");
    if (to_path) inputs.push_back(read_input(folder_ / *to_path, execution_));
    source = source_of(inputs, channels);
    if (source.hash != *hash)
      fail_check(fmt::format("{}: pixels have {}, recorded is {}", *path, source.hash, *hash));
    if (to_hash && source.to_hash != *to_hash)
      fail_check(fmt::format("{}: pixels have {}, recorded is {}", *to_path, source.to_hash, *to_hash));
    if (source.size() != tile_size_ || source.depth() != image_.depth)
      fail_check("the source and the tile differ in size");
    return fmt::format("{} {}", *path, source.hash);
  }

  /// Calls each(index, options of that motion); an error tells which motion it was.
  template <class Each>
  void for_each_tile(Each each) {
    for (std::size_t i = 0; i < metadata_.tiles.size(); ++i) {
      RetargetOptions options = options_;
      options.motion = metadata_.tiles[i].motion;
      try {
        each(i, options);
      } catch (const Error& error) {
        if (error.code() != ErrorCode::verification_failed) throw;
        fail_check(fmt::format("motion ({}, {}): {}", options.motion.x, options.motion.y, error.what()));
      }
    }
  }

  std::string check_energies(const Source& source, const std::vector<MadeTile>& moves) {
    std::int64_t least = metadata_.tiles[0].energy, most = least;
    for_each_tile([&](std::size_t i, const RetargetOptions& options) {
      const TileRecord& recorded = metadata_.tiles[i];
      const int z = static_cast<int>(i) / motions_per_slice();
      const MadeTile& tile = moves[i];
      const std::int64_t energy = energy_of(entry_, source, z, tile.tile.move, tile.move_z, options);
      if (energy != recorded.energy)
        fail_check(fmt::format("energy is {}, recorded is {}", energy, recorded.energy));
      const std::int64_t start =
          energy_of(entry_, source, z, Grid<Offset>(tile.tile.move.size(), options.motion),
                    Grid<std::int8_t>(tile.move_z.shape()), options);
      if (start != recorded.start_energy) {
        fail_check(fmt::format("start energy is {}, recorded is {}", start, recorded.start_energy));
      }
      least = std::min(least, energy);
      most = std::max(most, energy);
    });
    return least == most ? fmt::format("{}", least) : fmt::format("{}..{}", least, most);
  }

  /// A recorded bound holds if a new proof reaches it. The new proof may stop at the recipe's gap;
  /// only a bound between that proof and its permutation's energy needs the full one.
  std::string check_bounds(const Source& source) {
    if (entry_.anneals && (source.levels.size() > 1 || entry_.anneal.residual_sigma_px > 0.0 ||
                           !entry_.anneal.weights.empty() || entry_.volume))
      return check_anneal_bounds(anneal_problem(entry_, source));
    std::vector<std::string> failures(metadata_.tiles.size());
    std::int64_t optimal = 0;
    for (const TileRecord& tile : metadata_.tiles) optimal += tile.energy == tile.lower_bound;
    Execution single = execution_;
    single.progress = {};
    const auto count = static_cast<std::int64_t>(failures.size());
    if (count > 1) single.threads = 1;
    parallel_for(execution_, count, [&](std::int64_t index) {
      const auto i = static_cast<std::size_t>(index);
      const TileRecord& recorded = metadata_.tiles[i];
      RetargetOptions options = options_;
      options.motion = recorded.motion;
      const FrameMasks levels = frame_masks(source, static_cast<int>(index) / motions_per_slice());
      RetargetTile proof = solve_retarget(levels, options, single);
      if (recorded.lower_bound > proof.lower_bound && recorded.lower_bound <= proof.energy) {
        options.gap = 0.0;
        proof = solve_retarget(levels, options, single);
      }
      const auto claimed_gap = static_cast<double>(recorded.energy - recorded.lower_bound);
      if (recorded.lower_bound > proof.lower_bound) {
        failures[i] = fmt::format("recorded bound {} is none: a permutation with energy {} exists",
                                  recorded.lower_bound, proof.energy);
      } else if (!entry_.anneals && claimed_gap > options_.gap * static_cast<double>(recorded.lower_bound)) {
        failures[i] =
            fmt::format("recorded bound {} is farther from the energy {} than the gap {} of the recipe",
                        recorded.lower_bound, recorded.energy, options_.gap);
      }
    });
    for_each_tile([&](std::size_t i, const RetargetOptions&) {
      if (!failures[i].empty()) fail_check(failures[i]);
    });
    return fmt::format("proven again, {} of {} tiles optimal", optimal, count);
  }

  /// Of energies that no exact solver handles whole: proven channel by channel.
  std::string check_anneal_bounds(AnnealProblem problem) {
    problem.retarget = options_;
    int range = 0;
    for (const TileRecord& tile : metadata_.tiles)
      range = std::max({range, std::abs(tile.motion.x), std::abs(tile.motion.y)});
    const std::vector<std::int64_t> bounds = anneal_bounds(problem, range, 0.0, execution_);
    for_each_tile([&](std::size_t i, const RetargetOptions& options) {
      const std::int64_t bound = bounds[motion_index(options.motion, range)];
      if (metadata_.tiles[i].lower_bound > bound) {
        fail_check(fmt::format("recorded bound {} is above {}, the most that is proven",
                               metadata_.tiles[i].lower_bound, bound));
      }
    });
    return problem.residual_sigma_px > 0.0 || problem.depth > 1 ? "0, as no energy is below it"
                                                                : "proven again, channel by channel";
  }

  int motions_per_slice() const {
    const bool is_tile = entry_.outputs.at(0).kind == RetargetOutput::Kind::tile;
    return is_tile ? 1 : (2 * entry_.motion + 1) * (2 * entry_.motion + 1);
  }

  const RetargetEntry& entry_;
  const Image& image_;
  const Metadata& metadata_;
  const std::filesystem::path& folder_;
  Checks& checks_;
  const Execution& execution_;
  RetargetOptions options_;
  Extent tile_size_;
};

}  // namespace

void RetargetEntry::verify(const Image& picture, const Metadata& metadata,
                           const std::filesystem::path& folder, Checks& checks,
                           const Execution& execution) const {
  TileVerifier(*this, picture, metadata, folder, checks, execution).verify();
}

}  // namespace bn
