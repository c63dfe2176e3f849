#include "retarget/anneal_task.h"

#include "anneal/bytes.h"
#include "anneal/checkpoint.h"
#include "retarget/anneal_temperature.h"

namespace bn::retarget {
namespace {

anneal::Task task_of(const AnnealInstance& instance, const AnnealProblem& problem,
                     const AnnealOptions& options, const Execution& execution) {
  const std::int64_t pixels = instance.size.area();
  check_memory(execution,
               static_cast<std::uint64_t>(options.chains.count) * static_cast<std::uint64_t>(pixels) *
                   (24 + 16 * instance.weight.size()),
               "annealing");
  return {.make_engine = [&instance, seed = options.seed](
                             std::uint32_t chain) { return make_engine(instance, seed, chain); },
          .temperatures = anneal::temperatures_of(options, temperature_source(instance)),
          .proposals_per_sweep = pixels / 2,
          .slow = instance.residual_sigma_px > 0.0,
          .inert = instance.displacements.empty(),
          .fingerprint = fingerprint_of(problem, options)};
}

}  // namespace

std::uint64_t fingerprint_of(const AnnealProblem& problem, const AnnealOptions& options) {
  using anneal::put;
  std::string text;
  put(text, std::int64_t{kAnnealVersion});
  for (const AnnealChannel& channel : problem.channels) {
    put(text, std::int64_t{channel.levels.width()});
    put(text, std::int64_t{channel.weight});
    for (const Grid<std::int32_t>* grid : {&channel.levels, &channel.to}) {
      if (grid->count() == 0) continue;
      const char* levels = reinterpret_cast<const char*>(grid->data());
      put(text, anneal::hash_of({levels, grid->count() * sizeof(std::int32_t)}));
    }
  }
  put(text, std::int64_t{problem.depth}), put(text, std::int64_t{problem.step_z});
  const RetargetOptions& r = problem.retarget;
  for (const int value : {r.step.x, r.step.y, r.motion.x, r.motion.y, r.radius, static_cast<int>(r.reach),
                          static_cast<int>(r.metric), static_cast<int>(r.wrap)}) {
    put(text, std::int64_t{value});
  }
  anneal::put_proposal_options(text, options);
  put(text, problem.residual_sigma_px);
  anneal::put_budget_options(text, options);
  return anneal::hash_of(text);
}

RetargetRun::RetargetRun(const AnnealProblem& problem, const AnnealOptions& options,
                         const Execution& execution, AnnealTrace* trace)
    : instance_(problem, options.swap_distance_px),
      run_(task_of(instance_, problem, options, execution), options, execution, trace) {}

Placement RetargetRun::moves() const {
  return instance_.moves_of(static_cast<const RetargetEngine&>(run_.engine()).displacements());
}

AnnealResult RetargetRun::result(const anneal::RunResult& made) const {
  Placement move = instance_.moves_of(placement_of(instance_, made.state));
  instance_.check_moves(move);
  AnnealResult result;
  result.proposals = made.proposals;
  result.accepted = made.accepted;
  result.start_temperature = made.temperatures.start;
  result.end_temperature = made.temperatures.end;
  result.frozen = made.frozen;
  result.tile.move = std::move(move.xy);
  result.move_z = std::move(move.z);
  result.tile.start_energy = made.start_energy;
  result.tile.energy = made.energy;
  return result;
}

}  // namespace bn::retarget
