#include "retarget/anneal_engine.h"

namespace bn {

std::int64_t anneal_energy(const AnnealProblem& problem, const Grid<Offset>& move) {
  const AnnealInstance instance(problem, 0);
  check_permutation(move, problem.retarget);
  // Engines compute the energy of a placement afresh.
  const auto engine = make_engine(instance, 0, 0);
  engine->place(instance.displacements_of(move));
  return engine->energy();
}

}  // namespace bn
