// The shaders as SPIR-V, compiled when libbn is built.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace bn {

enum class ShaderCode {
  sort_2,
  sort_4,
  sort_8,
  sort_16,
  retarget,
  motion_sum,
  motion_choose,
  gbuffer,
  trace,
  tone_map
};

std::span<const std::uint32_t> shader_code(ShaderCode code);

/// The module with every floating-point operation marked exact (NoContraction): no a*b+c in one
/// rounding, no rearrangement. GLSL's `precise` on everything, without the word on every line.
std::vector<std::uint32_t> without_contraction(std::span<const std::uint32_t> module);

}  // namespace bn
