// Passes on a device.
//
// Buffers are pushed with each dispatch (VK_KHR_push_descriptor): no pools, no sets to keep. Every
// pass is followed by a full memory barrier; the passes depend on one another in a chain, so a finer
// barrier would gain nothing.

#include "runtime/vulkan_passes.h"

#include <fmt/format.h>

#include "bn/error.h"
#include "runtime/shader_code.h"

namespace bn {
namespace {

struct IntVec2 {
  std::int32_t x, y;
};

IntVec2 ivec2(Offset offset) { return {offset.x, offset.y}; }
IntVec2 ivec2(Extent extent) { return {extent.width, extent.height}; }

// The push constants of the shaders, member by member (std430 has no gaps here).
struct SortPush {
  IntVec2 screen, tile, shift, origin;
  std::int32_t seed_pitch, columns, blocks;
};
struct RetargetPush {
  IntVec2 size, tile, shift;
  std::int32_t motion_range;
};
struct MotionSumPush {
  std::int32_t pixels;
};
struct MotionChoosePush {
  std::int32_t motion_range;
};

constexpr std::uint32_t kMotionLanes = 1024;

ShaderCode sort_code(int block) {
  switch (block) {
    case 2:
      return ShaderCode::sort_2;
    case 4:
      return ShaderCode::sort_4;
    case 8:
      return ShaderCode::sort_8;
    case 16:
      return ShaderCode::sort_16;
  }
  throw Error({.code = ErrorCode::invalid_input,
               .what = fmt::format("sort blocks of {} pixels", block),
               .where = "block",
               .limit = "2, 4, 8 or 16",
               .remedy = ""});
}

/// Two 16-bit signed numbers in 32 bits, x below.
std::uint32_t packed(int x, int y) {
  return static_cast<std::uint32_t>(static_cast<std::uint16_t>(x)) |
         static_cast<std::uint32_t>(static_cast<std::uint16_t>(y)) << 16;
}

template <class T>
void upload_all(VulkanDevice& device, const DeviceBuffer& to, const T& values) {
  device.upload(to, std::as_bytes(std::span(values.data(), values.size())));
}

}  // namespace

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

void PassTimer::mark(const vk::raii::CommandBuffer& commands, std::string pass,
                     std::initializer_list<const DeviceBuffer*> buffers) {
  passes_.push_back({.pass = std::move(pass)});
  for (const DeviceBuffer* buffer : buffers) passes_.back().bytes += buffer->bytes;
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

VulkanTemporal::VulkanTemporal(VulkanDevice& device, const TemporalTextures& textures, Extent screen,
                               const Seeds& seeds, int block)
    : device_(device),
      screen_(screen),
      padded_(seeds.size()),
      tile_(textures.mask.size()),
      block_(block),
      motion_range_(textures.motion_range),
      sort_(shared_pass(device, shader_code(sort_code(block)), 3, sizeof(SortPush), 64)),
      retarget_(shared_pass(device, shader_code(ShaderCode::retarget), 4, sizeof(RetargetPush), 64)),
      motion_sum_(shared_pass(device, shader_code(ShaderCode::motion_sum), 2, sizeof(MotionSumPush), 64)),
      motion_choose_(
          shared_pass(device, shader_code(ShaderCode::motion_choose), 2, sizeof(MotionChoosePush), 1)) {
  const auto pixels = static_cast<std::uint64_t>(screen.area());
  mask_ = device.make_buffer(textures.mask.count() * 4);
  upload_all(device, mask_, std::vector<std::int32_t>(textures.mask.begin(), textures.mask.end()));
  std::vector<std::uint32_t> moves;
  for (const Grid<Offset>& tile : textures.moves) {
    // The same move on the torus of the seeds, and shorter than it: the shader wraps only once.
    for (const Offset& move : tile) {
      moves.push_back(packed(wrap_centred(move.x, padded_.width), wrap_centred(move.y, padded_.height)));
    }
  }
  moves_ = device.make_buffer(moves.size() * 4);
  upload_all(device, moves_, moves);
  luminance_ = device.make_buffer(pixels * 4);
  motion_ = device.make_buffer(pixels * 4);
  sums_ = device.make_buffer(kMotionLanes * 16);
  chosen_ = device.make_buffer(8);
  for (DeviceBuffer& buffer : seeds_) buffer = device.make_buffer(seeds.count() * 4);
  device.upload(seeds_[0], std::as_bytes(std::span(seeds.data(), seeds.count())));
}

void VulkanTemporal::record_motion_choice(const vk::raii::CommandBuffer& commands) const {
  motion_sum_->record(commands, {&motion_, &sums_}, MotionSumPush{static_cast<std::int32_t>(screen_.area())},
                      kMotionLanes);
  motion_choose_->record(commands, {&sums_, &chosen_}, MotionChoosePush{motion_range_}, 1);
}

void VulkanTemporal::record_retarget(const vk::raii::CommandBuffer& commands, Offset shift) {
  retarget_->record(commands, {&moves_, &chosen_, &seeds_[current_], &seeds_[1 - current_]},
                    RetargetPush{ivec2(padded_), ivec2(tile_), ivec2(shift), motion_range_}, padded_.width,
                    padded_.height);
  current_ = 1 - current_;
}

void VulkanTemporal::record_sort(const vk::raii::CommandBuffer& commands, Offset shift, Offset origin) const {
  const int columns = (screen_.width + origin.x + block_ - 1) / block_;
  const int rows = (screen_.height + origin.y + block_ - 1) / block_;
  sort_->record(commands, {&luminance_, &mask_, &seeds_[current_]},
                SortPush{ivec2(screen_), ivec2(tile_), ivec2(shift), ivec2(origin), padded_.width, columns,
                         columns * rows},
                std::int64_t{columns} * rows);
}

Seeds VulkanTemporal::download_seeds() {
  Seeds result(padded_);
  device_.download(seeds_[current_], std::as_writable_bytes(std::span(result.data(), result.count())));
  return result;
}

Offset VulkanTemporal::download_chosen_motion() {
  IntVec2 motion{};
  device_.download(chosen_, std::as_writable_bytes(std::span(&motion, 1)));
  return {motion.x, motion.y};
}

}  // namespace bn
