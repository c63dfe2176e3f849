// How many pages a TIFF has: a walk along its chain of directories, before libtiff sees it. The chain of a
// hostile file may go round in a circle, or be long for few bytes.

#include <fmt/format.h>
#include <cstring>

#include "texture/codec.h"
#include "texture/error.h"

namespace bn::texture {
namespace {

/// libtiff walks the chain from its beginning for each page.
constexpr int kMaxPages = 4096;

class Walk {
 public:
  explicit Walk(ByteView bytes) : bytes_(bytes) {
    big_endian_ = bytes[0] == std::byte{'M'};
    wide_ = number(2, 2) == 43;  // BigTIFF
  }

  /// A whole number of `count` bytes; 0 beyond the end of the file, where every chain ends.
  std::uint64_t number(std::uint64_t at, std::size_t count) const {
    if (at > bytes_.size() || bytes_.size() - at < count) return 0;
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t k = big_endian_ ? i : count - 1 - i;
      value = value << 8 | std::to_integer<std::uint64_t>(bytes_[at + k]);
    }
    return value;
  }

  std::uint64_t first() const { return wide_ ? number(8, 8) : number(4, 4); }

  std::uint64_t next(std::uint64_t directory) const {
    if (directory > bytes_.size()) return 0;
    const std::uint64_t entries = number(directory, wide_ ? 8 : 2);
    if (entries > bytes_.size()) return 0;
    return wide_ ? number(directory + 8 + 20 * entries, 8) : number(directory + 2 + 12 * entries, 4);
  }

 private:
  ByteView bytes_;
  bool big_endian_ = false, wide_ = false;
};

}  // namespace

int tiff_pages(ByteView bytes, const std::string& name) {
  if (bytes.size() < 8) fail_input(name, "cut short in its header");
  const Walk walk(bytes);
  int pages = 0;
  for (std::uint64_t directory = walk.first(); directory != 0; directory = walk.next(directory)) {
    if (++pages > kMaxPages) {
      fail_input(name, fmt::format("more than {} pages", kMaxPages), fmt::format("1..{}", kMaxPages),
                 "the file is corrupt, or store a picture a file");
    }
  }
  return std::max(1, pages);
}

}  // namespace bn::texture
