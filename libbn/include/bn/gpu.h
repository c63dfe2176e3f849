// bn/gpu.h - floor 1: a Vulkan device to compute on.
//
// The Vulkan loader is opened when a device is asked for, not when a program starts: a program that asks for
// none needs no libvulkan.

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace bn {

/// A Vulkan device, opened once and shared by renderers. `name`: "lavapipe" (Mesa's software device), "gpu",
/// or a part of a device's name. `validate` turns the validation layers on, synchronisation included. Errors:
/// io (no loader, no driver, no such device, a missing feature: each is named).
class VulkanDevice;
std::shared_ptr<VulkanDevice> open_vulkan_device(const std::string& name, bool validate = false);
/// What the validation layers complained about so far.
std::vector<std::string> complaints(const VulkanDevice& device);

/// What one pass of a frame cost on its device.
struct PassTime {
  std::string pass;
  double milliseconds = 0.0;
  std::uint64_t bytes = 0;  ///< of the buffers it reads and writes
};

}  // namespace bn
