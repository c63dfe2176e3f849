// Any bytes: the reader answers with an image or a bn::Error, within its memory limit; and an image
// that came out goes through our own formats unchanged. With BN_FUZZ_NAME=x.tga in the environment the
// bytes are those of a format that is known by its extension.
#include <cstdlib>
#include <optional>

#include "bn/error.h"
#include "bn/texture.h"
#include "promise.h"
#include "texture/codec.h"
#include "texture/image.h"
#include "texture/metadata.h"

namespace {

using namespace bn;
using namespace bn::texture;

void check_round_trip(const char* name, const Image& image, const Metadata& metadata) {
  const Bytes bytes = encode(name, image, metadata);
  const Decoded back = decode(std::as_bytes(std::span(bytes)), name, {});
  require(same_layout(back.image, image) && back.image.samples == image.samples,
          "the same picture comes back");
  FileContent content;
  read_description(back.description, content);
  require(content.metadata == metadata, "the same metadata come back");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const char* const name =
      std::getenv("BN_FUZZ_NAME") != nullptr ? std::getenv("BN_FUZZ_NAME") : "input";
  FileContent content;
  try {
    Decoded decoded = decode(std::as_bytes(std::span(data, size)), name, kExecution);
    check_image(decoded.image, "image");
    content.image = std::move(decoded.image);
    read_description(decoded.description, content);
  } catch (const Error&) {
    return 0;
  }
  if (content.image.type == SampleType::f16) content.image = to_float(content.image);
  const Image& image = content.image;
  require(image.samples.size() <= kExecution.memory_limit_bytes, "the limit holds");
  Metadata metadata = content.metadata.value_or(Metadata{});
  metadata.pixel_hash = pixel_hash(image);
  try {
    levels_of_channel(image, image.channels - 1);
    check_round_trip("a.h", image, metadata);
  } catch (const Error&) {  // NaN or infinity
    require(image.type == SampleType::f32, "integers are finite");
  }
  check_round_trip("a.bin", image, metadata);
  if (image.type != SampleType::f32 && image.channels <= 4 && image.depth == 1) {
    check_round_trip("a.png", image, metadata);
  }
  return 0;
}
