// Reading: the file comes into memory once, is known by its signature, and is decoded there.

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <system_error>

#include "bn/volume.h"
#include "texture/codec.h"
#include "texture/error.h"
#include "texture/image.h"
#include "texture/metadata.h"

namespace bn {
namespace texture {
namespace {

struct Signature {
  std::string_view bytes;
  const char* format;
};

using namespace std::string_view_literals;
constexpr std::string_view kPng = "\x89PNG\r\n\x1a\n"sv;
constexpr Signature kSignatures[] = {
    {"\x76\x2f\x31\x01"sv, "openexr"},
    {"II*\0"sv, "tiff"},
    {"MM\0*"sv, "tiff"},
    {"II+\0"sv, "tiff"},
    {"MM\0+"sv, "tiff"},
    {"\xff\xd8\xff"sv, "jpeg"},
    {"GIF87a"sv, "gif"},
    {"GIF89a"sv, "gif"},
    {"#?RADIANCE"sv, "hdr"},
    {"#?RGBE"sv, "hdr"},
};

constexpr std::string_view kExtensions[] = {"png", "exr", "tif", "tiff", "bin", "h",    "ktx2",
                                            "dds", "bmp", "gif", "hdr",  "jpg", "jpeg", "pbm",
                                            "pfm", "pgm", "ppm", "tga",  "webp"};

bool begins_with(ByteView bytes, std::string_view signature) {
  return bytes.size() >= signature.size() &&
         std::memcmp(bytes.data(), signature.data(), signature.size()) == 0;
}

bool is_webp(ByteView bytes) {
  return bytes.size() >= 12 && begins_with(bytes, "RIFF") && begins_with(bytes.subspan(8), "WEBP");
}

/// The whole regular file at `path`.
Bytes read_file(const std::filesystem::path& path, const Execution& execution) {
  const std::string name = path.string();
  const auto fail = [&](int error) {
    fail_io(name, "cannot be read: " + std::generic_category().message(error));
  };
  // Without O_NONBLOCK opening a pipe would wait for a writer.
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) fail(errno);
  const struct Closer {
    int file;
    ~Closer() { ::close(file); }
  } closer{file};

  struct stat status = {};
  if (::fstat(file, &status) != 0) fail(errno);
  if (S_ISDIR(status.st_mode)) fail_io(name, "is a folder");
  if (!S_ISREG(status.st_mode))
    fail_io(name, "is not a regular file, and pipes and devices are not read",
            "write a file first and name it here");
  check_memory(execution, static_cast<std::uint64_t>(status.st_size), name);

  Bytes bytes(static_cast<std::size_t>(status.st_size));
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::read(file, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(errno);
    if (count == 0) break;  // it was cut while we read; the decoder will say what is missing
    done += static_cast<std::size_t>(count);
  }
  bytes.resize(done);
  return bytes;
}

/// The metadata of a DDS. A fault of their file is no fault of the picture.
void read_metadata_beside(const std::filesystem::path& dds, const Execution& execution,
                          FileContent& content) {
  const std::filesystem::path beside = metadata_beside(dds);
  std::error_code error;
  if (!std::filesystem::is_regular_file(beside, error)) return;
  Execution bounded = execution;
  bounded.memory_limit_bytes = std::min<std::uint64_t>(execution.memory_limit_bytes, 4 * kMaxMetadataBytes);
  try {
    const Bytes json = read_file(beside, bounded);
    read_description({reinterpret_cast<const char*>(json.data()), json.size()}, content);
  } catch (const Error& problem) {
    content.metadata_fault = problem.what();
  }
}

Decoded decode_by_content(ByteView bytes, const std::string& name, const Execution& execution) {
  if (bytes.empty()) fail_input(name, "an empty file");
  if (is_bin(bytes)) return decode_bin(bytes, name, execution);
  if (is_c_header(bytes)) return decode_c_header(bytes, name, execution);
  if (is_ktx2(bytes)) return decode_ktx2(bytes, name, execution);
  if (is_dds(bytes)) return decode_dds(bytes, name, execution);
  if (begins_with(bytes, kPng)) return decode_png(bytes, name, execution);
  for (const Signature& signature : kSignatures) {
    if (begins_with(bytes, signature.bytes)) return decode_oiio(bytes, signature.format, name, execution);
  }
  if (is_webp(bytes)) return decode_oiio(bytes, "webp", name, execution);
  if (is_pnm(bytes)) return decode_pnm(bytes, name, execution);
  if (is_bmp(bytes)) return decode_bmp(bytes, name, execution);
  // A TGA has no signature.
  if (extension_of(name) == "tga") return decode_oiio(bytes, "tga", name, execution);
  fail_input(
      name, "not an image of a known format",
      "PNG, EXR, TIFF, KTX2, DDS, .bin, .h, BMP, GIF, HDR, JPEG, PBM, PGM, PPM, PFM, WebP by content, TGA by "
      "extension");
}

}  // namespace

Decoded decode(ByteView bytes, const std::string& name, const Execution& execution) {
  try {
    return decode_by_content(bytes, name, execution);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error({.code = ErrorCode::over_limit,
                 .what = "not enough memory to decode it",
                 .where = name,
                 .limit = "",
                 .remedy = ""});
  } catch (const std::exception& error) {
    fail_input(name, fmt::format("cannot be decoded: {}", error.what()));
  }
}

FileContent read_any(const std::filesystem::path& path, const Execution& execution) {
  const Bytes bytes = read_file(path, execution);
  Decoded decoded = decode(std::as_bytes(std::span(bytes)), path.string(), execution);
  FileContent content{.image = std::move(decoded.image),
                      .slices = decoded.slices,
                      .notes = std::move(decoded.notes),
                      .channel_names = std::move(decoded.channel_names),
                      .metadata = {},
                      .metadata_fault = {}};
  if (is_dds(std::as_bytes(std::span(bytes)))) {
    read_metadata_beside(path, execution, content);
  } else {
    read_description(decoded.description, content);
  }
  return content;
}

}  // namespace texture

bool has_image_name(const std::filesystem::path& path) {
  return std::find(std::begin(texture::kExtensions), std::end(texture::kExtensions),
                   texture::extension_of(path)) != std::end(texture::kExtensions);
}

FileContent read_image(const std::filesystem::path& path, const Execution& execution) {
  FileContent content = texture::read_any(path, execution);
  if (content.image.depth > 1) {
    texture::fail_input(path.string(), fmt::format("a volume of {} slices", content.image.depth),
                        "one picture", "take one slice out of it, or give it where a volume is asked for");
  }
  return content;
}

std::string read_text_file(const std::filesystem::path& path, const Execution& execution) {
  const texture::Bytes bytes = texture::read_file(path, execution);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace bn
