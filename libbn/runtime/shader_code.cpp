// Embeds what glslc wrote: each .inc is the list of a module's words.

#include "runtime/shader_code.h"

#include <stdexcept>

namespace bn {
namespace {

constexpr std::uint32_t kSort2[] =
#include "runtime/sort_2.inc"
    ;
constexpr std::uint32_t kSort4[] =
#include "runtime/sort_4.inc"
    ;
constexpr std::uint32_t kSort8[] =
#include "runtime/sort_8.inc"
    ;
constexpr std::uint32_t kSort16[] =
#include "runtime/sort_16.inc"
    ;
constexpr std::uint32_t kRetarget[] =
#include "runtime/retarget.inc"
    ;
constexpr std::uint32_t kMotionSum[] =
#include "runtime/motion_sum.inc"
    ;
constexpr std::uint32_t kMotionChoose[] =
#include "runtime/motion_choose.inc"
    ;
constexpr std::uint32_t kGbuffer[] =
#include "runtime/gbuffer.inc"
    ;
constexpr std::uint32_t kTrace[] =
#include "runtime/trace.inc"
    ;
constexpr std::uint32_t kToneMap[] =
#include "runtime/tone_map.inc"
    ;

}  // namespace

std::span<const std::uint32_t> shader_code(ShaderCode code) {
  switch (code) {
    case ShaderCode::sort_2:
      return kSort2;
    case ShaderCode::sort_4:
      return kSort4;
    case ShaderCode::sort_8:
      return kSort8;
    case ShaderCode::sort_16:
      return kSort16;
    case ShaderCode::retarget:
      return kRetarget;
    case ShaderCode::motion_sum:
      return kMotionSum;
    case ShaderCode::motion_choose:
      return kMotionChoose;
    case ShaderCode::gbuffer:
      return kGbuffer;
    case ShaderCode::trace:
      return kTrace;
    case ShaderCode::tone_map:
      return kToneMap;
  }
  throw std::logic_error("no such shader");
}

std::vector<std::uint32_t> without_contraction(std::span<const std::uint32_t> module) {
  // Numbers of the SPIR-V specification, version 1.6, sections 2.3, 3.20 and 3.42.
  constexpr std::size_t kHeaderWords = 5;
  constexpr std::uint32_t kOpTypeVoid = 19, kOpDecorate = 71, kNoContraction = 42;
  const auto is_float_arithmetic = [](std::uint32_t opcode) {
    switch (opcode) {
      case 127:  // OpFNegate
      case 129:  // OpFAdd
      case 131:  // OpFSub
      case 133:  // OpFMul
      case 136:  // OpFDiv
      case 142:
      case 148:  // OpVectorTimesScalar, OpDot
        return true;
    }
    return false;
  };
  std::size_t first_type = 0;  // decorations stand before the types
  std::vector<std::uint32_t> decorations;
  for (std::size_t at = kHeaderWords; at < module.size(); at += module[at] >> 16) {
    const std::uint32_t opcode = module[at] & 0xFFFFu;
    if (opcode == kOpTypeVoid && first_type == 0) first_type = at;
    if (is_float_arithmetic(opcode)) {
      decorations.insert(decorations.end(), {3u << 16 | kOpDecorate, module[at + 2], kNoContraction});
    }
  }
  std::vector<std::uint32_t> exact(module.begin(), module.begin() + static_cast<std::ptrdiff_t>(first_type));
  exact.insert(exact.end(), decorations.begin(), decorations.end());
  exact.insert(exact.end(), module.begin() + static_cast<std::ptrdiff_t>(first_type), module.end());
  return exact;
}

}  // namespace bn
