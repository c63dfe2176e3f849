// The state of a run between two beats, as bytes: what a resumed run needs to make the same bytes as one
// that was never stopped.
//
// Layout, all integers little-endian 64 bit: magic, version, fingerprint of problem and options, budget,
// number of chains, beats done; per chain the fields of ChainRecord, then its placements now and best, one
// signed byte per axis and pixel (all x and y, then a volume's z); last an XXH3 of all before. Anything else
// is refused whole.
//
// A motion set's checkpoint holds those of its variants, the finished ones' too (they resume to their end
// at once): another magic, version, fingerprint, budget, number of variants; of each its length, 0 if it has
// not begun, and its bytes; XXH3.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "retarget/anneal_instance.h"
#include "retarget/cooling.h"

namespace bn::retarget {

struct ChainRecord {
  Cooling::Progress cooling;
  std::int64_t round = 0;
  std::int64_t proposals = 0;
  std::int64_t accepted = 0;
  std::int64_t best_energy = 0;
  Placement now;
  Placement best;
};

struct RunRecord {
  std::int64_t proposals = 0;  ///< the budget of each chain
  std::int64_t beats = 0;
  std::vector<ChainRecord> chains;
};

/// Over everything that a run's bytes depend on: the levels, the problem's and the run's options.
std::uint64_t fingerprint_of(const AnnealProblem& problem, const AnnealOptions& options);

std::string encode_checkpoint(std::uint64_t fingerprint, const RunRecord& record);

/// Throws invalid_input for bytes that are cut short, changed, of another version, or of another run.
RunRecord decode_checkpoint(std::string_view bytes, std::uint64_t fingerprint, std::size_t chains,
                            const AnnealInstance& instance);

std::string encode_set_checkpoint(std::uint64_t fingerprint, std::int64_t proposals,
                                  const std::vector<std::string>& variants);

/// The variants' checkpoints; errors as of decode_checkpoint().
std::vector<std::string> decode_set_checkpoint(std::string_view bytes, std::uint64_t fingerprint,
                                               std::size_t variants);

}  // namespace bn::retarget
