// Writing: check, make the file in memory, put it in place crash-safely.

#include <fmt/format.h>

#include <new>

#include "bn/texture.h"
#include "texture/codec.h"
#include "texture/error.h"
#include "texture/gpu_format.h"
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
  bool halves;
  bool volumes;
  int max_channels = static_cast<int>(kMaxChannels);
  std::size_t max_metadata_bytes = kMaxMetadataBytes;
};

constexpr Format kFormats[] = {
    {"png", nullptr, true, false, false, false, 4},
    {"exr", "openexr", false, true, true, true},
    {"tif", "tiff", true, true, false, false, kMaxChannels, kMaxTiffDescription},
    {"tiff", "tiff", true, true, false, false, kMaxChannels, kMaxTiffDescription},
    {"bin", nullptr, true, true, true, true},
    {"h", nullptr, true, true, false, true},
    {"ktx2", nullptr, true, true, true, true, 4},
    {"dds", nullptr, true, true, true, true, 4},
};

bool holds(const Format& format, SampleType type) {
  switch (type) {
    case SampleType::u8:
    case SampleType::u16:
      return format.integers;
    case SampleType::f32:
      return format.floats;
    case SampleType::f16:
      return format.halves;
  }
  return false;
}

const Format* find_format(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  for (const Format& format : kFormats) {
    if (format.extension == extension) return &format;
  }
  return nullptr;
}

/// "8bit, 16bit, float": what the format holds.
std::string types_of(const Format& format) {
  std::string types;
  for (const SampleType type : {SampleType::u8, SampleType::u16, SampleType::f16, SampleType::f32}) {
    if (holds(format, type)) types += (types.empty() ? "" : ", ") + std::string(name_of(type));
  }
  return types;
}

/// The formats that hold what another does not.
template <class Holds>
std::string others(Holds holds) {
  std::string names;
  for (const Format& format : kFormats) {
    if (format.extension != "tiff" && holds(format))
      names += fmt::format("{}.{}", names.empty() ? "" : ", ", format.extension);
  }
  return "write one of " + names;
}

/// The format that the extension names, or an error if there is none.
const Format& format_of(const std::filesystem::path& path) {
  if (const Format* const found = find_format(path)) return *found;
  std::string extensions;
  for (const Format& format : kFormats) {
    extensions += fmt::format("{}.{}", extensions.empty() ? "" : ", ", format.extension);
  }
  const std::string extension = extension_of(path);
  fail_input(path.string(),
             extension.empty() ? "no extension" : fmt::format("unknown extension '.{}'", extension),
             extensions);
}

/// The format that the extension names, or an error if it cannot hold such samples.
const Format& format_for(const std::filesystem::path& path, SampleType type, int channels, int depth) {
  const std::string where = path.string();
  const Format& format = format_of(path);
  const auto cannot = [&](std::string what, std::string limit, std::string remedy) {
    fail_input(where, fmt::format(".{} cannot hold {}", format.extension, what), std::move(limit),
               std::move(remedy));
  };
  if (!holds(format, type)) {
    cannot(fmt::format("{} samples", name_of(type)), types_of(format),
           others([&](const Format& other) { return holds(other, type); }));
  }
  check_shape(1, 1, channels, where);
  check_depth(depth, where);
  const auto many = [&](const Format& other) { return holds(other, type) && other.max_channels >= channels; };
  if (channels > format.max_channels) {
    cannot(fmt::format("{} channels", channels), fmt::format("1..{}", format.max_channels), others(many));
  }
  // DXGI has no format of three channels but that of floats.
  if (format.extension == "dds" && gpu_format(type, channels)->dxgi == 0) {
    cannot(fmt::format("3 channels of {}", name_of(type)), "1, 2, 4; of float 3 too",
           "add a fourth channel, or write .ktx2");
  }
  if (depth > 1 && !format.volumes) {
    cannot(fmt::format("{} slices", depth), "one picture",
           others([&](const Format& other) { return other.volumes && many(other); }) +
               ", or a picture a slice: NAME_%03d." + std::string(format.extension));
  }
  return format;
}

}  // namespace

bool holds_volumes(const std::filesystem::path& path) {
  const Format* const format = find_format(path);
  return format != nullptr && format->volumes;
}

std::filesystem::path metadata_beside(const std::filesystem::path& dds) {
  std::filesystem::path beside = dds;
  return beside += ".json";
}

Bytes encode(const std::filesystem::path& path, const Image& image, const Metadata& metadata,
             SliceKind slices) {
  const Format& format = format_for(path, image.type, image.channels, image.depth);
  check_image(image, path.string());
  const std::string json = to_json(metadata);
  if (json.size() > format.max_metadata_bytes) {
    fail_input(path.string(), fmt::format("{} bytes of metadata", json.size()),
               fmt::format("at most {} bytes in .{}", format.max_metadata_bytes, format.extension),
               "shorten the recipe or choose another format");
  }
  if (format.oiio != nullptr) return encode_oiio(format.oiio, image, json);
  if (format.extension == "png") return encode_png(image, json);
  if (format.extension == "bin") return encode_bin(image, metadata);
  if (format.extension == "ktx2") return encode_ktx2(image, metadata, slices);
  if (format.extension == "dds") return encode_dds(image, slices);
  return encode_c_header(path.stem().string(), image, metadata);
}

namespace {

bool is_dds_name(const std::filesystem::path& path) { return extension_of(path) == "dds"; }

/// A DDS and the file of its metadata. Two files cannot change at once. The metadata come first: if the
/// second write fails, the first is undone; if the process is killed between them, the pixel hash in the new
/// metadata does not fit the old picture, which bn verify reports.
void write_dds(const std::filesystem::path& path, const Bytes& bytes, const Metadata& metadata) {
  const std::filesystem::path beside = metadata_beside(path);
  std::error_code error;
  std::optional<std::string> old;
  if (std::filesystem::exists(beside, error)) old = read_text_file(beside);
  write_text_file(beside, to_json(metadata, 2) + "\n");
  try {
    write_file(path, std::as_bytes(std::span(bytes)));
  } catch (...) {
    try {
      if (old) {
        write_text_file(beside, *old);
      } else {
        std::filesystem::remove(beside, error);
      }
    } catch (const Error&) {
      // The first failure is the one to report.
    }
    throw;
  }
}

}  // namespace
}  // namespace texture

void check_extension(const std::filesystem::path& path) { texture::format_of(path); }

void check_writable(const std::filesystem::path& path, SampleType type, int channels, int depth) {
  texture::format_for(path, type, channels, depth);
  texture::check_replaceable(path);
  if (texture::is_dds_name(path)) texture::check_replaceable(texture::metadata_beside(path));
}

void write_image(const std::filesystem::path& path, const Image& image, Metadata metadata, SliceKind slices) {
  check_writable(path, image.type, image.channels, image.depth);
  try {
    metadata.pixel_hash = pixel_hash(image);
    const texture::Bytes bytes = texture::encode(path, image, metadata, slices);
    if (texture::is_dds_name(path)) return texture::write_dds(path, bytes, metadata);
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
  texture::format_for("memory.png", image.type, image.channels, image.depth);
  texture::check_image(image, where);
  return texture::encode_png(image, "");
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
