// The textures of a run: read back from a bake, with what their files say of themselves taken at its
// word only after the pixels have been hashed again; or made on the spot.

#include <fmt/format.h>

#include <algorithm>

#include "bn/error.h"
#include "bn/noise.h"
#include "bn/render.h"
#include "bn/retarget.h"
#include "bn/texture.h"
#include "bn/volume.h"
#include "core/progress.h"

namespace bn {
namespace {

using std::filesystem::path;

[[noreturn]] void refuse(const path& file, std::string what, std::string limit, std::string remedy) {
  throw Error({.code = ErrorCode::invalid_input,
               .what = std::move(what),
               .where = file.string(),
               .limit = std::move(limit),
               .remedy = std::move(remedy)});
}

/// With metadata, and with the pixels that the metadata was written for.
Volume read_recorded(const path& file, const Execution& execution) {
  Volume volume = read_volume(file, {}, execution);
  if (!volume.metadata)
    refuse(file, "the file says nothing of step and motion", "", "use textures that bn bake wrote");
  if (!volume.as_recorded) {
    throw Error({.code = ErrorCode::verification_failed,
                 .what = "the pixels are not those that were baked",
                 .where = file.string(),
                 .limit = volume.metadata->pixel_hash,
                 .remedy = "bake it again"});
  }
  return volume;
}

template <class T>
Grid<T> slice_of(const Grid<T>& volume, int z) {
  Grid<T> slice(volume.size());
  std::copy_n(volume.slice(z).begin(), slice.count(), slice.begin());
  return slice;
}

TemporalTextures levels_of(const Volume& masks) {
  const Grid<std::int32_t> levels = levels_of_channel(masks.image, 0).value;
  TemporalTextures textures;
  for (int z = 0; z < levels.depth(); ++z) textures.masks.push_back(slice_of(levels, z));
  return textures;
}

/// Adds to the masks the tiles, or atlases of tiles, of `file`, and the step they were baked for.
void add_moves(TemporalTextures& textures, const Volume& masks, const path& masks_file, const path& file,
               const Execution& execution) {
  const Volume moves = read_recorded(file, execution);
  const Metadata& said = *moves.metadata;
  const auto step = said.facts.get<Offset>("step");
  const auto source = said.facts.get<std::string>("source_hash");
  if (!step || said.tiles.empty()) refuse(file, "no step or no tiles recorded", "", "bake it again");
  if (source && *source != pixel_hash(masks.image)) {
    refuse(file, fmt::format("baked for another mask than {}", masks_file.string()), *source,
           "take both from one bake");
  }
  if (moves.image.depth != masks.image.depth) {
    refuse(file,
           fmt::format("{} slices of tiles for {} slices of masks", moves.image.depth, masks.image.depth),
           "one each", "take both from one bake");
  }
  const Extent tile = textures.size(), atlas = moves.image.size;
  const int columns = std::max(1, atlas.width / tile.width);
  if (columns % 2 == 0 || !(atlas == Extent{tile.width * columns, tile.height * columns})) {
    refuse(file, fmt::format("{}x{} pixels", atlas.width, atlas.height),
           fmt::format("1, 3, 5 ... tiles of the mask's {}x{} in each direction", tile.width, tile.height),
           "take both from one bake");
  }
  textures.step = *step;
  textures.motion_range = columns / 2;
  const bool gather = said.facts.get<std::string>("form") == "gather";
  for (int z = 0; z < moves.image.depth; ++z) {
    const Image slice = slice_of(moves.image, z);
    for (int i = 0; i < columns * columns; ++i) {
      Grid<Offset> move = decode_moves(atlas_tile(slice, tile, i));
      textures.moves.push_back(gather ? invert_moves(move) : std::move(move));
    }
  }
}

}  // namespace

TemporalTextures read_temporal_textures(const path& folder, std::optional<Offset> step, bool unsafe,
                                        const Execution& execution) {
  const path mask_file = folder / "mask.png";
  path moves_file = folder / "retarget_atlas.png";
  if (!std::filesystem::exists(moves_file)) moves_file = folder / "retarget.png";
  const Volume mask = read_recorded(mask_file, execution);
  TemporalTextures textures = levels_of(mask);
  add_moves(textures, mask, mask_file, moves_file, execution);
  const Offset said = textures.step;
  if (step && !(*step == said) && !unsafe) {
    refuse(moves_file,
           fmt::format("step ({}, {}) asked for, but the tiles carry seeds from one frame's mask to the next "
                       "by ({}, {})",
                       step->x, step->y, said.x, said.y),
           fmt::format("({}, {})", said.x, said.y), "leave --step out, or see with --unsafe what it costs");
  }
  textures.step = step.value_or(said);
  textures.check();
  return textures;
}

TemporalTextures read_stack_textures(const path& slices, const path& tiles, const Execution& execution) {
  const Volume masks = read_volume(slices, {}, execution);
  TemporalTextures textures = levels_of(masks);
  if (!tiles.empty()) add_moves(textures, masks, slices, tiles, execution);
  textures.check();
  return textures;
}

TemporalTextures make_temporal_textures(int motion_range, const Execution& execution) {
  const Image mask = encode_mask(void_and_cluster({.size = {64, 64}}, execution), SampleType::u8);
  TemporalTextures textures{.masks = {levels_of_channel(mask, 0).value},
                            .step = auto_step({64, 64}).step,
                            .motion_range = motion_range};
  for (RetargetTile& tile :
       solve_motion_set(textures.masks[0], {.step = textures.step}, motion_range, execution)) {
    textures.moves.push_back(std::move(tile.move));
  }
  return textures;
}

TemporalTextures make_preset_textures(SpatiotemporalPreset preset, const Execution& execution) {
  const Grid<std::uint32_t> ranks = spatiotemporal_mask({.size = {64, 64, 32}, .preset = preset}, execution);
  TemporalTextures textures;
  for (int z = 0; z < ranks.depth(); ++z) {
    const Image mask = encode_mask(slice_of(ranks, z), SampleType::u8);
    textures.masks.push_back(levels_of_channel(mask, 0).value);
  }
  return textures;
}

void solve_moves(TemporalTextures& textures, int radius, const Execution& execution) {
  textures.check();
  const auto count = static_cast<std::int64_t>(textures.masks.size());
  std::vector<Grid<Offset>> moves(textures.masks.size());
  ProgressMeter done(execution, textures.masks.size());
  Execution single = execution;
  single.threads = 1;
  single.progress = {};
  parallel_for(execution, count, [&](std::int64_t z) {
    const RetargetOptions options{.step = textures.step, .radius = radius};
    moves[static_cast<std::size_t>(z)] =
        solve_retarget({textures.mask(z), textures.mask(z + 1)}, options, single).move;
    done.advance(1);
  });
  done.finish();
  textures.moves = std::move(moves);
  textures.motion_range = 0;
}

}  // namespace bn
