#include "retarget/anneal_checkpoint.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <bit>
#include <type_traits>

#include "bn/error.h"

namespace bn {
namespace retarget {
namespace {

constexpr std::uint64_t kMagic = 0x323070636c6e6e61;     // "annlcp02"
constexpr std::uint64_t kSetMagic = 0x3230736d6c6e6e61;  // "annlms02"

[[noreturn]] void refuse(std::string what, std::string remedy) {
  throw Error({.code = ErrorCode::invalid_input,
               .what = std::move(what),
               .where = "checkpoint",
               .limit = "a checkpoint of the same problem and options, whole",
               .remedy = std::move(remedy)});
}

void put(std::string& bytes, std::uint64_t value) {
  for (int i = 0; i < 8; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 255));
}
void put(std::string& bytes, std::int64_t value) { put(bytes, static_cast<std::uint64_t>(value)); }
void put(std::string& bytes, double value) { put(bytes, std::bit_cast<std::uint64_t>(value)); }

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}
  std::uint64_t take() {
    need(8);
    std::uint64_t value = 0;
    for (int i = 0; i < 8; ++i)
      value |= std::uint64_t{static_cast<unsigned char>(bytes_[static_cast<std::size_t>(i)])} << (8 * i);
    bytes_.remove_prefix(8);
    return value;
  }
  std::int64_t take_signed() { return static_cast<std::int64_t>(take()); }
  std::string_view take(std::size_t count) {
    need(count);
    const auto taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  bool empty() const { return bytes_.empty(); }

 private:
  void need(std::size_t count) const {
    if (bytes_.size() < count) refuse("it is cut short", "start afresh");
  }
  std::string_view bytes_;
};

template <class Progress, class Visit>
void for_each_field(Progress& p, Visit&& visit) {
  for (auto* field : {&p.step, &p.stage, &p.tried, &p.accepted, &p.changed, &p.frozen_stages}) visit(*field);
}

template <class Record, class Visit>
void for_each_number(Record& r, Visit&& visit) {
  for_each_field(r.cooling, visit);
  for (auto* field : {&r.round, &r.proposals, &r.accepted, &r.best_energy}) visit(*field);
}

void put(std::string& bytes, const Placement& placement) {
  for (const Offset k : placement.xy) {
    bytes.push_back(static_cast<char>(k.x));
    bytes.push_back(static_cast<char>(k.y));
  }
  for (const std::int8_t z : placement.z) bytes.push_back(static_cast<char>(z));
}

Placement take_placement(Reader& reader, const AnnealInstance& instance) {
  Placement placement = instance.identity();
  const std::string_view bytes = reader.take(2 * placement.xy.count());
  for (std::size_t i = 0; i < placement.xy.count(); ++i) {
    placement.xy[i] = {static_cast<signed char>(bytes[2 * i]), static_cast<signed char>(bytes[2 * i + 1])};
  }
  const std::string_view deep = reader.take(placement.z.count());
  for (std::size_t i = 0; i < placement.z.count(); ++i) placement.z[i] = static_cast<std::int8_t>(deep[i]);
  // The hash guards against accidents; this one keeps a forged file from breaking a promise.
  try {
    instance.check_moves(instance.moves_of(placement));
  } catch (const Error& error) {
    refuse(std::string("its placement is none: ") + error.what(), "start afresh");
  }
  return placement;
}

template <class T>
void put(std::string& bytes, const std::optional<T>& value) {
  put(bytes, std::int64_t{value.has_value()});
  if constexpr (std::is_floating_point_v<T>) {
    put(bytes, value.value_or(0.0));
  } else {
    put(bytes, std::int64_t{value.value_or(0)});
  }
}

void put(std::string& bytes, const CoolingSchedule& schedule) {
  put(bytes, static_cast<std::uint64_t>(schedule.index()));
  struct Put {
    std::string& bytes;
    void operator()(const ConstantCooling& s) const { put(bytes, s.temperature); }
    void operator()(const GreedyCooling&) const {}
    void operator()(const HajekCooling& s) const { put(bytes, s.c); }
    void operator()(const LinearCooling& s) const {
      put(bytes, s.start), put(bytes, s.slope), put(bytes, s.end);
    }
    void operator()(const ExponentialCooling& s) const { put(bytes, s.start), put(bytes, s.factor); }
    void operator()(const InverseCooling& s) const { put(bytes, s.start), put(bytes, s.factor); }
    void operator()(const KirkpatrickCooling& s) const {
      put(bytes, s.start), put(bytes, s.factor), put(bytes, s.accepted_per_stage),
          put(bytes, s.tried_per_stage);
      put(bytes, std::int64_t{s.frozen_stages}), put(bytes, s.end), put(bytes, std::int64_t{s.stages});
    }
  };
  std::visit(Put{bytes}, schedule);
}

void put_hash(std::string& bytes) { put(bytes, std::uint64_t{XXH3_64bits(bytes.data(), bytes.size())}); }

/// What follows the version, and precedes the hash, of bytes that are whole.
Reader whole(std::string_view bytes, std::uint64_t magic) {
  Reader header(bytes);
  if (header.take() != magic)
    refuse("it is not a checkpoint of such an annealing", "give the right file, or start afresh");
  if (header.take_signed() != kAnnealVersion)
    refuse("it is of another version of the algorithm", "start afresh");
  constexpr std::size_t kLeast = 6 * 8;
  if (bytes.size() < kLeast) refuse("it is cut short", "start afresh");
  const std::string_view body = bytes.substr(0, bytes.size() - 8);
  if (Reader(bytes.substr(body.size())).take() != XXH3_64bits(body.data(), body.size())) {
    refuse("it is damaged or cut short", "start afresh");
  }
  return Reader(body.substr(16));
}

void expect_fingerprint(Reader& reader, std::uint64_t fingerprint) {
  if (reader.take() == fingerprint) return;
  refuse("it belongs to another problem or other options",
         "give the options it was made with, or start afresh");
}

}  // namespace

std::uint64_t fingerprint_of(const AnnealProblem& problem, const AnnealOptions& options) {
  std::string text;
  put(text, std::int64_t{kAnnealVersion});
  for (const AnnealChannel& channel : problem.channels) {
    put(text, std::int64_t{channel.levels.width()});
    put(text, std::int64_t{channel.weight});
    put(text,
        std::uint64_t{XXH3_64bits(channel.levels.data(), channel.levels.count() * sizeof(std::int32_t))});
  }
  put(text, std::int64_t{problem.depth}), put(text, std::int64_t{problem.step_z});
  const RetargetOptions& r = problem.retarget;
  for (const int value :
       {r.step.x, r.step.y, r.motion.x, r.motion.y, r.radius, static_cast<int>(r.reach),
        static_cast<int>(r.metric), static_cast<int>(r.wrap), options.swap_distance_px, options.chains.count,
        static_cast<int>(options.chains.coupling), static_cast<int>(options.start.rule)}) {
    put(text, std::int64_t{value});
  }
  for (const double value : {problem.residual_sigma_px, options.start.value, options.end_temperature})
    put(text, value);
  put(text, options.proposals);
  put(text, options.seed);
  if (options.stop_after > 0) put(text, options.stop_after);
  text += options.schedule;
  const ScheduleParameters& p = options.parameters;
  put(text, p.factor), put(text, p.slope), put(text, p.hajek_c), put(text, p.stages);
  put(text, p.accepted_per_stage), put(text, p.tried_per_stage), put(text, p.frozen_stages);
  if (options.custom) put(text, *options.custom);
  return XXH3_64bits(text.data(), text.size());
}

std::string encode_checkpoint(std::uint64_t fingerprint, const RunRecord& record) {
  std::string bytes;
  put(bytes, kMagic);
  put(bytes, std::int64_t{kAnnealVersion});
  put(bytes, fingerprint);
  put(bytes, record.proposals);
  put(bytes, static_cast<std::uint64_t>(record.chains.size()));
  put(bytes, record.beats);
  for (const ChainRecord& chain : record.chains) {
    for_each_number(chain, [&](std::int64_t value) { put(bytes, value); });
    put(bytes, chain.now);
    put(bytes, chain.best);
  }
  put_hash(bytes);
  return bytes;
}

RunRecord decode_checkpoint(std::string_view bytes, std::uint64_t fingerprint, std::size_t chains,
                            const AnnealInstance& instance) {
  Reader reader = whole(bytes, kMagic);
  expect_fingerprint(reader, fingerprint);
  RunRecord record{.proposals = reader.take_signed(), .chains = {}};
  if (reader.take() != chains) refuse("it has another number of chains", "start afresh");
  record.beats = reader.take_signed();
  for (std::size_t c = 0; c < chains; ++c) {
    ChainRecord& chain = record.chains.emplace_back();
    for_each_number(chain, [&](std::int64_t& value) {
      value = reader.take_signed();
      if (value < 0) refuse("it holds a negative count", "start afresh");
    });
    chain.now = take_placement(reader, instance);
    chain.best = take_placement(reader, instance);
  }
  if (!reader.empty()) refuse("it is too long", "start afresh");
  return record;
}

std::string encode_set_checkpoint(std::uint64_t fingerprint, std::int64_t proposals,
                                  const std::vector<std::string>& variants) {
  std::string bytes;
  put(bytes, kSetMagic);
  put(bytes, std::int64_t{kAnnealVersion});
  put(bytes, fingerprint);
  put(bytes, proposals);
  put(bytes, static_cast<std::uint64_t>(variants.size()));
  for (const std::string& variant : variants) {
    put(bytes, static_cast<std::uint64_t>(variant.size()));
    bytes += variant;
  }
  put_hash(bytes);
  return bytes;
}

std::vector<std::string> decode_set_checkpoint(std::string_view bytes, std::uint64_t fingerprint,
                                               std::size_t variants) {
  Reader reader = whole(bytes, kSetMagic);
  expect_fingerprint(reader, fingerprint);
  reader.take();
  if (reader.take() != variants) refuse("it has another number of motions", "start afresh");
  std::vector<std::string> result;
  for (std::size_t i = 0; i < variants; ++i) result.emplace_back(reader.take(reader.take()));
  if (!reader.empty()) refuse("it is too long", "start afresh");
  return result;
}

}  // namespace retarget

std::int64_t checkpoint_proposals(std::string_view checkpoint) {
  using namespace retarget;
  const bool of_set = Reader(checkpoint).take() == kSetMagic;
  Reader reader = whole(checkpoint, of_set ? kSetMagic : kMagic);
  reader.take();
  return reader.take_signed();
}

}  // namespace bn
