// What samples mean: ranks, moves and atlases as images (design and docs/conventions.md).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "bn/texture.h"
#include "texture/error.h"
#include "texture/half.h"
#include "texture/image.h"

namespace bn {
namespace {

using texture::fail_input;

constexpr int kMoveZero = 128;

Image blank(Shape shape, int channels, SampleType type, std::string_view where) {
  texture::check_shape(shape.width, shape.height, channels, where);
  texture::check_depth(shape.depth, where);
  return {.size = shape.slice(),
          .depth = shape.depth,
          .channels = channels,
          .type = type,
          .samples = std::vector<std::byte>(texture::sample_bytes(shape, channels, type))};
}

/// Puts the samples of `rank` into one channel of `image`.
template <class Encode>
void fill(Image& image, int channel, const Grid<std::uint32_t>& rank, Encode encode) {
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < rank.count(); ++i) {
    const auto sample = encode(std::uint64_t{rank[i]});
    const std::size_t at = (i * channels + static_cast<std::size_t>(channel)) * sizeof sample;
    std::memcpy(image.samples.data() + at, &sample, sizeof sample);
  }
}

void fill_mask(Image& image, int channel, const Grid<std::uint32_t>& rank, std::string_view where) {
  const std::uint64_t n = rank.count();
  const auto bad = std::find_if(rank.begin(), rank.end(), [&](std::uint32_t r) { return r >= n; });
  if (bad != rank.end()) {
    fail_input(std::string(where), fmt::format("rank {}", *bad), fmt::format("0..{}", n - 1));
  }
  const auto centred = [n](std::uint64_t r) {
    return (static_cast<double>(r) + 0.5) / static_cast<double>(n);
  };
  switch (image.type) {
    case SampleType::u8:
      return fill(image, channel, rank,
                  [n](std::uint64_t r) { return static_cast<std::uint8_t>(r * 256 / n); });
    case SampleType::u16:
      return fill(image, channel, rank,
                  [n](std::uint64_t r) { return static_cast<std::uint16_t>(r * 65536 / n); });
    case SampleType::f32:
      return fill(image, channel, rank, [&](std::uint64_t r) { return static_cast<float>(centred(r)); });
    case SampleType::f16:
      return fill(image, channel, rank, [&](std::uint64_t r) { return texture::half_bits(centred(r)); });
  }
}

/// One component of a move as a sample.
std::byte encode_component(int component) {
  if (component < -kMoveZero || component > 255 - kMoveZero) {
    fail_input("encode_moves", fmt::format("a move of {} pixels", component), "-128..127",
               "use a smaller radius or motion");
  }
  return static_cast<std::byte>(component + kMoveZero);
}

int decode_component(std::byte sample) { return std::to_integer<int>(sample) - kMoveZero; }

/// Copies a tile between its own image and its place in an atlas.
template <class Copy>
void for_each_row(const Image& atlas, Extent tile, int index, Copy copy) {
  const std::size_t pixel = static_cast<std::size_t>(atlas.channels) * bytes_per_sample(atlas.type);
  const int columns = atlas.size.width / tile.width;
  const std::size_t left = static_cast<std::size_t>(index % columns) * tile.width;
  const std::size_t top = static_cast<std::size_t>(index / columns) * tile.height;
  const std::size_t row_bytes = pixel * tile.width;
  for (std::size_t y = 0; y < static_cast<std::size_t>(tile.height); ++y) {
    copy(((top + y) * atlas.size.width + left) * pixel, y * row_bytes, row_bytes);
  }
}

}  // namespace

Image encode_mask(const Grid<std::uint32_t>& rank, SampleType type) {
  Image image = blank(rank.shape(), 1, type, "encode_mask");
  fill_mask(image, 0, rank, "encode_mask");
  return image;
}

Image encode_masks(std::span<const Grid<std::uint32_t>> ranks, SampleType type) {
  if (ranks.empty()) fail_input("encode_masks", "no mask", fmt::format("1..{}", texture::kMaxChannels));
  const Shape shape = ranks[0].shape();
  Image image =
      blank(shape, static_cast<int>(std::min<std::size_t>(ranks.size(), 1 << 20)), type, "encode_masks");
  for (std::size_t c = 0; c < ranks.size(); ++c) {
    const std::string where = fmt::format("encode_masks, channel {}", c);
    if (ranks[c].shape() != shape) {
      const auto [width, height, depth] = ranks[c].shape();
      fail_input(where, fmt::format("a mask of {}x{}x{}", width, height, depth),
                 fmt::format("{}x{}x{}, as the first", shape.width, shape.height, shape.depth));
    }
    fill_mask(image, static_cast<int>(c), ranks[c], where);
  }
  return image;
}

namespace {

void check_move_type(SampleType type) {
  if (type == SampleType::u16)
    fail_input("encode_moves", fmt::format("{} samples", name_of(type)), "8bit, half, float");
}

/// Component number `i`, counted through all pixels and channels. Half floats hold each exactly.
void put_component(Image& image, std::size_t i, int value) {
  const auto put = [&](auto sample) {
    std::memcpy(image.samples.data() + i * sizeof sample, &sample, sizeof sample);
  };
  const std::byte shifted = encode_component(value);  // checks the range
  if (image.type == SampleType::u8) return put(shifted);
  if (image.type == SampleType::f16) return put(texture::half_bits(static_cast<float>(value)));
  put(static_cast<float>(value));
}

int component(const Image& image, std::size_t i) {
  const auto get = [&](auto sample) {
    std::memcpy(&sample, image.samples.data() + i * sizeof sample, sizeof sample);
    return sample;
  };
  if (image.type == SampleType::u8) return decode_component(image.samples[i]);
  const float value = image.type == SampleType::f16 ? texture::half_value(get(std::uint16_t{})) : get(0.0f);
  if (value >= -128.0f && value <= 127.0f && std::nearbyint(value) == value) return static_cast<int>(value);
  fail_input("decode_moves", fmt::format("a component of {}", value), "whole numbers -128..127");
}

}  // namespace

Image encode_moves(const Grid<Offset>& move, SampleType type) {
  if (move.depth() > 1) {
    fail_input("encode_moves", fmt::format("moves of {} slices without their third axis", move.depth()),
               "1 slice", "give the third axis too");
  }
  check_move_type(type);
  Image image = blank(move.size(), 3, type, "encode_moves");
  for (std::size_t i = 0; i < move.count(); ++i) {
    put_component(image, 3 * i, move[i].x);
    put_component(image, 3 * i + 1, move[i].y);
  }
  return image;
}

Grid<Offset> decode_moves(const Image& image) {
  texture::check_image(image, "decode_moves");
  if (image.type == SampleType::u16 || image.channels < 2 || image.depth > 1) {
    fail_input("decode_moves", texture::describe(image),
               "one slice of 8bit, red = x + 128, green = y + 128, or of half or float, red = x, green = y");
  }
  Grid<Offset> move(image.size);
  for (std::size_t i = 0; i < move.count(); ++i) {
    const std::size_t first = i * static_cast<std::size_t>(image.channels);
    move[i] = {component(image, first), component(image, first + 1)};
  }
  return move;
}

Image encode_moves(const Grid<Offset>& move, const Grid<std::int8_t>& z, SampleType type) {
  if (move.shape() != z.shape()) {
    fail_input("encode_moves",
               fmt::format("a third axis of {}x{}x{} for moves of {}x{}x{}", z.width(), z.height(), z.depth(),
                           move.width(), move.height(), move.depth()),
               "the same shape");
  }
  check_move_type(type);
  Image image = blank(move.shape(), 3, type, "encode_moves");
  for (std::size_t i = 0; i < move.count(); ++i) {
    put_component(image, 3 * i, move[i].x);
    put_component(image, 3 * i + 1, move[i].y);
    put_component(image, 3 * i + 2, z[i]);
  }
  return image;
}

VolumeMoves decode_volume_moves(const Image& image) {
  texture::check_image(image, "decode_volume_moves");
  if (image.type == SampleType::u16 || image.channels < 3) {
    fail_input("decode_volume_moves", texture::describe(image),
               "8bit, red = x + 128, green = y + 128, blue = z + 128, or half or float without the 128");
  }
  VolumeMoves moves{.move = Grid<Offset>(image.shape()), .z = Grid<std::int8_t>(image.shape())};
  for (std::size_t i = 0; i < moves.move.count(); ++i) {
    const std::size_t first = i * static_cast<std::size_t>(image.channels);
    moves.move[i] = {component(image, first), component(image, first + 1)};
    moves.z[i] = static_cast<std::int8_t>(component(image, first + 2));
  }
  return moves;
}

Image make_atlas(const std::vector<Image>& tiles, int columns) {
  if (columns < 1 || tiles.empty() || tiles.size() % static_cast<std::size_t>(columns) != 0) {
    fail_input("make_atlas", fmt::format("{} tiles in rows of {}", tiles.size(), columns),
               "a multiple of the row");
  }
  const Image& first = tiles.front();
  for (const Image& tile : tiles) {
    texture::check_image(tile, "make_atlas");
    if (!texture::same_layout(tile, first)) {
      fail_input("make_atlas", "tiles of different size, channels or type", "equal ones");
    }
    if (tile.depth > 1) fail_input("make_atlas", fmt::format("a tile of {} slices", tile.depth), "1 slice");
  }
  const auto width = std::int64_t{first.size.width} * columns;
  const auto height = static_cast<std::int64_t>(tiles.size()) / columns * first.size.height;
  texture::check_shape(width, height, first.channels, "make_atlas");
  Image atlas =
      blank({static_cast<int>(width), static_cast<int>(height)}, first.channels, first.type, "make_atlas");
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    for_each_row(atlas, first.size, static_cast<int>(i),
                 [&](std::size_t in_atlas, std::size_t in_tile, std::size_t n) {
                   std::memcpy(atlas.samples.data() + in_atlas, tiles[i].samples.data() + in_tile, n);
                 });
  }
  return atlas;
}

Image atlas_tile(const Image& atlas, Extent tile_size, int index) {
  texture::check_image(atlas, "atlas_tile");
  if (atlas.depth > 1) fail_input("atlas_tile", fmt::format("an atlas of {} slices", atlas.depth), "1 slice");
  if (tile_size.width < 1 || tile_size.height < 1 || atlas.size.width % tile_size.width != 0 ||
      atlas.size.height % tile_size.height != 0) {
    fail_input("atlas_tile",
               fmt::format("tiles of {}x{} in an atlas of {}x{}", tile_size.width, tile_size.height,
                           atlas.size.width, atlas.size.height),
               "a divisor of the atlas");
  }
  const std::int64_t count = atlas.size.area() / tile_size.area();
  if (index < 0 || index >= count) {
    fail_input("atlas_tile", fmt::format("tile {}", index), fmt::format("0..{}", count - 1));
  }
  Image tile = blank(tile_size, atlas.channels, atlas.type, "atlas_tile");
  for_each_row(atlas, tile_size, index, [&](std::size_t in_atlas, std::size_t in_tile, std::size_t n) {
    std::memcpy(tile.samples.data() + in_tile, atlas.samples.data() + in_atlas, n);
  });
  return tile;
}

}  // namespace bn
