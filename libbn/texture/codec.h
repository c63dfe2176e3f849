// The file formats, in memory: an image and a text to bytes, and back. Reading survives any bytes.

#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bn/texture.h"

namespace bn::texture {

using Bytes = std::vector<unsigned char>;
using ByteView = std::span<const std::byte>;

/// A decoded file. `description` is what the file says of itself, ours or not.
struct Decoded {
  Image image;
  std::string description;
};

/// Decodes bytes by their signature, or by the extension of `name` where they have none of those we
/// know. Throws like read_image(); `name` is for messages.
Decoded decode(ByteView bytes, const std::string& name, const Execution& execution);

/// The bytes of the file that write_image() puts at `path`; nothing is written. Throws like it.
Bytes encode(const std::filesystem::path& path, const Image& image, const Metadata& metadata);

// Through OpenImageIO. `format` is its name of a format: "png", "openexr", "tiff", or an extension.
Decoded decode_oiio(ByteView bytes, const std::string& format, const std::string& name,
                    const Execution& execution);
Bytes encode_oiio(const std::string& format, const Image& image, const std::string& description);

// Our own raw format.
bool is_bin(ByteView bytes);
Decoded decode_bin(ByteView bytes, const std::string& name, const Execution& execution);
Bytes encode_bin(const Image& image, const Metadata& metadata);

// A C array. Reading understands what writing writes and no other C.
bool is_c_header(ByteView bytes);
Decoded decode_c_header(ByteView bytes, const std::string& name, const Execution& execution);
/// `stem` names the array.
Bytes encode_c_header(const std::string& stem, const Image& image, const Metadata& metadata);

}  // namespace bn::texture
