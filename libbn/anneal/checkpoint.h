// The state of a run between two slices, as bytes: what a resumed run needs to make the same bytes as one
// that was never stopped.
//
// Layout, all integers little-endian 64 bit: magic, version, fingerprint of problem and options, budget,
// number of chains, slices done; per chain the fields of ChainRecord, then its states now and best, as its
// engine saved them; last an XXH3 of all before. Bytes that differ from this in anything are refused whole.
//
// A set of runs, made side by side, has a checkpoint that holds those of its members, the finished ones' too
// (they resume to their end at once): another magic, version, fingerprint, budget, number of members; of each
// its length, 0 if it has not begun, and its bytes; XXH3.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "anneal/cooling.h"

namespace bn::anneal {

struct ChainRecord {
  Cooling::Progress cooling;
  std::int64_t round = 0;
  std::int64_t proposals = 0;
  std::int64_t accepted = 0;
  std::int64_t best_energy = 0;
  std::string now;   ///< as Engine::save() gives it
  std::string best;  ///< as Engine::save_kept() gives it
};

struct RunRecord {
  std::int64_t proposals = 0;  ///< the budget of each chain
  std::int64_t slices = 0;
  std::vector<ChainRecord> chains;
};

/// Appends to the bytes of a fingerprint what a run's result depends on, in two parts: how proposals are
/// drawn and coupled; temperatures, budget and schedule. A room puts its problem before and between them.
void put_proposal_options(std::string& bytes, const AnnealOptions& options);
void put_budget_options(std::string& bytes, const AnnealOptions& options);
std::uint64_t hash_of(std::string_view bytes);

std::string encode_checkpoint(std::uint64_t fingerprint, const RunRecord& record);

/// Throws invalid_input for bytes that are cut short, changed, of another version, or of another run. The
/// states are only known to be `state_bytes` long.
RunRecord decode_checkpoint(std::string_view bytes, std::uint64_t fingerprint, std::size_t chains,
                            std::size_t state_bytes);

std::string encode_set_checkpoint(std::uint64_t fingerprint, std::int64_t proposals,
                                  const std::vector<std::string>& members);

/// The members' checkpoints; errors as of decode_checkpoint().
std::vector<std::string> decode_set_checkpoint(std::string_view bytes, std::uint64_t fingerprint,
                                               std::size_t members);

}  // namespace bn::anneal
