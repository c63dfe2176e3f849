// Compute passes on a device: a pipeline each, and time stamps between them.
#pragma once

#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gpu/device.h"

namespace bn::gpu {

/// One shader as a pipeline. Buffers are bound by position: 0, 1, ...
class Pass {
 public:
  Pass(const VulkanDevice& device, std::span<const std::uint32_t> spirv, int buffers,
       std::uint32_t push_bytes, std::uint32_t group_size);

  /// Records a dispatch of at least `invocations` in each of `rows` rows of groups, and a barrier after it,
  /// so that passes see each other's results in the order they are recorded.
  template <class Push>
  void record(const vk::raii::CommandBuffer& commands, std::initializer_list<const DeviceBuffer*> buffers,
              const Push& push, std::int64_t invocations, int rows = 1) const {
    record_bytes(commands, buffers, std::as_bytes(std::span(&push, 1)), invocations, rows);
  }

  /// Of a shader without push constants.
  void record_without_push(const vk::raii::CommandBuffer& commands,
                           std::initializer_list<const DeviceBuffer*> buffers, std::int64_t invocations,
                           int rows = 1) const {
    record_bytes(commands, buffers, {}, invocations, rows);
  }

 private:
  void record_bytes(const vk::raii::CommandBuffer& commands,
                    std::initializer_list<const DeviceBuffer*> buffers, std::span<const std::byte> push,
                    std::int64_t invocations, int rows) const;

  vk::raii::DescriptorSetLayout set_layout_{nullptr};
  vk::raii::PipelineLayout layout_{nullptr};
  vk::raii::Pipeline pipeline_{nullptr};
  std::uint32_t group_size_;
};

/// The pass of `spirv` on `device`, compiled at its first use: that takes up to seconds, a frame
/// milliseconds.
std::shared_ptr<const Pass> shared_pass(VulkanDevice& device, std::span<const std::uint32_t> spirv,
                                        int buffers, std::uint32_t push_bytes, std::uint32_t group_size);

/// Makes what transfers wrote visible to passes, and what passes wrote visible to transfers.
void record_barrier(const vk::raii::CommandBuffer& commands);

/// Time stamps around the passes of one submission.
class PassTimer {
 public:
  explicit PassTimer(const VulkanDevice& device);
  /// Before the first pass.
  void start(const vk::raii::CommandBuffer& commands);
  /// After each pass: the time since the last mark is `pass`'s, which reads and writes `bytes`.
  void mark(const vk::raii::CommandBuffer& commands, std::string pass, std::uint64_t bytes = 0);
  /// Milliseconds of each pass, in order; after the commands have run.
  std::vector<PassTime> read() const;

 private:
  static constexpr std::uint32_t kStamps = 32;
  double unit_ms_;
  vk::raii::QueryPool pool_{nullptr};
  std::vector<PassTime> passes_;  ///< without their times
};

}  // namespace bn::gpu
