// What the module bn_oiio offers to this room. It is built with this library and by the same compiler, so C++
// types and exceptions cross.

#pragma once

#include <string>

#include "texture/codec.h"

namespace bn::texture {

struct OiioCodec {
  std::string_view version;  ///< kVersion of the module
  Decoded (*decode)(ByteView bytes, const std::string& format, const std::string& name,
                    const Execution& execution);
  Bytes (*encode)(const std::string& format, const Image& image, const std::string& description);
};

/// The name of a function `const OiioCodec* ()` in the module.
inline constexpr const char* kOiioCodecSymbol = "bn_oiio_codec";
inline constexpr const char* kOiioModule = "bn_oiio";
inline constexpr const char* kOiioRemedy =
    "keep libbn_oiio.so where it was installed, and install OpenImageIO (Debian: libopenimageio2.4)";

}  // namespace bn::texture
