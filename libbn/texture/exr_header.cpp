// A walk over the header of an EXR file before OpenEXR sees it.
//
// OpenEXR takes as much memory as an attribute's length asks for, up to 2 GiB, before it looks whether
// the file is that long; a file of 50 bytes can make it. A header is a list of attributes (name, type,
// length, value) that ends with an empty name; a file of many parts has a list of headers that ends
// with an empty one. The walk checks that each value lies inside the file. For that it must step as
// OpenEXR does, which ignores the length of the types it knows and reads what those take: so
// these lengths have to be right here.

#include <algorithm>
#include <cstring>
#include <string_view>

#include "texture/codec.h"
#include "texture/error.h"
#include "texture/image.h"

namespace bn::texture {
namespace {

/// Types whose values have one length.
constexpr std::pair<std::string_view, std::uint32_t> kFixedLengths[] = {
    {"box2f", 16},
    {"box2i", 16},
    {"chromaticities", 32},
    {"compression", 1},
    {"deepImageState", 1},
    {"double", 8},
    {"envmap", 1},
    {"float", 4},
    {"int", 4},
    {"keycode", 28},
    {"lineOrder", 1},
    {"m33d", 72},
    {"m33f", 36},
    {"m44d", 128},
    {"m44f", 64},
    {"rational", 8},
    {"tiledesc", 9},
    {"timecode", 8},
    {"v2d", 16},
    {"v2f", 8},
    {"v2i", 8},
    {"v3d", 24},
    {"v3f", 12},
    {"v3i", 12},
};

/// Steps through bytes; every step says whether they were there.
class Walk {
 public:
  explicit Walk(ByteView bytes) : rest_(bytes) {}

  bool skip(std::uint64_t count) { return take(count).has_value(); }

  std::optional<ByteView> take(std::uint64_t count) {
    if (count > rest_.size()) return std::nullopt;
    const ByteView taken = rest_.first(static_cast<std::size_t>(count));
    rest_ = rest_.subspan(static_cast<std::size_t>(count));
    return taken;
  }

  /// A text that ends with a zero, without it.
  std::optional<std::string_view> text() {
    const auto end = std::find(rest_.begin(), rest_.end(), std::byte{0});
    if (end == rest_.end()) return std::nullopt;
    const auto taken = take(static_cast<std::uint64_t>(end - rest_.begin()) + 1);
    return std::string_view(reinterpret_cast<const char*>(taken->data()), taken->size() - 1);
  }

  std::optional<std::uint32_t> number() {
    const auto taken = take(4);
    if (!taken) return std::nullopt;
    std::uint32_t value = 0;
    std::memcpy(&value, taken->data(), sizeof value);
    return value;
  }

  bool at_end() const { return rest_.empty(); }
  bool at_zero() const { return rest_.empty() || rest_[0] == std::byte{0}; }

 private:
  ByteView rest_;
};

/// Channels: a name, the type of the samples and 12 bytes each; an empty name ends them, exactly where the
/// value ends. There are three types; OpenImageIO ends the program at another one.
bool is_channel_list(ByteView value) {
  constexpr std::uint32_t kSampleTypes = 3;
  Walk walk(value);
  while (const auto name = walk.text()) {
    if (name->empty()) return walk.at_end();
    const auto type = walk.number();
    if (!type || *type >= kSampleTypes || !walk.skip(12)) return false;
  }
  return false;
}

/// Width, height and that many pixels of 4 bytes.
bool is_preview(ByteView value) {
  Walk walk(value);
  const auto width = walk.number(), height = walk.number();
  return width && height && *width <= 65536 && *height <= 65536 &&
         value.size() == 8 + std::uint64_t{4} * *width * *height;
}

bool skip_attribute(Walk& walk) {
  const auto type = walk.text();
  if (!type) return false;
  const auto length = walk.number();
  if (!length) return false;
  const auto value = walk.take(*length);
  if (!value) return false;
  if (*type == "chlist") return is_channel_list(*value);
  if (*type == "preview") return is_preview(*value);
  for (const auto& [name, fixed] : kFixedLengths) {
    if (*type == name) return *length == fixed;
  }
  return true;
}

bool skip_header(Walk& walk) {
  while (const auto name = walk.text()) {
    if (name->empty()) return true;
    if (!skip_attribute(walk)) return false;
  }
  return false;
}

/// How many headers there are; 0 if one does not fit.
int count_headers(ByteView bytes) {
  constexpr std::size_t kVersionFlags = 5;
  constexpr std::byte kManyParts{0x10};
  Walk walk(bytes);
  if (!walk.skip(8)) return 0;  // the signature and the version
  if (!skip_header(walk)) return 0;
  if ((bytes[kVersionFlags] & kManyParts) == std::byte{0}) return 1;
  int count = 1;
  for (; !walk.at_zero(); ++count) {
    if (!skip_header(walk)) return 0;
  }
  return count;
}

}  // namespace

int exr_parts(ByteView bytes, const std::string& name) {
  const int count = count_headers(bytes);
  if (count == 0) fail_input(name, "cannot be decoded: its EXR header is cut short or corrupt");
  check_depth(count, name);
  return count;
}

}  // namespace bn::texture
