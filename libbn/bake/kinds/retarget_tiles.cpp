// The tiles of a retarget entry, one for each slice and motion: solved, and as files hold them.

#include <algorithm>

#include "bake/kinds/retarget_source.h"
#include "bn/error.h"
#include "core/progress.h"

namespace bn::baking {
namespace {

/// Where the seed of a pixel of a volume comes from, of where it goes; and back. Errors: verification_failed
/// (two seeds on one pixel).
MadeTile inverse(const MadeTile& tile, int depth) {
  const Grid<Offset>& move = tile.tile.move;
  MadeTile result;
  if (tile.move_z.count() == 0) {
    result.tile.move = invert_moves(move);
    return result;
  }
  const Shape shape{move.width(), move.height() / depth, depth};
  result.tile.move = Grid<Offset>(move.shape());
  result.move_z = Grid<std::int8_t>(move.shape());
  std::vector<bool> taken(move.count(), false);
  for (int z = 0; z < shape.depth; ++z) {
    for (int y = 0; y < shape.height; ++y) {
      for (int x = 0; x < shape.width; ++x) {
        const int row = z * shape.height + y;
        const Offset r = move(x, row);
        const int r_z = tile.move_z(x, row);
        const int to_x = wrap(std::int64_t{x} + r.x, shape.width),
                  to_y = wrap(std::int64_t{y} + r.y, shape.height),
                  to_row = wrap(z + r_z, depth) * shape.height + to_y;
        const auto at = static_cast<std::size_t>(to_row) * static_cast<std::size_t>(shape.width) +
                        static_cast<std::size_t>(to_x);
        if (taken[at]) fail_check("two seeds of the volume go to one pixel");
        taken[at] = true;
        result.tile.move[at] = {-r.x, -r.y};
        result.move_z[at] = static_cast<std::int8_t>(-r_z);
      }
    }
  }
  return result;
}

}  // namespace

Image encode_tile(const RetargetEntry& entry, std::size_t output, const MadeTile& tile,
                  const Source& source) {
  const bool gather = entry.outputs.at(output).form == MoveForm::gather;
  const MadeTile& form = gather ? inverse(tile, source.depth()) : tile;
  const SampleType type = entry.output_type(output);
  if (!entry.volume) return encode_moves(form.tile.move, type);
  const Shape shape = source.first().shape();
  Grid<Offset> move(shape);
  Grid<std::int8_t> move_z(shape);
  std::copy(form.tile.move.begin(), form.tile.move.end(), move.begin());
  std::copy(form.move_z.begin(), form.move_z.end(), move_z.begin());
  return encode_moves(move, move_z, type);
}

MadeTile decode_tile(const RetargetEntry& entry, std::size_t output, const Image& image) {
  MadeTile stored;
  if (entry.volume) {
    const VolumeMoves moves = decode_volume_moves(image);
    const Extent stack{image.size.width, image.size.height * image.depth};
    stored.tile.move = Grid<Offset>(stack);
    stored.move_z = Grid<std::int8_t>(stack);
    std::copy(moves.move.begin(), moves.move.end(), stored.tile.move.begin());
    std::copy(moves.z.begin(), moves.z.end(), stored.move_z.begin());
  } else {
    stored.tile.move = decode_moves(image);
  }
  MadeTile other = inverse(stored, image.depth);  // also proves that it is a bijection
  return entry.outputs.at(output).form == MoveForm::gather ? std::move(other) : std::move(stored);
}

std::vector<MadeTile> solve_tiles(const RetargetEntry& entry, const Source& source,
                                  const Execution& execution) {
  RetargetOptions options = entry.problem;
  options.step = step_of(entry, source);
  std::vector<MadeTile> tiles;
  if (source.depth() == 1) {
    const FrameMasks masks = frame_masks(source, 0);
    for (RetargetTile& tile : solve_motion_set(masks, options, entry.motion, execution))
      tiles.push_back({std::move(tile)});
    return tiles;
  }
  // A slice at a time on each thread; the result cannot depend on their number.
  std::vector<std::vector<RetargetTile>> of_slice(static_cast<std::size_t>(source.depth()));
  ProgressMeter done(execution, of_slice.size());
  parallel_for(execution, source.depth(), [&](std::int64_t z) {
    Execution single = execution;
    single.threads = 1;
    single.progress = {};
    const FrameMasks masks = frame_masks(source, static_cast<int>(z));
    of_slice[static_cast<std::size_t>(z)] = solve_motion_set(masks, options, entry.motion, single);
    done.advance(1);
  });
  for (auto& motions : of_slice) {
    for (RetargetTile& tile : motions) tiles.push_back({std::move(tile)});
  }
  return tiles;
}

}  // namespace bn::baking
