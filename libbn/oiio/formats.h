// Formats that the module bn_oiio decodes by libraries of their own, which OpenImageIO stands on too. Its own
// readers of them cannot read from memory (JPEG), convert samples (CMYK to RGB), or give half a picture
// without a word when a file is cut short.

#pragma once

#include "texture/codec.h"

namespace bn::oiio {

texture::Decoded decode_jpeg(texture::ByteView bytes, const std::string& name, const Execution& execution);
/// The first picture of an animation.
texture::Decoded decode_gif(texture::ByteView bytes, const std::string& name, const Execution& execution);
texture::Decoded decode_webp(texture::ByteView bytes, const std::string& name, const Execution& execution);

/// A volume of floats or half floats, a part a slice.
texture::Bytes encode_exr_parts(const Image& image, const std::vector<std::string>& channel_names,
                                const std::string& description);

inline constexpr const char* kLossyNote =
    "a lossy format: the samples are not those that it was made of; keep masks as PNG";

}  // namespace bn::oiio
