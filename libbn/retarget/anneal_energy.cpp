// The energy of any placement, computed afresh, and the check of placements that come from outside.

#include "core/refuse.h"
#include "retarget/anneal_engine.h"

namespace bn {
using namespace retarget;
namespace {

Placement checked_moves(const AnnealInstance& instance, const Grid<Offset>& move,
                        const Grid<std::int8_t>& move_z) {
  const bool right = move.size() == instance.size &&
                     (instance.depth == 1 ? move_z.count() == 0 : move_z.size() == instance.size);
  if (!right) refuse("move", "a tile of another size than the levels", "both of one size, a volume's z too");
  Placement moves(move, move_z);
  instance.check_moves(moves);
  return moves;
}

}  // namespace

std::int64_t anneal_energy(const AnnealProblem& problem, const Grid<Offset>& move,
                           const Grid<std::int8_t>& move_z) {
  const AnnealInstance instance(problem, 0);
  const Placement moves = checked_moves(instance, move, move_z);
  // Engines compute the energy of a placement afresh.
  const auto engine = make_engine(instance, 0, 0);
  engine->place(instance.displacements_of(moves));
  return engine->energy();
}

void check_anneal_permutation(const AnnealProblem& problem, const Grid<Offset>& move,
                              const Grid<std::int8_t>& move_z) {
  checked_moves(AnnealInstance(problem, 0), move, move_z);
}

}  // namespace bn
