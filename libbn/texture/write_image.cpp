// Writing: check, make the file in memory, put it in place crash-safely.

#include <fmt/format.h>

#include <new>

#include "bn/texture.h"
#include "texture/codec.h"
#include "texture/error.h"
#include "texture/image.h"
#include "texture/metadata.h"
#include "texture/write_file.h"

namespace bn {
namespace texture {
namespace {

/// OpenImageIO reads no more than this of a TIFF's description.
constexpr std::size_t kMaxTiffDescription = 65536;

struct Format {
  std::string_view extension;
  const char* oiio;  ///< OpenImageIO's name of it, nullptr for our own
  bool integers;
  bool floats;
  std::size_t max_metadata_bytes = kMaxMetadataBytes;
};

constexpr Format kFormats[] = {
    {"png", "png", true, false},
    {"exr", "openexr", false, true},
    {"tif", "tiff", true, true, kMaxTiffDescription},
    {"tiff", "tiff", true, true, kMaxTiffDescription},
    {"bin", nullptr, true, true},
    {"h", nullptr, true, true},
};

/// The format that the extension names, or an error if it cannot hold such samples.
const Format& format_for(const std::filesystem::path& path, SampleType type, int channels) {
  const std::string where = path.string();
  const std::string extension = extension_of(path);
  for (const Format& format : kFormats) {
    if (format.extension != extension) continue;
    if (type == SampleType::f32 ? !format.floats : !format.integers) {
      fail_input(where, fmt::format(".{} cannot hold {} samples", extension, name_of(type)),
                 format.floats ? "float" : "8bit, 16bit",
                 format.floats ? "write float" : "write .exr or .tif");
    }
    check_shape(1, 1, channels, where);
    if (extension == "png" && channels != 1 && channels != 3 && channels != 4) {
      fail_input(where, fmt::format("{} channels in PNG", channels), "1, 3 or 4",
                 channels == 2
                     ? "add a third channel of zeros (PNG makes a second one alpha), or write .tif or .bin"
                     : "write .tif or .bin");
    }
    return format;
  }
  fail_input(where, fmt::format("unknown extension '.{}'", extension), ".png, .exr, .tif, .tiff, .bin, .h");
}

}  // namespace

Bytes encode(const std::filesystem::path& path, const Image& image, const Metadata& metadata) {
  const Format& format = format_for(path, image.type, image.channels);
  check_image(image, path.string());
  const std::string json = to_json(metadata);
  if (json.size() > format.max_metadata_bytes) {
    fail_input(path.string(), fmt::format("{} bytes of metadata", json.size()),
               fmt::format("at most {} bytes in .{}", format.max_metadata_bytes, format.extension),
               "shorten the recipe or choose another format");
  }
  if (format.oiio != nullptr) return encode_oiio(format.oiio, image, json);
  if (format.extension == "bin") return encode_bin(image, metadata);
  return encode_c_header(path.stem().string(), image, metadata);
}

}  // namespace texture

void check_writable(const std::filesystem::path& path, SampleType type, int channels) {
  texture::format_for(path, type, channels);
  texture::check_replaceable(path);
}

void write_image(const std::filesystem::path& path, const Image& image, Metadata metadata) {
  check_writable(path, image.type, image.channels);
  try {
    metadata.pixel_hash = pixel_hash(image);
    const texture::Bytes bytes = texture::encode(path, image, metadata);
    texture::write_file(path, std::as_bytes(std::span(bytes)));
  } catch (const std::bad_alloc&) {
    throw Error({.code = ErrorCode::over_limit,
                 .what = "not enough memory to make the file",
                 .where = path.string(),
                 .limit = "",
                 .remedy = ""});
  }
}

std::vector<unsigned char> encode_png(const Image& image) {
  const std::string where = "PNG in memory";
  texture::format_for("memory.png", image.type, image.channels);
  texture::check_image(image, where);
  return texture::encode_oiio("png", image, "");
}

void check_text_writable(const std::filesystem::path& path) { texture::check_replaceable(path); }

void make_folder(const std::filesystem::path& path) {
  std::error_code failed;
  std::filesystem::create_directories(path.empty() ? "." : path, failed);
  if (!failed) return;
  throw Error({.code = ErrorCode::io,
               .what = "cannot be made: " + failed.message(),
               .where = path.string(),
               .limit = "",
               .remedy = "name another output folder"});
}

void write_text_file(const std::filesystem::path& path, std::string_view text) {
  texture::write_file(path, std::as_bytes(std::span(text)));
}

}  // namespace bn
