// Numbers as bytes, little-endian 64 bit, and back: what checkpoints and fingerprints are made of.

#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

namespace bn::anneal {

/// Throws invalid_input: these bytes are no checkpoint that can be used, and why.
[[noreturn]] void refuse_checkpoint(std::string what, std::string remedy);

inline void put(std::string& bytes, std::uint64_t value) {
  for (int i = 0; i < 8; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 255));
}
inline void put(std::string& bytes, std::int64_t value) { put(bytes, static_cast<std::uint64_t>(value)); }
inline void put(std::string& bytes, double value) { put(bytes, std::bit_cast<std::uint64_t>(value)); }

template <class T>
void put(std::string& bytes, const std::optional<T>& value) {
  put(bytes, std::int64_t{value.has_value()});
  if constexpr (std::is_floating_point_v<T>) {
    put(bytes, value.value_or(0.0));
  } else {
    put(bytes, std::int64_t{value.value_or(0)});
  }
}

/// Takes values from the front of bytes. Refuses bytes that end too early.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}
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
    if (bytes_.size() < count) refuse_checkpoint("it is cut short", "start afresh");
  }
  std::string_view bytes_;
};

}  // namespace bn::anneal
