// Shaders as SPIR-V: bn_shader() in libbn/CMakeLists.txt compiles a room's shaders into ROOM/shaders.h, an
// array of words each.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace bn::gpu {

/// The module with every floating-point operation marked exact (NoContraction): no a*b+c in one
/// rounding, no rearrangement. GLSL's `precise` on everything, without the word on every line.
std::vector<std::uint32_t> without_contraction(std::span<const std::uint32_t> module);

}  // namespace bn::gpu
