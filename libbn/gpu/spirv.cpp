#include "gpu/spirv.h"

namespace bn::gpu {

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

}  // namespace bn::gpu
