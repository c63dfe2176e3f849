// Protects: a device is found by name or refused with the names that are there, what it lacks is named, and
// failures of memory are told from others.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "bn/error.h"
#include "gpu/device.h"

// Drivers keep memory to the end of the process.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libvulkan_lvp\nleak:libLLVM\nleak:libVkLayer\nleak:libvulkan.so\nleak:libdbus\n";
}

namespace bn {
using namespace gpu;
namespace {

VulkanDevice& device() {
  // Never closed: the driver stays loaded, so that what it keeps can be told by its name, above.
  static VulkanDevice& device = *new VulkanDevice("lavapipe", true);
  return device;
}

std::string first_complaint() { return device().complaints().empty() ? "" : device().complaints().front(); }

TEST(VulkanDevice, UnknownNamesAreRefusedWithTheOnesPresent) {
  try {
    VulkanDevice nowhere("no such device", false);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::io);
    EXPECT_NE(std::string(error.what()).find("llvmpipe"), std::string::npos) << error.what();
  }
}

TEST(VulkanDevice, ABufferAboveTheLimitIsRefused) {
  try {
    device().make_buffer(std::uint64_t{1} << 40);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::over_limit);
  }
  EXPECT_EQ(first_complaint(), "");
}

TEST(VulkanDevice, WhatADeviceLacksIsNamed) {
  vk::PhysicalDeviceFeatures features;
  features.shaderInt64 = true;
  vk::ExtensionProperties push;
  std::snprintf(push.extensionName.data(), push.extensionName.size(), "VK_KHR_push_descriptor");
  const std::array extensions{push};
  EXPECT_EQ(missing_feature(VK_API_VERSION_1_2, features, extensions), "");
  EXPECT_EQ(missing_feature(VK_API_VERSION_1_1, features, extensions), "Vulkan 1.2");
  EXPECT_EQ(missing_feature(VK_API_VERSION_1_3, {}, extensions), "shaderInt64");
  EXPECT_EQ(missing_feature(VK_API_VERSION_1_2, features, {}), "VK_KHR_push_descriptor");
}

TEST(VulkanDevice, OutOfMemoryIsALimitAndOtherFailuresAreNot) {
  const auto code = [](const vk::SystemError& error) {
    try {
      throw_vulkan_error(error, "allocating");
    } catch (const Error& thrown) {
      return thrown.code();
    }
  };
  EXPECT_EQ(code(vk::OutOfDeviceMemoryError("")), ErrorCode::over_limit);
  EXPECT_EQ(code(vk::OutOfHostMemoryError("")), ErrorCode::over_limit);
  EXPECT_EQ(code(vk::DeviceLostError("")), ErrorCode::io);
}

}  // namespace
}  // namespace bn
