// bn/texture.h - floor 1: images on disk, what their samples mean, and what is written into them.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bn/core.h"

namespace bn {

// --- images ------------------------------------------------------------------------------------

enum class SampleType { u8, u16, f32 };

/// "8bit", "16bit", "float": the words of flags, recipes and JSON.
std::string_view name_of(SampleType type);
std::size_t bytes_per_sample(SampleType type);

/// Figures of one retarget tile, as recorded in a file.
struct TileRecord {
  Offset motion;
  std::int64_t start_energy = 0;
  std::int64_t energy = 0;
  std::int64_t lower_bound = 0;
  friend bool operator==(const TileRecord&, const TileRecord&) = default;
};

/// What every file says of itself. Stored as one JSON object (schema in docs/conventions.md) in the
/// image's description: PNG text, EXR and TIFF ImageDescription, a comment in .h, the header of .bin.
struct Metadata {
  std::string tool_version{kVersion};
  std::string algorithm;      ///< "void-and-cluster", "retarget-exact", ...
  int algorithm_version = 0;
  std::string kind;           ///< "mask", "retarget-tile", "retarget-atlas", "contact-sheet"
  std::string recipe;         ///< TOML that makes this file again, whole
  std::optional<std::uint64_t> seed;
  std::optional<Offset> step;
  std::optional<int> radius;
  std::optional<std::string> reach;   ///< "chebyshev", "euclidean"
  std::optional<std::string> metric;  ///< "l1", "l2"
  std::optional<bool> wrap;
  std::optional<std::string> form;    ///< "scatter", "gather"
  std::optional<std::string> source;       ///< for retarget: the mask's file, relative to this file
  std::optional<int> source_channel;
  std::optional<std::string> source_hash;  ///< its pixel hash
  std::vector<TileRecord> tiles;  ///< one for a tile, one per motion for an atlas, row by row
  std::string pixel_hash;         ///< filled in by write_image()
  friend bool operator==(const Metadata&, const Metadata&) = default;
};

/// Interleaved samples in native byte order, origin top-left, linear (never colour-managed).
struct Image {
  Extent size;
  int channels = 0;
  SampleType type = SampleType::u8;
  std::vector<std::byte> samples;  ///< size.area() * channels * bytes_per_sample(type)
};

/// "xxh3-128:" and 32 hexadecimal digits over width, height, channels, sample type and the samples
/// in little-endian order: the same for the same picture in any file format.
std::string pixel_hash(const Image& image);

struct FileContent {
  Image image;
  std::optional<Metadata> metadata;  ///< absent in files that this toolkit did not write
};

/// Reads PNG, EXR, TIFF and what else OpenImageIO knows, and our own .bin. Hostile headers are
/// refused before memory is taken: sides 1..65536, channels 1..64, decoded size within
/// execution.memory_limit_bytes. Other sample types are widened to the nearest of ours.
/// Errors: io (cannot be opened), invalid_input (not an image, truncated, corrupt), over_limit.
FileContent read_image(const std::filesystem::path& path, const Execution& execution = {});

/// Writes `image` in the format the extension names: .png (8bit, 16bit; 1..4 channels), .exr, .tif,
/// .tiff, .h (C array), .bin. Byte-identical for equal arguments. Temporary in the same folder,
/// checked writes, flush to disk, rename: a failure leaves an old file as it was, and no litter.
/// Errors: io; invalid_input (an extension or a sample type that the format cannot hold).
void write_image(const std::filesystem::path& path, const Image& image, Metadata metadata);

/// Throws what write_image() would throw for this path and type, without writing: unknown
/// extension, unfit sample type, missing folder, no permission. Call it before the work starts.
void check_writable(const std::filesystem::path& path, SampleType type, int channels);

/// The same crash-safe path for text: manifests, CSV, HTML.
void write_text_file(const std::filesystem::path& path, std::string_view text);

// --- encodings (docs/conventions.md) -------------------------------------------------------------

/// A rank mask as samples: 8bit floor(rank * 256 / N), 16bit floor(rank * 65536 / N), float
/// (rank + 0.5) / N. One channel.
Image encode_mask(const Grid<std::uint32_t>& rank, SampleType type);

/// Moves as 8bit RGB: red = x + 128, green = y + 128, blue = 0. Each component -128..127, checked.
Image encode_moves(const Grid<Offset>& move);
/// The inverse. Errors: invalid_input unless 8bit with at least two channels.
Grid<Offset> decode_moves(const Image& image);

/// Equal images laid out row by row, `columns` to a row; their number is a multiple of it.
Image make_atlas(const std::vector<Image>& tiles, int columns);
/// Tile number `index` of an atlas of tiles of `tile_size`.
Image atlas_tile(const Image& atlas, Extent tile_size, int index);

/// One channel as integer levels, the unit in which energies are stated.
struct Levels {
  Grid<std::int32_t> value;  ///< 8bit 0..255, 16bit 0..65535, float 0..65535 over [minimum, maximum]
  double unit = 1.0;         ///< sample difference of one level (for float (maximum - minimum) / 65535)
  double offset = 0.0;       ///< sample value of level 0
  double rounding_error = 0; ///< largest |sample - (offset + unit * level)|; 0 for integer images
  int distinct = 0;          ///< number of different levels
  bool is_permutation = false;  ///< every level (or rank) equally often, as in a baked mask
};

/// Errors: invalid_input (no such channel; NaN or infinity, with count and first position).
Levels levels_of_channel(const Image& image, int channel);

}  // namespace bn
