// Opens one Vulkan device for compute work and moves bytes to it and back.
//
// The loader, libvulkan.so.1, is opened here, not linked. The device is found through it, by name or driver,
// never by a driver file of our choice: what the loader finds is what the user's system has. Lavapipe is
// asked for by its driver id; if it is not there the message names the driver file that is missing.
//
// Every buffer lives in device memory; copies go through one staging buffer. On lavapipe both are
// the same memory and the copy costs little; on a GPU it is the only way.

#include "gpu/device.h"

#include <fmt/format.h>

#include <cstring>
#include <optional>

#include "bn/error.h"

namespace bn {
namespace gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr std::uint32_t kVulkanVersion = VK_API_VERSION_1_2;

VKAPI_ATTR VkBool32 VKAPI_CALL collect(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                       VkDebugUtilsMessageTypeFlagsEXT,
                                       const VkDebugUtilsMessengerCallbackDataEXT* data, void* complaints) {
  static_cast<std::vector<std::string>*>(complaints)->emplace_back(data->pMessage);
  return VK_FALSE;
}

bool is_lavapipe(const vk::raii::PhysicalDevice& device) {
  const auto properties =
      device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
  return properties.get<vk::PhysicalDeviceDriverProperties>().driverID == vk::DriverId::eMesaLlvmpipe;
}

bool answers_to(const vk::raii::PhysicalDevice& device, const std::string& wanted) {
  if (wanted == "lavapipe") return is_lavapipe(device);
  const vk::PhysicalDeviceProperties properties = device.getProperties();
  if (wanted == "gpu") return properties.deviceType != vk::PhysicalDeviceType::eCpu;
  return std::string_view(properties.deviceName).find(wanted) != std::string_view::npos;
}

[[noreturn]] void throw_no_device(const std::string& wanted, const std::string& lacking,
                                  const std::string& present) {
  throw Error({.code = ErrorCode::io,
               .what = !lacking.empty()  ? fmt::format("device '{}' lacks {}", wanted, lacking)
                       : present.empty() ? fmt::format("no Vulkan device '{}': no driver found", wanted)
                                         : fmt::format("no Vulkan device '{}'", wanted),
               .where = "--device",
               .limit = present,
               .remedy = wanted == "lavapipe"
                             ? "install mesa-vulkan-drivers (/usr/share/vulkan/icd.d/lvp_icd.x86_64.json)"
                             : ""});
}

}  // namespace

std::string missing_feature(std::uint32_t api_version, const vk::PhysicalDeviceFeatures& features,
                            std::span<const vk::ExtensionProperties> extensions) {
  if (api_version < kVulkanVersion) return "Vulkan 1.2";
  if (!features.shaderInt64) return "shaderInt64";
  for (const vk::ExtensionProperties& extension : extensions) {
    if (std::string_view(extension.extensionName) == VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME) return "";
  }
  return VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME;
}

void throw_vulkan_error(const vk::SystemError& error, const std::string& doing) {
  const auto result = static_cast<vk::Result>(error.code().value());
  const bool memory =
      result == vk::Result::eErrorOutOfDeviceMemory || result == vk::Result::eErrorOutOfHostMemory;
  throw Error({.code = memory ? ErrorCode::over_limit : ErrorCode::io,
               .what = fmt::format("{} failed: {}", doing, vk::to_string(result)),
               .where = "vulkan",
               .limit = "",
               .remedy = memory ? "render a smaller screen" : "check the driver with vulkaninfo"});
}

}  // namespace gpu

using namespace gpu;

std::shared_ptr<VulkanDevice> open_vulkan_device(const std::string& name, bool validate) {
  return std::make_shared<VulkanDevice>(name, validate);
}

std::vector<std::string> complaints(const VulkanDevice& device) { return device.complaints(); }

VulkanDevice::VulkanDevice(const std::string& wanted, bool validate)
    : complaints_(std::make_unique<std::vector<std::string>>()) {
  try {
    context_ = std::make_unique<vk::raii::Context>();
  } catch (const std::exception&) {
    throw Error({.code = ErrorCode::io,
                 .what = "no Vulkan loader (libvulkan.so.1)",
                 .where = "vulkan",
                 .limit = "",
                 .remedy = "install libvulkan1, or use --device cpu"});
  }
  try {
    const vk::ApplicationInfo application("libbn", 1, "libbn", 1, kVulkanVersion);
    const std::array sync_checks{vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
    const vk::ValidationFeaturesEXT features(sync_checks);
    const std::array layers{kValidationLayer};
    const std::array extensions{VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
    vk::InstanceCreateInfo info({}, &application);
    if (validate)
      info.setPEnabledLayerNames(layers).setPEnabledExtensionNames(extensions).setPNext(&features);
    instance_ = vk::raii::Instance(*context_, info);
    if (validate) {
      using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
      using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
      messenger_ = vk::raii::DebugUtilsMessengerEXT(
          instance_, vk::DebugUtilsMessengerCreateInfoEXT({}, Severity::eWarning | Severity::eError,
                                                          Type::eValidation | Type::ePerformance, &collect,
                                                          complaints_.get()));
    }
    choose(wanted);
    const float priority = 1.0f;
    const vk::DeviceQueueCreateInfo queue({}, queue_family_, 1, &priority);
    const std::array device_extensions{VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME};
    vk::PhysicalDeviceFeatures wanted_features;
    wanted_features.shaderInt64 = true;
    device_ = vk::raii::Device(physical_,
                               vk::DeviceCreateInfo({}, queue, nullptr, device_extensions, &wanted_features));
    queue_ = device_.getQueue(queue_family_, 0);
    pool_ =
        vk::raii::CommandPool(device_, {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, queue_family_});
    commands_ =
        std::move(vk::raii::CommandBuffers(device_, {*pool_, vk::CommandBufferLevel::ePrimary, 1}).front());
    fence_ = vk::raii::Fence(device_, vk::FenceCreateInfo());
  } catch (const vk::LayerNotPresentError&) {
    throw Error({.code = ErrorCode::io,
                 .what = fmt::format("the validation layer {} is not installed", kValidationLayer),
                 .where = "vulkan",
                 .limit = "",
                 .remedy = "install vulkan-validationlayers"});
  } catch (const vk::IncompatibleDriverError&) {
    throw_no_device(wanted, "", "");
  } catch (const vk::SystemError& error) {
    throw_vulkan_error(error, "opening the device");
  }
}

void VulkanDevice::choose(const std::string& wanted) {
  std::vector<vk::raii::PhysicalDevice> devices;
  try {
    devices = vk::raii::PhysicalDevices(instance_);
  } catch (const vk::SystemError&) {
    // No driver at all: the loader reports a failed initialisation.
  }
  std::string present;
  std::string lacking;
  for (vk::raii::PhysicalDevice& device : devices) {
    const std::string name = device.getProperties().deviceName;
    present += (present.empty() ? "" : "; ") + name;
    if (!answers_to(device, wanted)) continue;
    lacking = missing_feature(device.getProperties().apiVersion, device.getFeatures(),
                              device.enumerateDeviceExtensionProperties());
    if (!lacking.empty()) continue;
    const auto families = device.getQueueFamilyProperties();
    for (std::uint32_t i = 0; i < families.size(); ++i) {
      if (!(families[i].queueFlags & vk::QueueFlagBits::eCompute) || families[i].timestampValidBits == 0)
        continue;
      queue_family_ = i;
      timestamp_unit_ns_ = device.getProperties().limits.timestampPeriod;
      name_ = name;
      physical_ = std::move(device);
      return;
    }
    lacking = "a compute queue with time stamps";
  }
  throw_no_device(wanted, lacking, present);
}

DeviceBuffer VulkanDevice::allocate(std::uint64_t bytes, vk::BufferUsageFlags usage,
                                    vk::MemoryPropertyFlags properties) {
  const std::uint64_t limit = physical_.getProperties().limits.maxStorageBufferRange;
  if (bytes > limit) {
    throw Error({.code = ErrorCode::over_limit,
                 .what = fmt::format("a buffer of {} bytes", bytes),
                 .where = name_,
                 .limit = fmt::format("{} bytes", limit),
                 .remedy = "render a smaller screen"});
  }
  try {
    DeviceBuffer result;
    result.bytes = std::max<std::uint64_t>(bytes, 16);
    result.buffer = vk::raii::Buffer(device_, vk::BufferCreateInfo({}, result.bytes, usage));
    const vk::MemoryRequirements needs = result.buffer.getMemoryRequirements();
    const vk::PhysicalDeviceMemoryProperties memory = physical_.getMemoryProperties();
    std::optional<std::uint32_t> type;
    for (std::uint32_t i = 0; i < memory.memoryTypeCount && !type; ++i) {
      const bool allowed = (needs.memoryTypeBits >> i & 1u) != 0;
      if (allowed && (memory.memoryTypes[i].propertyFlags & properties) == properties) type = i;
    }
    if (!type) throw vk::OutOfDeviceMemoryError("no memory of the wanted type");
    result.memory = vk::raii::DeviceMemory(device_, vk::MemoryAllocateInfo(needs.size, *type));
    result.buffer.bindMemory(*result.memory, 0);
    return result;
  } catch (const vk::SystemError& error) {
    throw_vulkan_error(error, fmt::format("allocating {} bytes", bytes));
  }
}

DeviceBuffer VulkanDevice::make_buffer(std::uint64_t bytes) {
  using Usage = vk::BufferUsageFlagBits;
  DeviceBuffer result =
      allocate((bytes + 3) / 4 * 4, Usage::eStorageBuffer | Usage::eTransferSrc | Usage::eTransferDst,
               vk::MemoryPropertyFlagBits::eDeviceLocal);
  run([&](const vk::raii::CommandBuffer& commands) {
    commands.fillBuffer(*result.buffer, 0, VK_WHOLE_SIZE, 0);
  });
  return result;
}

void VulkanDevice::reserve_staging(std::uint64_t bytes) {
  if (staging_.bytes >= bytes) return;
  using Memory = vk::MemoryPropertyFlagBits;
  using Usage = vk::BufferUsageFlagBits;
  staging_ = allocate(bytes, Usage::eTransferSrc | Usage::eTransferDst,
                      Memory::eHostVisible | Memory::eHostCoherent);
}

void VulkanDevice::upload(const DeviceBuffer& to, std::span<const std::byte> bytes) {
  if (bytes.empty()) return;
  reserve_staging(bytes.size());
  void* mapped = staging_.memory.mapMemory(0, VK_WHOLE_SIZE);
  std::memcpy(mapped, bytes.data(), bytes.size());
  staging_.memory.unmapMemory();
  run([&](const vk::raii::CommandBuffer& commands) {
    commands.copyBuffer(*staging_.buffer, *to.buffer, vk::BufferCopy(0, 0, bytes.size()));
  });
}

void VulkanDevice::download(const DeviceBuffer& from, std::span<std::byte> bytes) {
  if (bytes.empty()) return;
  reserve_staging(bytes.size());
  run([&](const vk::raii::CommandBuffer& commands) {
    commands.copyBuffer(*from.buffer, *staging_.buffer, vk::BufferCopy(0, 0, bytes.size()));
    // Waiting for the fence does not by itself make the copy visible to the host.
    commands.pipelineBarrier(
        vk::PipelineStageFlagBits::eTransfer, vk::PipelineStageFlagBits::eHost, {},
        vk::MemoryBarrier(vk::AccessFlagBits::eTransferWrite, vk::AccessFlagBits::eHostRead), nullptr,
        nullptr);
  });
  void* mapped = staging_.memory.mapMemory(0, VK_WHOLE_SIZE);
  std::memcpy(bytes.data(), mapped, bytes.size());
  staging_.memory.unmapMemory();
}

void VulkanDevice::begin() {
  commands_.reset();
  commands_.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
}

void VulkanDevice::submit() {
  try {
    commands_.end();
    vk::SubmitInfo info;
    info.setCommandBuffers(*commands_);
    queue_.submit(info, *fence_);
    constexpr std::uint64_t kTimeoutNs = 600'000'000'000;  // a frame that takes ten minutes hangs
    if (device_.waitForFences(*fence_, true, kTimeoutNs) != vk::Result::eSuccess) {
      throw Error({.code = ErrorCode::io,
                   .what = "the device does not answer",
                   .where = name_,
                   .limit = "",
                   .remedy = ""});
    }
    device_.resetFences(*fence_);
  } catch (const vk::SystemError& error) {
    throw_vulkan_error(error, "running on the device");
  }
}

}  // namespace bn
