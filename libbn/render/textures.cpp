// The textures of a run: read back from a bake, with what their files say of themselves taken at its
// word only after the pixels have been hashed again; or made on the spot.

#include <fmt/format.h>

#include "bn/error.h"
#include "bn/noise.h"
#include "bn/render.h"
#include "bn/retarget.h"
#include "bn/texture.h"
#include "bn/volume.h"

namespace bn {
namespace {

FileContent read_hashed(const std::filesystem::path& path, const Execution& execution) {
  FileContent file = read_image(path, execution);
  if (!file.metadata) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = "the file says nothing of step and motion",
                 .where = path.string(),
                 .limit = "",
                 .remedy = "use textures that bn bake wrote"});
  }
  if (pixel_hash(file.image) != file.metadata->pixel_hash) {
    throw Error({.code = ErrorCode::verification_failed,
                 .what = "the pixels are not those that were baked",
                 .where = path.string(),
                 .limit = file.metadata->pixel_hash,
                 .remedy = "bake it again"});
  }
  return file;
}

}  // namespace

TemporalTextures read_temporal_textures(const std::filesystem::path& folder, std::optional<Offset> step,
                                        bool unsafe, const Execution& execution) {
  const std::filesystem::path mask_path = folder / "mask.png";
  std::filesystem::path moves_path = folder / "retarget_atlas.png";
  if (!std::filesystem::exists(moves_path)) moves_path = folder / "retarget.png";
  const FileContent mask = read_hashed(mask_path, execution);
  const FileContent moves = read_hashed(moves_path, execution);
  const Metadata& said = *moves.metadata;
  const auto refuse = [&](std::string what, std::string limit, std::string remedy) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = std::move(what),
                 .where = moves_path.string(),
                 .limit = std::move(limit),
                 .remedy = std::move(remedy)});
  };
  const auto said_step = said.facts.get<Offset>("step");
  const auto said_hash = said.facts.get<std::string>("source_hash");
  if (!said_step || said.tiles.empty()) refuse("no step or no tiles recorded", "", "bake it again");
  if (said_hash && *said_hash != mask.metadata->pixel_hash) {
    refuse("baked for another mask than " + mask_path.string(), *said_hash, "take both from one bake");
  }
  if (step && !(*step == *said_step) && !unsafe) {
    refuse(fmt::format("step ({}, {}) asked for, but the tiles carry seeds from one frame's mask to the next "
                       "by ({}, {})",
                       step->x, step->y, said_step->x, said_step->y),
           fmt::format("({}, {})", said_step->x, said_step->y),
           "leave --step out, or see with --unsafe what it costs");
  }
  const Grid<std::int32_t> levels = levels_of_channel(mask.image, 0).value;
  TemporalTextures textures{.mask = levels, .step = step.value_or(*said_step)};
  const auto count = said.tiles.size();
  while ((2 * textures.motion_range + 1) * (2 * textures.motion_range + 1) < static_cast<int>(count)) {
    ++textures.motion_range;
  }
  const int columns = 2 * textures.motion_range + 1;
  const Extent atlas{levels.width() * columns, levels.height() * columns};
  if (static_cast<std::size_t>(columns) * static_cast<std::size_t>(columns) != count ||
      moves.image.size != atlas) {
    refuse(
        fmt::format("{}x{} pixels for {} tiles", moves.image.size.width, moves.image.size.height, count),
        fmt::format("{}x{}, for a mask of {}x{}", atlas.width, atlas.height, levels.width(), levels.height()),
        "take both from one bake");
  }
  for (int i = 0; i < static_cast<int>(count); ++i) {
    Grid<Offset> move = decode_moves(atlas_tile(moves.image, levels.size(), i));
    textures.moves.push_back(said.facts.get<std::string>("form") == "gather" ? invert_moves(move) : std::move(move));
  }
  textures.check();
  return textures;
}

std::vector<Grid<std::int32_t>> read_slices(const std::filesystem::path& folder, const Execution& execution) {
  const Volume volume = read_volume(folder, {}, execution);
  std::vector<Grid<std::int32_t>> slices;
  for (int z = 0; z < volume.image.depth; ++z) {
    slices.push_back(levels_of_channel(slice_of(volume.image, z), 0).value);
  }
  return slices;
}

TemporalTextures make_temporal_textures(int motion_range, const Execution& execution) {
  const Image mask = encode_mask(void_and_cluster({.size = {64, 64}}, execution), SampleType::u8);
  TemporalTextures textures{.mask = levels_of_channel(mask, 0).value,
                            .step = auto_step({64, 64}).step,
                            .motion_range = motion_range};
  for (RetargetTile& tile :
       solve_motion_set(textures.mask, {.step = textures.step}, motion_range, execution)) {
    textures.moves.push_back(std::move(tile.move));
  }
  return textures;
}

}  // namespace bn
