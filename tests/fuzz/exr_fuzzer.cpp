// Any bytes behind the signature of an EXR, one part or several: the reader answers with an image or a
// bn::Error, within its memory limit; and half and float images that came out, volumes among them, go through
// EXR again unchanged.

#include "bn/error.h"
#include "bn/texture.h"
#include "promise.h"
#include "texture/codec.h"
#include "texture/image.h"

using namespace bn;
using namespace bn::texture;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes = {0x76, 0x2f, 0x31, 0x01};
  bytes.insert(bytes.end(), data, data + size);
  Decoded decoded;
  try {
    decoded = decode(std::as_bytes(std::span(bytes)), "input", kExecution);
    check_image(decoded.image, "image");
  } catch (const Error&) {
    return 0;
  }
  const Image& image = decoded.image;
  require(image.samples.size() <= kExecution.memory_limit_bytes, "the limit holds");
  require(decoded.channel_names.size() == static_cast<std::size_t>(image.channels),
          "every channel has a name");
  if (image.type != SampleType::f16 && image.type != SampleType::f32) return 0;
  const Bytes again = encode("a.exr", image, {}, SliceKind::layers);
  const Decoded back = decode(std::as_bytes(std::span(again)), "a.exr", {});
  require(same_layout(back.image, image) && back.image.samples == image.samples, "the same image comes back");
  return 0;
}
