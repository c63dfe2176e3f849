// A retarget entry that is annealed: its problem for bn/anneal.h, its checkpoint file, its lower bounds.

#include <fmt/format.h>

#include <algorithm>

#include "bake/kinds/retarget_source.h"
#include "bn/error.h"

namespace bn::baking {
namespace {

namespace fs = std::filesystem;

/// The bytes of a checkpoint file; empty if there is none.
std::string read_checkpoint(const fs::path& path) {
  if (path.empty() || !fs::exists(path)) return {};
  std::string bytes = read_text_file(path);
  // An empty file is no checkpoint; let the annealer say so.
  return bytes.empty() ? std::string(1, '\0') : bytes;
}

/// Calls `body`; what it throws about a checkpoint then names the file.
template <class Body>
auto naming_checkpoint(const fs::path& path, Body body) {
  try {
    return body();
  } catch (const Error& error) {
    ErrorInfo info = error.info();
    if (info.where != "checkpoint" || path.empty()) throw;
    info.where = path.string();
    info.remedy = "remove it to start afresh, or give the options it was made with";
    throw Error(info);
  }
}

/// Slices one below the other, as an AnnealProblem has a volume.
Grid<std::int32_t> stacked(const Grid<std::int32_t>& volume) {
  Grid<std::int32_t> stack(Extent{volume.width(), volume.height() * volume.depth()});
  std::copy(volume.begin(), volume.end(), stack.begin());
  return stack;
}

}  // namespace

AnnealProblem anneal_problem(const RetargetEntry& entry, const Source& source) {
  const AnnealMethod& method = entry.anneal;
  AnnealProblem problem;
  for (std::size_t c = 0; c < source.levels.size(); ++c) {
    FrameMasks masks{entry.volume ? stacked(source.levels[c].value) : Grid<std::int32_t>(), {}};
    if (entry.volume && !source.to.empty()) masks.to = stacked(source.to[c].value);
    if (!entry.volume) {
      masks = frame_masks(source, 0, c);
      if (source.moves()) masks.to = {};
    }
    problem.channels.push_back({.levels = std::move(masks.from),
                                .weight = method.weights.empty() ? 1 : method.weights.at(c),
                                .to = std::move(masks.to)});
  }
  if (entry.volume) {
    problem.depth = source.depth();
    problem.step_z = entry.step_z;
  }
  problem.retarget = entry.problem;
  problem.retarget.step = step_of(entry, source);
  problem.retarget.motion = {0, 0};
  problem.residual_sigma_px = method.residual_sigma_px;
  return problem;
}

std::int64_t energy_of(const RetargetEntry& entry, const Source& source, int z, const Grid<Offset>& move,
                       const Grid<std::int8_t>& move_z, const RetargetOptions& options) {
  if (!entry.anneals) return retarget_energy(frame_masks(source, z), move, options);
  AnnealProblem problem = anneal_problem(entry, source);
  problem.retarget = options;
  return anneal_energy(problem, move, move_z);
}

std::vector<std::int64_t> anneal_bounds(const AnnealProblem& problem, int motion, double gap,
                                        const Execution& execution) {
  const std::size_t side = static_cast<std::size_t>(2 * motion + 1);
  std::vector<std::int64_t> bounds(side * side, 0);
  if (problem.residual_sigma_px > 0.0 || problem.depth > 1) return bounds;
  RetargetOptions options = problem.retarget;
  options.gap = gap;
  Execution silent = execution;
  silent.progress = {};
  for (const AnnealChannel& channel : problem.channels) {
    const std::vector<RetargetTile> proofs = solve_motion_set(channel.masks(), options, motion, silent);
    for (std::size_t i = 0; i < bounds.size(); ++i) bounds[i] += channel.weight * proofs[i].lower_bound;
  }
  return bounds;
}

std::vector<MadeTile> anneal_tiles(const RetargetEntry& entry, const Source& source,
                                   const Execution& execution) {
  const AnnealMethod& method = entry.anneal;
  const AnnealProblem problem = anneal_problem(entry, source);
  AnnealOptions options = method.options;
  options.checkpoint = {};
  if (!method.checkpoint.empty()) {
    options.checkpoint.resume = read_checkpoint(method.checkpoint);
    options.checkpoint.save = [&](std::string_view bytes) { write_text_file(method.checkpoint, bytes); };
  }
  std::vector<AnnealResult> results = naming_checkpoint(method.checkpoint, [&] {
    if (entry.motion > 0) return anneal_motion_set(problem, options, entry.motion, execution);
    std::vector<AnnealResult> one;
    one.push_back(anneal_retarget(problem, options, execution, method.trace));
    return one;
  });
  // A certificate within 1 % comes soon.
  const std::vector<std::int64_t> bounds = anneal_bounds(problem, entry.motion, 0.01, execution);
  std::vector<MadeTile> tiles;
  for (std::size_t i = 0; i < results.size(); ++i) {
    results[i].tile.lower_bound = bounds[i];
    tiles.push_back({std::move(results[i].tile), std::move(results[i].move_z)});
  }
  return tiles;
}

RetargetEntry with_budget_found(const RetargetEntry& entry, const Source& source,
                                const Execution& execution) {
  RetargetEntry found = entry;
  AnnealMethod& method = found.anneal;
  const std::string checkpoint = read_checkpoint(method.checkpoint);
  if (!checkpoint.empty()) {
    method.options.proposals =
        naming_checkpoint(method.checkpoint, [&] { return checkpoint_proposals(checkpoint); });
  } else {
    Execution silent = execution;
    silent.progress = {};
    if (entry.motion > 0) silent.threads = 1;
    method.options.proposals =
        proposals_for(method.seconds, anneal_problem(entry, source), method.options, silent);
  }
  method.seconds = 0.0;
  return found;
}

}  // namespace bn::baking
