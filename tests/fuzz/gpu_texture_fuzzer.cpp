// Any bytes behind the signature of KTX2 or DDS: the reader answers with an image or a bn::Error, within its
// memory limit; and an image that came out goes through both formats unchanged. The first byte chooses the
// format.
#include <string_view>

#include "bn/error.h"
#include "promise.h"
#include "texture/codec.h"
#include "texture/gpu_format.h"
#include "texture/image.h"

namespace {

using namespace bn;
using namespace bn::texture;

void check_round_trip(const char* name, const Image& image, SliceKind slices) {
  const Bytes bytes = encode(name, image, {}, slices);
  const Decoded back = decode(std::as_bytes(std::span(bytes)), name, {});
  require(same_layout(back.image, image) && back.image.samples == image.samples, "the same image comes back");
  require(image.depth == 1 || back.slices == slices, "the same kind of slices comes back");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace std::string_view_literals;
  if (size == 0) return 0;
  const bool is_dds = (data[0] & 1) != 0;
  const std::string_view signature = is_dds ? "DDS "sv : "\xABKTX 20\xBB\r\n\x1A\n"sv;
  Bytes bytes(signature.begin(), signature.end());
  bytes.insert(bytes.end(), data + 1, data + size);
  Decoded decoded;
  try {
    decoded = decode(std::as_bytes(std::span(bytes)), "input", kExecution);
    check_image(decoded.image, "image");
  } catch (const Error&) {
    return 0;
  }
  require(decoded.image.samples.size() <= kExecution.memory_limit_bytes, "the limit holds");
  check_round_trip("a.ktx2", decoded.image, decoded.slices);
  if (gpu_format(decoded.image.type, decoded.image.channels)->dxgi != 0) {
    check_round_trip("a.dds", decoded.image, decoded.slices);
  }
  return 0;
}
