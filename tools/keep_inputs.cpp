#include "tools/keep_inputs.h"

#include "bn/error.h"
#include "bn/volume.h"

namespace bn::tools {

void check_keeps(const std::filesystem::path& out, const std::string& flag,
                 std::span<const std::filesystem::path> inputs) {
  for (const std::filesystem::path& input : inputs) {
    if (!would_replace(out, input)) continue;
    throw Error({.code = ErrorCode::invalid_input,
                 .what = "would replace " + input.string() + ", which is read",
                 .where = flag,
                 .limit = "",
                 .remedy = "write to another file"});
  }
}

}  // namespace bn::tools
