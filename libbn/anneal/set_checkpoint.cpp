#include "anneal/set_checkpoint.h"

#include <algorithm>

#include "anneal/checkpoint.h"

namespace bn::anneal {

using Clock = std::chrono::steady_clock;

SetCheckpoint::SetCheckpoint(const AnnealOptions& options, std::uint64_t fingerprint, std::size_t members)
    : options_(options), fingerprint_(fingerprint), members_(members), saved_(Clock::now()) {
  const std::string& resume = options.checkpoint.resume;
  if (!resume.empty()) members_ = decode_set_checkpoint(resume, fingerprint, members);
}

Checkpointing SetCheckpoint::of(std::size_t member) {
  Checkpointing one{.save = {}, .interval_s = options_.checkpoint.interval_s, .resume = members_[member]};
  if (options_.checkpoint.save) one.save = [this, member](std::string_view bytes) { keep(member, bytes); };
  return one;
}

void SetCheckpoint::save() {
  const std::lock_guard lock(mutex_);
  if (options_.checkpoint.save) save_locked();
}

void SetCheckpoint::keep(std::size_t member, std::string_view bytes) {
  const std::lock_guard lock(mutex_);
  members_[member] = bytes;
  // Half of a single run's limit: a member's own checkpoint may be as old again.
  constexpr double kLongest_s = 14.0;
  const double asked = options_.checkpoint.interval_s;
  const double interval = asked == 0.0 ? 0.0 : std::max(asked, std::min(kLongest_s, 50.0 * cost_s_));
  if (std::chrono::duration<double>(Clock::now() - saved_).count() >= interval) save_locked();
}

void SetCheckpoint::save_locked() {
  const auto start = Clock::now();
  options_.checkpoint.save(encode_set_checkpoint(fingerprint_, options_.proposals, members_));
  saved_ = Clock::now();
  cost_s_ = std::chrono::duration<double>(saved_ - start).count();
}

}  // namespace bn::anneal
