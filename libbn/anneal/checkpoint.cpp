#include "anneal/checkpoint.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "anneal/bytes.h"
#include "bn/error.h"

namespace bn {
namespace anneal {
namespace {

constexpr std::uint64_t kMagic = 0x323070636c6e6e61;     // "annlcp02"
constexpr std::uint64_t kSetMagic = 0x3230736d6c6e6e61;  // "annlms02"

template <class Progress, class Visit>
void for_each_field(Progress& p, Visit&& visit) {
  for (auto* field : {&p.step, &p.stage, &p.tried, &p.accepted, &p.changed, &p.frozen_stages}) visit(*field);
}

template <class Record, class Visit>
void for_each_number(Record& r, Visit&& visit) {
  for_each_field(r.cooling, visit);
  for (auto* field : {&r.round, &r.proposals, &r.accepted, &r.best_energy}) visit(*field);
}

void put_hash(std::string& bytes) { put(bytes, hash_of(bytes)); }

/// What follows the version, and precedes the hash, of bytes that are whole.
ByteReader whole(std::string_view bytes, std::uint64_t magic) {
  ByteReader header(bytes);
  if (header.take() != magic)
    refuse_checkpoint("it is not a checkpoint of such an annealing", "give the right file, or start afresh");
  if (header.take_signed() != kAnnealVersion)
    refuse_checkpoint("it is of another version of the algorithm", "start afresh");
  constexpr std::size_t kLeast = 6 * 8;
  if (bytes.size() < kLeast) refuse_checkpoint("it is cut short", "start afresh");
  const std::string_view body = bytes.substr(0, bytes.size() - 8);
  if (ByteReader(bytes.substr(body.size())).take() != hash_of(body)) {
    refuse_checkpoint("it is damaged or cut short", "start afresh");
  }
  return ByteReader(body.substr(16));
}

void expect_fingerprint(ByteReader& reader, std::uint64_t fingerprint) {
  if (reader.take() == fingerprint) return;
  refuse_checkpoint("it belongs to another problem or other options",
                    "give the options it was made with, or start afresh");
}

}  // namespace

void refuse_checkpoint(std::string what, std::string remedy) {
  throw Error({.code = ErrorCode::invalid_input,
               .what = std::move(what),
               .where = "checkpoint",
               .limit = "a checkpoint of the same problem and options, whole",
               .remedy = std::move(remedy)});
}

std::uint64_t hash_of(std::string_view bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

void put_proposal_options(std::string& bytes, const AnnealOptions& options) {
  for (const int value : {options.swap_distance_px, options.chains.count,
                          static_cast<int>(options.chains.coupling), static_cast<int>(options.start.rule)}) {
    put(bytes, std::int64_t{value});
  }
}

void put_budget_options(std::string& bytes, const AnnealOptions& options) {
  put(bytes, options.start.value), put(bytes, options.end_temperature);
  put(bytes, options.proposals);
  put(bytes, options.seed);
  if (options.stop_after > 0) put(bytes, options.stop_after);
  bytes += options.schedule;
  const ScheduleParameters& p = options.parameters;
  put(bytes, p.factor), put(bytes, p.slope), put(bytes, p.hajek_c), put(bytes, p.stages);
  put(bytes, p.accepted_per_stage), put(bytes, p.tried_per_stage), put(bytes, p.frozen_stages);
}

std::string encode_checkpoint(std::uint64_t fingerprint, const RunRecord& record) {
  std::string bytes;
  put(bytes, kMagic);
  put(bytes, std::int64_t{kAnnealVersion});
  put(bytes, fingerprint);
  put(bytes, record.proposals);
  put(bytes, static_cast<std::uint64_t>(record.chains.size()));
  put(bytes, record.slices);
  for (const ChainRecord& chain : record.chains) {
    for_each_number(chain, [&](std::int64_t value) { put(bytes, value); });
    bytes += chain.now;
    bytes += chain.best;
  }
  put_hash(bytes);
  return bytes;
}

RunRecord decode_checkpoint(std::string_view bytes, std::uint64_t fingerprint, std::size_t chains,
                            std::size_t state_bytes) {
  ByteReader reader = whole(bytes, kMagic);
  expect_fingerprint(reader, fingerprint);
  RunRecord record{.proposals = reader.take_signed(), .chains = {}};
  if (reader.take() != chains) refuse_checkpoint("it has another number of chains", "start afresh");
  record.slices = reader.take_signed();
  for (std::size_t c = 0; c < chains; ++c) {
    ChainRecord& chain = record.chains.emplace_back();
    for_each_number(chain, [&](std::int64_t& value) {
      value = reader.take_signed();
      if (value < 0) refuse_checkpoint("it holds a negative count", "start afresh");
    });
    chain.now = reader.take(state_bytes);
    chain.best = reader.take(state_bytes);
  }
  if (!reader.empty()) refuse_checkpoint("it is too long", "start afresh");
  return record;
}

std::string encode_set_checkpoint(std::uint64_t fingerprint, std::int64_t proposals,
                                  const std::vector<std::string>& members) {
  std::string bytes;
  put(bytes, kSetMagic);
  put(bytes, std::int64_t{kAnnealVersion});
  put(bytes, fingerprint);
  put(bytes, proposals);
  put(bytes, static_cast<std::uint64_t>(members.size()));
  for (const std::string& member : members) {
    put(bytes, static_cast<std::uint64_t>(member.size()));
    bytes += member;
  }
  put_hash(bytes);
  return bytes;
}

std::vector<std::string> decode_set_checkpoint(std::string_view bytes, std::uint64_t fingerprint,
                                               std::size_t members) {
  ByteReader reader = whole(bytes, kSetMagic);
  expect_fingerprint(reader, fingerprint);
  reader.take();
  if (reader.take() != members) refuse_checkpoint("it has another number of motions", "start afresh");
  std::vector<std::string> result;
  for (std::size_t i = 0; i < members; ++i) result.emplace_back(reader.take(reader.take()));
  if (!reader.empty()) refuse_checkpoint("it is too long", "start afresh");
  return result;
}

}  // namespace anneal

std::int64_t checkpoint_proposals(std::string_view checkpoint) {
  using namespace anneal;
  const bool of_set = ByteReader(checkpoint).take() == kSetMagic;
  ByteReader reader = whole(checkpoint, of_set ? kSetMagic : kMagic);
  reader.take();
  return reader.take_signed();
}

}  // namespace bn
