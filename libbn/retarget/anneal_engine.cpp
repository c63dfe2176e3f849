// A placement's way into bytes and back, for checkpoints and exchanges between chains.

#include "retarget/anneal_engine.h"

#include "anneal/bytes.h"
#include "bn/error.h"

namespace bn::retarget {

std::string placement_bytes(const Placement& displacement_at) {
  std::string bytes;
  bytes.reserve(2 * displacement_at.xy.count() + displacement_at.z.count());
  for (const Offset k : displacement_at.xy) {
    bytes.push_back(static_cast<char>(k.x));
    bytes.push_back(static_cast<char>(k.y));
  }
  for (const std::int8_t z : displacement_at.z) bytes.push_back(static_cast<char>(z));
  return bytes;
}

Placement placement_of(const AnnealInstance& instance, std::string_view bytes) {
  Placement placement = instance.identity();
  const std::size_t pixels = placement.xy.count();
  for (std::size_t i = 0; i < pixels; ++i) {
    placement.xy[i] = {static_cast<signed char>(bytes[2 * i]), static_cast<signed char>(bytes[2 * i + 1])};
  }
  for (std::size_t i = 0; i < placement.z.count(); ++i)
    placement.z[i] = static_cast<std::int8_t>(bytes[2 * pixels + i]);
  return placement;
}

std::size_t RetargetEngine::state_bytes() const {
  return static_cast<std::size_t>(instance_.size.area()) * (instance_.depth > 1 ? 3 : 2);
}

void RetargetEngine::load(std::string_view state) { place(placement_of(instance_, state)); }

void RetargetEngine::check_state(std::string_view state) const {
  // The checkpoint's hash guards against accidents; this one keeps a forged file from breaking a promise.
  try {
    instance_.check_moves(instance_.moves_of(placement_of(instance_, state)));
  } catch (const Error& error) {
    anneal::refuse_checkpoint(std::string("its placement is none: ") + error.what(), "start afresh");
  }
}

}  // namespace bn::retarget
