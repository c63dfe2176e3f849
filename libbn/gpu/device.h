// One Vulkan device and its memory: what passes stand on. Compute only; nothing here knows what is computed.
// Includes Vulkan-Hpp, which compiles slowly: for files that record passes only.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

#include "bn/gpu.h"

namespace bn {
namespace gpu {

class Pass;

/// Storage on the device.
struct DeviceBuffer {
  vk::raii::Buffer buffer{nullptr};
  vk::raii::DeviceMemory memory{nullptr};
  std::uint64_t bytes = 0;
};

}  // namespace gpu

class VulkanDevice {
 public:
  /// `wanted`: "lavapipe" (Mesa's software device), "gpu" (the first that is none), or a part of a
  /// device's name. `validate` turns on the validation layers with synchronisation checks.
  VulkanDevice(const std::string& wanted, bool validate);

  /// A storage buffer that copies can fill and read, zeroed. Throws over_limit.
  gpu::DeviceBuffer make_buffer(std::uint64_t bytes);
  void upload(const gpu::DeviceBuffer& to, std::span<const std::byte> bytes);
  void download(const gpu::DeviceBuffer& from, std::span<std::byte> bytes);

  /// Commands recorded by `record` run once, to their end.
  template <class Record>
  void run(const Record& record) {
    begin();
    record(commands_);
    submit();
  }

  /// Passes by the address of their code: compiled once a device, whoever uses them (see shared_pass()).
  std::map<const std::uint32_t*, std::shared_ptr<const gpu::Pass>>& passes() { return passes_; }

  const vk::raii::Device& handle() const { return device_; }
  const std::string& name() const { return name_; }
  double timestamp_unit_ns() const { return timestamp_unit_ns_; }
  /// What the validation layers complained about since the start.
  const std::vector<std::string>& complaints() const { return *complaints_; }

 private:
  void choose(const std::string& wanted);
  void begin();
  void submit();
  gpu::DeviceBuffer allocate(std::uint64_t bytes, vk::BufferUsageFlags usage,
                             vk::MemoryPropertyFlags properties);
  void reserve_staging(std::uint64_t bytes);

  // Filled by the layers through a plain pointer, so its address must not change.
  std::unique_ptr<std::vector<std::string>> complaints_;
  std::unique_ptr<vk::raii::Context> context_;
  vk::raii::Instance instance_{nullptr};
  vk::raii::DebugUtilsMessengerEXT messenger_{nullptr};
  vk::raii::PhysicalDevice physical_{nullptr};
  vk::raii::Device device_{nullptr};
  vk::raii::Queue queue_{nullptr};
  vk::raii::CommandPool pool_{nullptr};
  vk::raii::CommandBuffer commands_{nullptr};
  vk::raii::Fence fence_{nullptr};
  gpu::DeviceBuffer staging_;
  std::map<const std::uint32_t*, std::shared_ptr<const gpu::Pass>> passes_;
  std::string name_;
  std::uint32_t queue_family_ = 0;
  double timestamp_unit_ns_ = 1.0;
};

namespace gpu {

/// What passes need and a device with these properties lacks; empty: nothing.
std::string missing_feature(std::uint32_t api_version, const vk::PhysicalDeviceFeatures& features,
                            std::span<const vk::ExtensionProperties> extensions);

/// `error` as a bn::Error that says what was being done: over_limit where memory ran out, else io.
[[noreturn]] void throw_vulkan_error(const vk::SystemError& error, const std::string& doing);

}  // namespace gpu
}  // namespace bn
