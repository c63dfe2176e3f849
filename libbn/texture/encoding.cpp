// What samples mean: ranks, moves and atlases as images (design and docs/conventions.md).

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "bn/texture.h"
#include "texture/error.h"
#include "texture/image.h"

namespace bn {
namespace {

using texture::fail_input;

constexpr int kMoveZero = 128;

Image blank(Extent size, int channels, SampleType type, std::string_view where) {
  texture::check_shape(size.width, size.height, channels, where);
  return {.size = size,
          .channels = channels,
          .type = type,
          .samples = std::vector<std::byte>(texture::sample_bytes(size, channels, type))};
}

template <class Sample, class Encode>
void fill(Image& image, const Grid<std::uint32_t>& rank, Encode encode) {
  for (std::size_t i = 0; i < rank.count(); ++i) {
    const Sample sample = encode(rank[i]);
    std::memcpy(image.samples.data() + i * sizeof sample, &sample, sizeof sample);
  }
}

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
  Image image = blank(rank.size(), 1, type, "encode_mask");
  const std::uint64_t n = rank.count();
  const auto bad = std::find_if(rank.begin(), rank.end(), [&](std::uint32_t r) { return r >= n; });
  if (bad != rank.end()) fail_input("encode_mask", fmt::format("rank {}", *bad), fmt::format("0..{}", n - 1));
  switch (type) {
    case SampleType::u8:
      fill<std::uint8_t>(image, rank,
                         [n](std::uint64_t r) { return static_cast<std::uint8_t>(r * 256 / n); });
      break;
    case SampleType::u16:
      fill<std::uint16_t>(image, rank,
                          [n](std::uint64_t r) { return static_cast<std::uint16_t>(r * 65536 / n); });
      break;
    case SampleType::f32:
      fill<float>(image, rank, [n](std::uint64_t r) {
        return static_cast<float>((static_cast<double>(r) + 0.5) / static_cast<double>(n));
      });
      break;
  }
  return image;
}

Image encode_masks(std::span<const Grid<std::uint32_t>> ranks, SampleType type) {
  return encode_mask(ranks[0], type);
}

Image encode_moves(const Grid<Offset>& move) {
  Image image = blank(move.size(), 3, SampleType::u8, "encode_moves");
  const auto encode = [](int component) {
    if (component < -kMoveZero || component > 255 - kMoveZero) {
      fail_input("encode_moves", fmt::format("a move of {} pixels", component), "-128..127",
                 "use a smaller radius or motion");
    }
    return static_cast<std::byte>(component + kMoveZero);
  };
  for (std::size_t i = 0; i < move.count(); ++i) {
    image.samples[3 * i] = encode(move[i].x);
    image.samples[3 * i + 1] = encode(move[i].y);
  }
  return image;
}

Grid<Offset> decode_moves(const Image& image) {
  texture::check_image(image, "decode_moves");
  if (image.type != SampleType::u8 || image.channels < 2) {
    fail_input("decode_moves", fmt::format("{} samples, {} channels", name_of(image.type), image.channels),
               "8bit, red = x + 128, green = y + 128");
  }
  Grid<Offset> move(image.size);
  const auto decode = [](std::byte sample) { return std::to_integer<int>(sample) - kMoveZero; };
  for (std::size_t i = 0; i < move.count(); ++i) {
    const std::byte* const pixel = image.samples.data() + i * static_cast<std::size_t>(image.channels);
    move[i] = {decode(pixel[0]), decode(pixel[1])};
  }
  return move;
}

Image make_atlas(const std::vector<Image>& tiles, int columns) {
  if (columns < 1 || tiles.empty() || tiles.size() % static_cast<std::size_t>(columns) != 0) {
    fail_input("make_atlas", fmt::format("{} tiles in rows of {}", tiles.size(), columns),
               "a multiple of the row");
  }
  const Image& first = tiles.front();
  for (const Image& tile : tiles) {
    texture::check_image(tile, "make_atlas");
    if (tile.size != first.size || tile.channels != first.channels || tile.type != first.type) {
      fail_input("make_atlas", "tiles of different size, channels or type", "equal ones");
    }
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
