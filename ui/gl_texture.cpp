#include "ui/gl_texture.h"

#include <algorithm>
#include <utility>

#include "ui/gl.h"

namespace bn::ui {
namespace {

Extent level_size(Extent size, std::size_t level) {
  return {std::max(1, size.width >> level), std::max(1, size.height >> level)};
}

/// The mean of four packed colours, channel by channel, two channels at a time.
std::uint32_t mean_of(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  constexpr std::uint32_t kEven = 0x00FF00FF, kHalf = 0x00020002;
  const std::uint32_t even = (a & kEven) + (b & kEven) + (c & kEven) + (d & kEven) + kHalf;
  const std::uint32_t odd =
      ((a >> 8) & kEven) + ((b >> 8) & kEven) + ((c >> 8) & kEven) + ((d >> 8) & kEven) + kHalf;
  return ((even >> 2) & kEven) | (((odd >> 2) & kEven) << 8);
}

}  // namespace

MipLevels with_halvings(Extent size, std::vector<std::uint32_t> texels) {
  MipLevels levels{.size = size, .texels = {}};
  levels.texels.push_back(std::move(texels));
  for (Extent from = size; from.width > 1 || from.height > 1;) {
    const Extent to = level_size(from, 1);
    const std::vector<std::uint32_t>& source = levels.texels.back();
    std::vector<std::uint32_t> half(static_cast<std::size_t>(to.area()));
    for (int y = 0; y < to.height; ++y) {
      const auto row = [&](int i) {
        return &source[static_cast<std::size_t>(std::min(2 * y + i, from.height - 1)) *
                       static_cast<std::size_t>(from.width)];
      };
      const std::uint32_t *upper = row(0), *lower = row(1);
      std::uint32_t* out = &half[static_cast<std::size_t>(y) * static_cast<std::size_t>(to.width)];
      for (int x = 0; x < to.width; ++x) {
        const int left = 2 * x, right = std::min(2 * x + 1, from.width - 1);
        out[x] = mean_of(upper[left], upper[right], lower[left], lower[right]);
      }
    }
    levels.texels.push_back(std::move(half));
    from = to;
  }
  return levels;
}

void GlTexture::allocate(Name& texture, Extent size) const {
  if (texture.name == 0) glGenTextures(1, &texture.name);
  glBindTexture(GL_TEXTURE_2D, texture.name);
  if (size == texture.size) return;
  texture.size = size;
  // Filters and the number of levels first, so that the driver makes room for all of them at once.
  const std::size_t count = coming_levels_.texels.size();
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, nearest_ ? GL_NEAREST : GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(count) - 1);
  for (std::size_t level = 0; level < count; ++level) {
    const Extent side = level_size(size, level);
    glTexImage2D(GL_TEXTURE_2D, static_cast<GLint>(level), GL_RGBA8, side.width, side.height, 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, nullptr);
  }
}

void GlTexture::begin(MipLevels levels) {
  coming_levels_ = std::move(levels);
  level_ = 0;
  row_ = 0;
}

void GlTexture::advance() {
  if (!pending()) return;
  allocate(coming_, coming_levels_.size);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  std::size_t left = kBytesPerStep;
  while (level_ < coming_levels_.texels.size()) {
    const Extent side = level_size(coming_levels_.size, level_);
    const std::size_t row_bytes = static_cast<std::size_t>(side.width) * sizeof(std::uint32_t);
    const int rows = std::min(side.height - row_, static_cast<int>(left / row_bytes));
    if (rows == 0) return;
    glTexSubImage2D(
        GL_TEXTURE_2D, static_cast<GLint>(level_), 0, row_, side.width, rows, GL_RGBA, GL_UNSIGNED_BYTE,
        &coming_levels_
             .texels[level_][static_cast<std::size_t>(row_) * static_cast<std::size_t>(side.width)]);
    left -= static_cast<std::size_t>(rows) * row_bytes;
    row_ += rows;
    if (row_ == side.height) ++level_, row_ = 0;
  }
  coming_levels_ = {};
  std::swap(shown_, coming_);
  glBindTexture(GL_TEXTURE_2D, shown_.name);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, nearest_ ? GL_NEAREST : GL_LINEAR);
}

void GlTexture::set_nearest(bool nearest) {
  if (nearest == nearest_) return;
  nearest_ = nearest;
  if (shown_.name == 0) return;
  glBindTexture(GL_TEXTURE_2D, shown_.name);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, nearest ? GL_NEAREST : GL_LINEAR);
}

void GlTexture::reset() {
  for (Name* texture : {&shown_, &coming_}) {
    if (texture->name != 0) glDeleteTextures(1, &texture->name);
    *texture = {};
  }
  coming_levels_ = {};
}

}  // namespace bn::ui
