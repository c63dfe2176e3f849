// Protects: putting slices and channels together and taking them apart loses and mixes nothing; what does not
// fit is named by its number; masks and moves of volumes are the documented functions.
#include <limits>

#include "texture/fixtures.h"

namespace bn::texture {
namespace {

TEST(Slices, StackingIsTheInverseOfTakingApart) {
  for (const SampleType type : {SampleType::u8, SampleType::u16, SampleType::f16, SampleType::f32}) {
    std::vector<Image> slices;
    for (std::uint64_t z = 0; z < 4; ++z) slices.push_back(random_image({5, 3}, 2, type, z + 1));
    const Image volume = stack_slices(slices);
    EXPECT_EQ(volume.shape(), (Shape{5, 3, 4}));
    for (int z = 0; z < 4; ++z) {
      EXPECT_TRUE(same_picture(slice_of(volume, z), slices[static_cast<std::size_t>(z)]));
    }
  }
}

TEST(Slices, WhatDoesNotFitIsNamed) {
  const Image first = random_image({5, 3}, 2, SampleType::u8);
  for (const Image& other :
       {random_image({3, 5}, 2, SampleType::u8), random_image({5, 3}, 1, SampleType::u8),
        random_image({5, 3}, 2, SampleType::u16), random_image({5, 3, 2}, 2, SampleType::u8)}) {
    const std::vector<Image> slices = {first, first, other};
    const auto error = error_of([&] { stack_slices(slices); });
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->code, ErrorCode::invalid_input);
    EXPECT_NE(error->where.find("slice 2"), std::string::npos) << error->where;
  }
  expect_error(ErrorCode::invalid_input, [] { stack_slices({}); });
  expect_error(ErrorCode::invalid_input, [&] { slice_of(first, 1); });
  expect_error(ErrorCode::invalid_input, [&] { slice_of(first, -1); });
}

TEST(Slices, ChannelsOfAVolumeAreReadSliceAfterSlice) {
  Image volume = image_of<std::uint8_t>({2, 1}, 2, SampleType::u8, {10, 11, 20, 21, 30, 31, 40, 41});
  volume.depth = 2;
  EXPECT_EQ(samples_of_channel(volume, 1).value, (std::vector<double>{11, 21, 31, 41}));
  const Levels levels = levels_of_channel(volume, 0);
  EXPECT_EQ(levels.value.shape(), (Shape{2, 1, 2}));
  EXPECT_EQ(levels.value(1, 0, 1), 40);
}

TEST(PackChannels, TakesAnyChannelOfAnyImage) {
  for (const SampleType type : {SampleType::u8, SampleType::u16, SampleType::f32}) {
    const Image a = random_image({5, 3, 2}, 3, type, 1), b = random_image({5, 3, 2}, 1, type, 2);
    const std::vector<ChannelRef> refs = {{&a, 2}, {&b, 0}, {&a, 0}, {&a, 2}};
    const Image packed = pack_channels(refs);
    EXPECT_EQ(packed.channels, 4);
    EXPECT_EQ(packed.depth, 2);
    for (int c = 0; c < 4; ++c) {
      const ChannelRef& ref = refs[static_cast<std::size_t>(c)];
      EXPECT_EQ(samples_of_channel(packed, c).value, samples_of_channel(*ref.image, ref.channel).value);
    }
  }
}

TEST(PackChannels, WhatDoesNotFitIsNamed) {
  const Image a = random_image({5, 3}, 1, SampleType::u8);
  for (const Image& other :
       {random_image({3, 5}, 1, SampleType::u8), random_image({5, 3}, 1, SampleType::u16),
        random_image({5, 3, 2}, 1, SampleType::u8)}) {
    const std::vector<ChannelRef> refs = {{&a, 0}, {&other, 0}};
    const auto error = error_of([&] { pack_channels(refs); });
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->code, ErrorCode::invalid_input);
    EXPECT_NE(error->where.find("channel 1"), std::string::npos) << error->where;
  }
  expect_error(ErrorCode::invalid_input, [] { pack_channels({}); });
  for (const ChannelRef& ref : {ChannelRef{&a, 1}, ChannelRef{&a, -1}, ChannelRef{nullptr, 0}}) {
    expect_error(ErrorCode::invalid_input, [&] { pack_channels(std::span(&ref, 1)); });
  }
  const std::vector<ChannelRef> many(65, ChannelRef{&a, 0});
  expect_error(ErrorCode::invalid_input, [&] { pack_channels(many); });
}

Grid<std::uint32_t> ranks(Shape shape, std::uint32_t factor) {
  Grid<std::uint32_t> rank(shape);
  for (std::size_t i = 0; i < rank.count(); ++i) {
    rank[i] = static_cast<std::uint32_t>(i * factor % rank.count());
  }
  return rank;
}

TEST(EncodeMasks, EachChannelIsTheMaskOfItsRanks) {
  for (const SampleType type : {SampleType::u8, SampleType::u16, SampleType::f16, SampleType::f32}) {
    for (const Shape shape : {Shape{8, 4, 1}, Shape{8, 4, 4}}) {
      const std::vector<Grid<std::uint32_t>> channels = {ranks(shape, 5), ranks(shape, 7), ranks(shape, 11)};
      const Image image = encode_masks(channels, type);
      EXPECT_EQ(image.shape(), shape);
      for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(samples_of_channel(image, c).value,
                  samples_of_channel(encode_mask(channels[static_cast<std::size_t>(c)], type), 0).value);
      }
    }
  }
}

TEST(EncodeMasks, RefusesWhatDoesNotFit) {
  expect_error(ErrorCode::invalid_input, [] { encode_masks({}, SampleType::u8); });
  const std::vector<Grid<std::uint32_t>> unequal = {ranks({4, 4}, 5), ranks({4, 2, 2}, 5)};
  const auto error = error_of([&] { encode_masks(unequal, SampleType::u8); });
  ASSERT_TRUE(error.has_value());
  EXPECT_NE(error->where.find("channel 1"), std::string::npos) << error->where;
  const std::vector<Grid<std::uint32_t>> many(65, ranks({2, 2}, 1));
  expect_error(ErrorCode::invalid_input, [&] { encode_masks(many, SampleType::u8); });
}

TEST(VolumeMoves, DecodingIsTheInverseForEveryOffset) {
  Grid<Offset> move({16, 16, 256});
  Grid<std::int8_t> z({16, 16, 256});
  for (std::size_t i = 0; i < move.count(); ++i) {
    move[i] = {static_cast<int>(i % 256) - 128, static_cast<int>(i / 256) - 128};
    z[i] = static_cast<std::int8_t>(static_cast<int>(i * 37 % 256) - 128);
  }
  const Image image = encode_moves(move, z);
  EXPECT_EQ(image.depth, 256);
  EXPECT_EQ(image.channels, 3);
  const auto samples = samples_of<std::uint8_t>(image);
  EXPECT_EQ(samples[3 * 1000], move[1000].x + 128);
  EXPECT_EQ(samples[3 * 1000 + 1], move[1000].y + 128);
  EXPECT_EQ(samples[3 * 1000 + 2], z[1000] + 128);
  const VolumeMoves back = decode_volume_moves(image);
  EXPECT_EQ(back.move, move);
  EXPECT_EQ(back.z, z);
}

TEST(VolumeMoves, PicturesAndVolumesAreNotTakenForOneAnother) {
  const Grid<Offset> move({4, 4, 2});
  expect_error(ErrorCode::invalid_input, [&] { encode_moves(move); });
  expect_error(ErrorCode::invalid_input, [&] { encode_moves(move, Grid<std::int8_t>({4, 4, 1})); });
  expect_error(ErrorCode::invalid_input, [&] {
    encode_moves(Grid<Offset>({1, 1, 1}, Offset{128, 0}), Grid<std::int8_t>({1, 1, 1}));
  });
  expect_error(ErrorCode::invalid_input, [] { decode_moves(random_image({4, 4, 2}, 3, SampleType::u8)); });
  expect_error(ErrorCode::invalid_input, [] {
    decode_volume_moves(random_image({4, 4}, 2, SampleType::u8));
  });
}

}  // namespace
}  // namespace bn::texture
