// The shaders as SPIR-V, compiled when libbn is built.
#pragma once

#include <cstdint>
#include <span>

namespace bn {

enum class ShaderCode { sort_2, sort_4, sort_8, sort_16, retarget, motion_sum, motion_choose };

std::span<const std::uint32_t> shader_code(ShaderCode code);

}  // namespace bn
