// WebP, by libwebp: three channels, or four where the file says that it has alpha, which is straight. A
// lossless file gives the samples that it was made of.

#include <webp/decode.h>

#include "oiio/formats.h"
#include "texture/error.h"
#include "texture/image.h"

namespace bn::oiio {

using namespace texture;

Decoded decode_webp(ByteView bytes, const std::string& name, const Execution& execution) {
  const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  WebPBitstreamFeatures features = {};
  if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK)
    fail_input(name, "not a whole WebP: its header is cut short or corrupt");
  if (features.has_animation != 0)
    fail_input(name, "an animation", "a single picture", "take the pictures out of it");
  check_shape(features.width, features.height, 4, name);
  Decoded decoded;
  Image& image = decoded.image;
  image.size = {features.width, features.height};
  image.channels = features.has_alpha != 0 ? 4 : 3;
  const std::uint64_t ours = sample_bytes(image.size, image.channels, SampleType::u8);
  check_decoded_size(ours, bytes.size(), name);
  check_memory(execution, 3 * ours + bytes.size(), name);  // the decoder keeps a picture of its own
  throw_if_stopped(execution);
  image.samples.resize(ours);
  auto* const to = reinterpret_cast<std::uint8_t*>(image.samples.data());
  const auto decode = image.channels == 4 ? WebPDecodeRGBAInto : WebPDecodeRGBInto;
  if (decode(data, bytes.size(), to, ours,
             static_cast<int>(ours / static_cast<std::uint64_t>(image.size.height))) == nullptr) {
    fail_input(name, "not a whole WebP: its samples are cut short or corrupt");
  }
  constexpr int kLossless = 2;
  if (features.format != kLossless) decoded.notes.emplace_back(kLossyNote);
  return decoded;
}

}  // namespace bn::oiio
