// Protects: the conventions that every engine relies on: levels of ranks, offset + 128, atlas order.
#include <map>
#include <numeric>

#include "bn/error.h"
#include "texture/fixtures.h"

namespace bn::texture {
namespace {

Grid<std::uint32_t> ranks(Extent size) {
  Grid<std::uint32_t> rank(size);
  // Any permutation will do: multiply by a number that has no common factor with the count.
  const auto n = static_cast<std::uint64_t>(rank.count());
  std::uint64_t factor = n * 5 / 8 + 1;
  while (std::gcd(factor, n) != 1) ++factor;
  for (std::uint64_t i = 0; i < n; ++i) rank[i] = static_cast<std::uint32_t>(i * factor % n);
  return rank;
}

template <class Sample>
std::map<Sample, int> counts(const Image& image) {
  std::map<Sample, int> count;
  for (const Sample s : samples_of<Sample>(image)) ++count[s];
  return count;
}

TEST(EncodeMask, EightBitHistogramIsExactlyFlat) {
  for (const Extent size :
       {Extent{16, 16}, Extent{64, 64}, Extent{128, 128}, Extent{96, 32}, Extent{256, 3}}) {
    const auto count = counts<std::uint8_t>(encode_mask(ranks(size), SampleType::u8));
    ASSERT_EQ(count.size(), 256u);
    for (const auto& [level, times] : count) EXPECT_EQ(times, size.area() / 256) << +level;
  }
}

TEST(EncodeMask, SamplesAreTheDocumentedFunctionOfTheRank) {
  for (const Extent size : {Extent{1, 1}, Extent{3, 1}, Extent{17, 13}, Extent{300, 301}}) {
    const auto rank = ranks(size);
    const auto n = static_cast<std::uint64_t>(rank.count());
    const auto u8 = samples_of<std::uint8_t>(encode_mask(rank, SampleType::u8));
    const auto u16 = samples_of<std::uint16_t>(encode_mask(rank, SampleType::u16));
    const auto f32 = samples_of<float>(encode_mask(rank, SampleType::f32));
    for (std::size_t i = 0; i < n; ++i) {
      // floor(r * 256 / n) is the v with v * n <= r * 256 < (v + 1) * n.
      EXPECT_TRUE(u8[i] * n <= rank[i] * 256ull && rank[i] * 256ull < (u8[i] + 1) * n);
      EXPECT_TRUE(u16[i] * n <= rank[i] * 65536ull && rank[i] * 65536ull < (u16[i] + 1) * n);
      EXPECT_EQ(f32[i], static_cast<float>((rank[i] + 0.5) / static_cast<double>(n)));
    }
  }
}

TEST(EncodeMask, RefusesWhatIsNoRank) {
  Grid<std::uint32_t> rank({2, 2});
  rank[3] = 4;
  expect_error(ErrorCode::invalid_input, [&] { encode_mask(rank, SampleType::u8); });
  expect_error(ErrorCode::invalid_input, [&] { encode_mask(Grid<std::uint32_t>(), SampleType::u8); });
}

TEST(EncodeMoves, DecodingIsTheInverseForEveryOffset) {
  Grid<Offset> move({256, 256});
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) move(x, y) = {x - 128, y - 128};
  }
  const Image image = encode_moves(move);
  EXPECT_EQ(image.channels, 3);
  const auto samples = samples_of<std::uint8_t>(image);
  for (std::size_t i = 0; i < move.count(); ++i) {
    ASSERT_EQ(samples[3 * i], move[i].x + 128);
    ASSERT_EQ(samples[3 * i + 1], move[i].y + 128);
    ASSERT_EQ(samples[3 * i + 2], 0);
  }
  EXPECT_EQ(decode_moves(image), move);
}

TEST(EncodeMoves, FloatsAreTheMovesThemselves) {
  Grid<Offset> move({256, 256});
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) move(x, y) = {x - 128, y - 128};
  }
  const Image image = encode_moves(move, SampleType::f32);
  const auto samples = samples_of<float>(image);
  ASSERT_EQ(samples.size(), 3 * move.count());
  for (std::size_t i = 0; i < move.count(); ++i) {
    ASSERT_EQ(samples[3 * i], static_cast<float>(move[i].x));
    ASSERT_EQ(samples[3 * i + 1], static_cast<float>(move[i].y));
    ASSERT_EQ(samples[3 * i + 2], 0.0f);
  }
  EXPECT_EQ(decode_moves(image), move);
  expect_error(ErrorCode::invalid_input, [&] { encode_moves(move, SampleType::u16); });
  expect_error(ErrorCode::invalid_input, [&] {
    encode_moves(Grid<Offset>({1, 1}, Offset{128, 0}), SampleType::f32);
  });
  const float infinity = std::numeric_limits<float>::infinity(),
              nan = std::numeric_limits<float>::quiet_NaN();
  for (const float odd : {0.5f, 128.0f, -129.0f, infinity, -infinity, nan, 1e30f}) {
    expect_error(ErrorCode::invalid_input, [&] {
      decode_moves(image_of<float>({1, 1}, 2, SampleType::f32, {0.0f, odd}));
    });
  }
}

TEST(EncodeMoves, HalfFloatsAreTheMovesThemselves) {
  Grid<Offset> move({256, 1});
  Grid<std::int8_t> z({256, 1});
  for (int x = 0; x < 256; ++x) move[static_cast<std::size_t>(x)] = {x - 128, 127 - x};
  for (int x = 0; x < 256; ++x) z[static_cast<std::size_t>(x)] = static_cast<std::int8_t>(x - 128);
  const Image image = encode_moves(move, SampleType::f16);
  EXPECT_TRUE(same_picture(to_float(image), encode_moves(move, SampleType::f32)));
  EXPECT_EQ(decode_moves(image), move);
  EXPECT_EQ(decode_volume_moves(encode_moves(move, z, SampleType::f16)).z, z);
  expect_error(ErrorCode::invalid_input, [] {
    decode_moves(to_half(image_of<float>({1, 1}, 2, SampleType::f32, {0.0f, 0.5f})));
  });
}

TEST(EncodeMoves, RefusesWhatDoesNotFit) {
  for (const Offset far :
       {Offset{128, 0}, Offset{-129, 0}, Offset{0, 128}, Offset{0, -129}, Offset{1 << 30, 0}}) {
    expect_error(ErrorCode::invalid_input, [&] { encode_moves(Grid<Offset>({1, 1}, far)); });
  }
  expect_error(ErrorCode::invalid_input, [] { decode_moves(random_image({2, 2}, 1, SampleType::u8)); });
  expect_error(ErrorCode::invalid_input, [] { decode_moves(random_image({2, 2}, 3, SampleType::u16)); });
  EXPECT_NO_THROW(decode_moves(random_image({2, 2}, 2, SampleType::u8)));
  Image torn = random_image({2, 2}, 3, SampleType::u8);
  torn.samples.pop_back();
  expect_error(ErrorCode::invalid_input, [&] { decode_moves(torn); });
}

TEST(Atlas, TileLiesAtItsColumnAndRow) {
  for (const SampleType type : {SampleType::u8, SampleType::u16, SampleType::f32}) {
    std::vector<Image> tiles;
    for (std::uint64_t i = 0; i < 6; ++i) tiles.push_back(random_image({5, 4}, 3, type, i + 1));
    const Image atlas = make_atlas(tiles, 3);
    EXPECT_EQ(atlas.size, (Extent{15, 8}));
    const std::size_t pixel = 3 * bytes_per_sample(type);
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 15; ++x) {
        const Image& tile = tiles[static_cast<std::size_t>(y / 4 * 3 + x / 5)];
        EXPECT_EQ(
            0, std::memcmp(atlas.samples.data() + static_cast<std::size_t>(y * 15 + x) * pixel,
                           tile.samples.data() + static_cast<std::size_t>(y % 4 * 5 + x % 5) * pixel, pixel));
      }
    }
    for (int i = 0; i < 6; ++i) {
      EXPECT_TRUE(same_picture(atlas_tile(atlas, {5, 4}, i), tiles[static_cast<std::size_t>(i)]));
    }
  }
}

TEST(Atlas, RefusesWhatDoesNotFit) {
  const Image tile = random_image({4, 4}, 3, SampleType::u8);
  expect_error(ErrorCode::invalid_input, [&] { make_atlas({}, 1); });
  expect_error(ErrorCode::invalid_input, [&] { make_atlas({tile, tile, tile}, 2); });
  expect_error(ErrorCode::invalid_input, [&] { make_atlas({tile}, 0); });
  expect_error(ErrorCode::invalid_input, [&] {
    make_atlas({tile, random_image({4, 5}, 3, SampleType::u8)}, 1);
  });
  expect_error(ErrorCode::invalid_input, [&] {
    make_atlas({tile, random_image({4, 4}, 1, SampleType::u8)}, 1);
  });
  expect_error(ErrorCode::invalid_input, [&] {
    make_atlas({tile, random_image({4, 4}, 3, SampleType::u16)}, 1);
  });
  const Image wide = random_image({40000, 1}, 1, SampleType::u8);
  expect_error(ErrorCode::invalid_input, [&] { make_atlas({wide, wide}, 2); });
  expect_error(ErrorCode::invalid_input, [&] { atlas_tile(tile, {3, 4}, 0); });
  expect_error(ErrorCode::invalid_input, [&] { atlas_tile(tile, {0, 4}, 0); });
  expect_error(ErrorCode::invalid_input, [&] { atlas_tile(tile, {2, 2}, 4); });
  expect_error(ErrorCode::invalid_input, [&] { atlas_tile(tile, {2, 2}, -1); });
}

}  // namespace
}  // namespace bn::texture
