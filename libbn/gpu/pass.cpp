// Passes on a device.
//
// Buffers are pushed with each dispatch (VK_KHR_push_descriptor): no pools, no sets to keep. Every
// pass is followed by a full memory barrier; the passes depend on one another in a chain, so a finer
// barrier would gain nothing.

#include "gpu/pass.h"

#include "gpu/spirv.h"

namespace bn::gpu {

Pass::Pass(const VulkanDevice& device, std::span<const std::uint32_t> spirv, int buffers,
           std::uint32_t push_bytes, std::uint32_t group_size)
    : group_size_(group_size) {
  try {
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (int i = 0; i < buffers; ++i) {
      bindings.emplace_back(static_cast<std::uint32_t>(i), vk::DescriptorType::eStorageBuffer, 1,
                            vk::ShaderStageFlagBits::eCompute);
    }
    set_layout_ = vk::raii::DescriptorSetLayout(
        device.handle(), {vk::DescriptorSetLayoutCreateFlagBits::ePushDescriptorKHR, bindings});
    const vk::PushConstantRange range(vk::ShaderStageFlagBits::eCompute, 0, push_bytes);
    vk::PipelineLayoutCreateInfo layout({}, *set_layout_);
    if (push_bytes > 0) layout.setPushConstantRanges(range);
    layout_ = vk::raii::PipelineLayout(device.handle(), layout);
    const std::vector<std::uint32_t> code = without_contraction(spirv);
    const vk::raii::ShaderModule module(device.handle(), vk::ShaderModuleCreateInfo({}, code));
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main");
    pipeline_ =
        vk::raii::Pipeline(device.handle(), nullptr, vk::ComputePipelineCreateInfo({}, stage, *layout_));
  } catch (const vk::SystemError& error) {
    throw_vulkan_error(error, "making a pass");
  }
}

void Pass::record_bytes(const vk::raii::CommandBuffer& commands,
                        std::initializer_list<const DeviceBuffer*> buffers, std::span<const std::byte> push,
                        std::int64_t invocations, int rows) const {
  std::vector<vk::DescriptorBufferInfo> infos;
  for (const DeviceBuffer* buffer : buffers) infos.emplace_back(*buffer->buffer, 0, VK_WHOLE_SIZE);
  std::vector<vk::WriteDescriptorSet> writes;
  for (std::uint32_t i = 0; i < infos.size(); ++i) {
    writes.emplace_back(nullptr, i, 0, 1, vk::DescriptorType::eStorageBuffer, nullptr, &infos[i]);
  }
  commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
  commands.pushDescriptorSetKHR(vk::PipelineBindPoint::eCompute, *layout_, 0, writes);
  if (!push.empty()) commands.pushConstants<std::byte>(*layout_, vk::ShaderStageFlagBits::eCompute, 0, push);
  commands.dispatch(static_cast<std::uint32_t>((invocations + group_size_ - 1) / group_size_),
                    static_cast<std::uint32_t>(rows), 1);
  record_barrier(commands);
}

std::shared_ptr<const Pass> shared_pass(VulkanDevice& device, std::span<const std::uint32_t> spirv,
                                        int buffers, std::uint32_t push_bytes, std::uint32_t group_size) {
  std::shared_ptr<const Pass>& pass = device.passes()[spirv.data()];
  if (!pass) pass = std::make_shared<const Pass>(device, spirv, buffers, push_bytes, group_size);
  return pass;
}

void record_barrier(const vk::raii::CommandBuffer& commands) {
  using Stage = vk::PipelineStageFlagBits;
  using Access = vk::AccessFlagBits;
  const auto stages = Stage::eComputeShader | Stage::eTransfer;
  const auto writes = Access::eShaderWrite | Access::eTransferWrite;
  const auto uses =
      Access::eShaderRead | Access::eShaderWrite | Access::eTransferRead | Access::eTransferWrite;
  commands.pipelineBarrier(stages, stages, {}, vk::MemoryBarrier(writes, uses), nullptr, nullptr);
}

PassTimer::PassTimer(const VulkanDevice& device)
    : unit_ms_(device.timestamp_unit_ns() * 1e-6),
      pool_(device.handle(), vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, kStamps)) {}

void PassTimer::start(const vk::raii::CommandBuffer& commands) {
  passes_.clear();
  commands.resetQueryPool(*pool_, 0, kStamps);
  commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *pool_, 0);
}

void PassTimer::mark(const vk::raii::CommandBuffer& commands, std::string pass, std::uint64_t bytes) {
  passes_.push_back({.pass = std::move(pass), .milliseconds = 0.0, .bytes = bytes});
  commands.writeTimestamp(vk::PipelineStageFlagBits::eBottomOfPipe, *pool_,
                          static_cast<std::uint32_t>(passes_.size()));
}

std::vector<PassTime> PassTimer::read() const {
  const auto count = static_cast<std::uint32_t>(passes_.size() + 1);
  const auto [result, stamps] =
      pool_.getResults<std::uint64_t>(0, count, count * sizeof(std::uint64_t), sizeof(std::uint64_t),
                                      vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
  std::vector<PassTime> times = passes_;
  for (std::size_t i = 0; i < passes_.size(); ++i) {
    times[i].milliseconds = static_cast<double>(stamps[i + 1] - stamps[i]) * unit_ms_;
  }
  return times;
}

}  // namespace bn::gpu
