#include "noise/energy_field.h"

#include <algorithm>

namespace bn::noise {
namespace {

int blocks_for(int pixels) { return (pixels + kBlockSide - 1) / kBlockSide; }

/// Across the seam of the torus lies, where the side is no multiple of a block's, one block that may be
/// a single pixel wide.
int reach_in_blocks(int side, int radius) {
  return side % kBlockSide == 0 ? blocks_for(radius) : 1 + blocks_for(radius - 1);
}

EnergyBlock block_of(std::int32_t energy) {
  EnergyBlock block;
  std::fill_n(block.energy, kBlockPixels, energy);
  return block;
}

constexpr std::size_t kVectorRoom = 16;

}  // namespace

EnergyField::EnergyField(Extent extent, int radius, std::int32_t energy)
    : size(extent),
      blocks_x(blocks_for(extent.width)),
      blocks_y(blocks_for(extent.height)),
      reach_x(reach_in_blocks(extent.width, radius)),
      reach_y(reach_in_blocks(extent.height, radius)),
      blocks(static_cast<std::size_t>(blocks_x) * static_cast<std::size_t>(blocks_y), block_of(energy)),
      minimum(blocks.size() + kVectorRoom, kSetMark) {}

std::uint64_t EnergyField::bytes(Extent size) {
  const auto blocks = static_cast<std::uint64_t>(blocks_for(size.width)) *
                      static_cast<std::uint64_t>(blocks_for(size.height));
  return blocks * (sizeof(EnergyBlock) + sizeof(std::int32_t));
}

void EnergyField::update_minima() {
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    minimum[i] = *std::min_element(blocks[i].energy, blocks[i].energy + kBlockPixels);
  }
}

BlockKernel::BlockKernel(const PixelKernel& kernel, int sign)
    : radius_(kernel.radius()),
      max_span_(span(kBlockSide - 1)),
      rows_(kBlockSide * max_span_ + kBlockSide - 1) {
  weights_.reserve(static_cast<std::size_t>(kBlockSide * max_span_ * rows_ * kBlockSide));
  for (int phase = 0; phase < kBlockSide; ++phase) {
    for (int column = 0; column < max_span_; ++column) {
      for (int row = 0; row < rows_; ++row) {
        for (int lane = 0; lane < kBlockSide; ++lane) {
          const int x = column * kBlockSide + lane - phase - radius_;
          const int y = row - (kBlockSide - 1) - radius_;
          weights_.push_back(sign * kernel.weight(x, y));
        }
      }
    }
  }
}

}  // namespace bn::noise
