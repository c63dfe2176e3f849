// EXR, TIFF and foreign formats, by OpenImageIO in a module of its own: it costs 0.2 s and 264 libraries at
// start, which a program that never meets such a file need not pay.

#include "texture/oiio_module.h"

#include "bn/version.h"
#include "core/module.h"
#include "texture/error.h"

namespace bn::texture {
namespace {

const OiioCodec& codec(const std::string& format) {
  const std::string purpose = "the format '" + format + "'";
  const auto get = reinterpret_cast<const OiioCodec* (*)()>(
      module_symbol(kOiioModule, kOiioCodecSymbol, purpose, kOiioRemedy));
  const OiioCodec& found = *get();
  if (found.version != kVersion)
    fail_io("libbn_oiio.so", "is of version " + std::string(found.version), kOiioRemedy);
  return found;
}

}  // namespace

Decoded decode_oiio(ByteView bytes, const std::string& format, const std::string& name,
                    const Execution& execution) {
  return codec(format).decode(bytes, format, name, execution);
}

Bytes encode_oiio(const std::string& format, const Image& image, const std::string& description) {
  return codec(format).encode(format, image, description);
}

}  // namespace bn::texture
