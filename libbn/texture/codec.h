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
  SliceKind slices = SliceKind::layers;
  std::vector<std::string> notes;          ///< as in FileContent
  std::vector<std::string> channel_names;  ///< as in FileContent
};

/// Lower case, without the dot.
inline std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

/// Decodes bytes by their signature, or by the extension of `name` where they have none of those we
/// know. Throws like read_image(); `name` is for messages.
Decoded decode(ByteView bytes, const std::string& name, const Execution& execution);

/// The bytes of the file that write_image() puts at `path`; nothing is written. Throws like it.
Bytes encode(const std::filesystem::path& path, const Image& image, const Metadata& metadata,
             SliceKind slices = SliceKind::layers);

/// read_image(), but for the refusal of several slices.
FileContent read_any(const std::filesystem::path& path, const Execution& execution);

/// Whether the format that the extension names keeps several slices in one file.
bool holds_volumes(const std::filesystem::path& path);
/// The file of the metadata of a DDS.
std::filesystem::path metadata_beside(const std::filesystem::path& dds);

// By libraries in a module that is loaded now. `format` is "jpeg", "gif", "webp", or OpenImageIO's name:
// "openexr", "tiff", "hdr", "tga".
Decoded decode_oiio(ByteView bytes, const std::string& format, const std::string& name,
                    const Execution& execution);
Bytes encode_oiio(const std::string& format, const Image& image, const std::string& description);

/// The number of parts. Throws unless every attribute of every header of an EXR lies inside the file.
int exr_parts(ByteView bytes, const std::string& name);
/// The number of pages, at least 1. Throws if there are too many, or their chain has no end.
int tiff_pages(ByteView bytes, const std::string& name);

// PBM, PGM, PPM, PFM.
bool is_pnm(ByteView bytes);
Decoded decode_pnm(ByteView bytes, const std::string& name, const Execution& execution);

bool is_bmp(ByteView bytes);
Decoded decode_bmp(ByteView bytes, const std::string& name, const Execution& execution);

// PNG, by libpng.
Decoded decode_png(ByteView bytes, const std::string& name, const Execution& execution);
/// `description` is left out where it is empty.
Bytes encode_png(const Image& image, const std::string& description);

// Our own raw format.
bool is_bin(ByteView bytes);
Decoded decode_bin(ByteView bytes, const std::string& name, const Execution& execution);
Bytes encode_bin(const Image& image, const Metadata& metadata);

// KTX 2.0.
bool is_ktx2(ByteView bytes);
Decoded decode_ktx2(ByteView bytes, const std::string& name, const Execution& execution);
Bytes encode_ktx2(const Image& image, const Metadata& metadata, SliceKind slices);

// DDS, which has no room for metadata.
bool is_dds(ByteView bytes);
Decoded decode_dds(ByteView bytes, const std::string& name, const Execution& execution);
Bytes encode_dds(const Image& image, SliceKind slices);

// A C array. Reading understands what writing writes and no other C.
bool is_c_header(ByteView bytes);
Decoded decode_c_header(ByteView bytes, const std::string& name, const Execution& execution);
/// `stem` names the array.
Bytes encode_c_header(const std::string& stem, const Image& image, const Metadata& metadata);

}  // namespace bn::texture
