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
  }
  throw std::logic_error("no such shader");
}

}  // namespace bn
