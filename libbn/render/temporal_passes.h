// The passes of the temporal algorithm on a device, with the buffers they share.
#pragma once

#include <array>
#include <memory>

#include "bn/render.h"
#include "gpu/pass.h"

namespace bn::render {

/// Sort, retarget and motion choice on the device, equal bit for bit to the functions of
/// bn/render.h.
class TemporalPasses {
 public:
  /// The textures must have passed check(). `block` is the sort block's side.
  TemporalPasses(VulkanDevice& device, const TemporalTextures& textures, Extent screen, const Seeds& seeds,
                 int block);

  void record_motion_choice(const vk::raii::CommandBuffer& commands) const;
  /// From `frame` to the next one, with the tile for the chosen motion; (0, 0) until a choice is recorded.
  void record_retarget(const vk::raii::CommandBuffer& commands, int frame);
  void record_sort(const vk::raii::CommandBuffer& commands, int frame, Offset origin) const;

  const gpu::DeviceBuffer& luminance() const { return luminance_; }
  const gpu::DeviceBuffer& motion() const { return motion_; }
  const gpu::DeviceBuffer& seeds() const { return seeds_[current_]; }
  const gpu::DeviceBuffer& mask() const { return mask_; }
  const gpu::DeviceBuffer& moves() const { return moves_; }
  const gpu::DeviceBuffer& moved_seeds() const { return seeds_[1 - current_]; }
  Seeds download_seeds();
  Offset download_chosen_motion();

 private:
  VulkanDevice& device_;
  Extent screen_, padded_, tile_;
  Offset step_;
  int masks_;
  int block_;
  int motion_range_;
  std::shared_ptr<const gpu::Pass> sort_, retarget_, motion_sum_, motion_choose_;
  gpu::DeviceBuffer mask_, moves_, luminance_, motion_, sums_, chosen_;
  std::array<gpu::DeviceBuffer, 2> seeds_;
  std::size_t current_ = 0;
};

}  // namespace bn::render
