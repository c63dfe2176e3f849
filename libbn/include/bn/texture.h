// bn/texture.h - floor 2: images on disk, what their samples mean, and what is written into them.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bn/execution.h"
#include "bn/grid.h"
#include "bn/value.h"
#include "bn/version.h"

namespace bn {

// --- images ------------------------------------------------------------------------------------

/// The numbers 0, 1, 2 and 3 stand in pixel hashes and in .bin, so they never change.
enum class SampleType { u8, u16, f32, f16 };

/// "8bit", "16bit", "float", "half": the words of flags, recipes and JSON.
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

/// What every file says of itself. Stored as one JSON object (schema in docs/files.md) in the image's
/// description: PNG text "Description", EXR "comments", TIFF ImageDescription, a comment in .h, the
/// metadata block of .bin, the key "bn-metadata" of KTX2, the file NAME.dds.json beside NAME.dds.
struct Metadata {
  std::string tool_version{kVersion};
  std::string algorithm;  ///< "void-and-cluster", "retarget-exact", ...
  int algorithm_version = 0;
  std::string kind;    ///< "mask", "retarget-tile", "retarget-atlas", "contact-sheet"
  std::string recipe;  ///< TOML that makes this file again, whole
  /// What else identifies the file, by its recipe's names: seed, step, radius, ... For retarget tiles also
  /// the mask's file (source, relative to this one), its channel (source_channel) and its pixel hash
  /// (source_hash).
  Facts facts;
  std::vector<TileRecord> tiles;  ///< one for a tile, one per motion for an atlas, row by row
  std::string pixel_hash;         ///< filled in by write_image()
  friend bool operator==(const Metadata&, const Metadata&) = default;
};

/// `metadata` as JSON: members in a fixed order, pure ASCII; on one line, or indented if `indent` >= 0.
/// Errors: invalid_input (text that is not UTF-8).
std::string to_json(const Metadata& metadata, int indent = -1);

/// The inverse. Members beyond those of every file are facts: truths, numbers, texts, and lists of whole
/// numbers; at most 64, with names of 1..40 of the characters a..z, 0..9 and '_'. Strict: errors with
/// invalid_input on anything else, a missing member, a wrong type, a number out of range, or another version
/// of the schema.
Metadata metadata_from_json(std::string_view json);

/// A picture, or a volume of several slices. Samples are interleaved, in native byte order, row by row from
/// the top left and slice after slice; they are linear (never colour-managed), and none is multiplied by
/// alpha.
struct Image {
  Extent size;    ///< of a slice
  int depth = 1;  ///< slices, 1..65536; 1 for a picture
  int channels = 0;
  SampleType type = SampleType::u8;
  std::vector<std::byte> samples;  ///< shape().count() * channels * bytes_per_sample(type)

  Shape shape() const { return {size.width, size.height, depth}; }
};

/// "xxh3-128:" and 32 hexadecimal digits over width, height, channels, sample type, the depth where it is
/// above 1, and the samples in little-endian order: the same for the same picture or volume in any file
/// format.
std::string pixel_hash(const Image& image);

/// A float image as half floats. Each sample becomes the nearest half float, of two equally near the one
/// whose last bit is 0; NaN stays NaN, infinity stays infinity, the sign of zero is kept, and what is too
/// small for a normal half float becomes a subnormal one. So every value that a half float can hold comes
/// through unchanged. Errors: invalid_input (not float; a finite sample that would become infinite, which is
/// 65520 and above).
Image to_half(const Image& image);
/// A half image as floats, without any loss. Errors: invalid_input (not half).
Image to_float(const Image& image);

/// What the slices of a volume are to an engine that loads a KTX2 or DDS file.
enum class SliceKind {
  layers,  ///< layers of a 2D array: one is chosen by its number, nothing is filtered across
  depth,   ///< the third axis of a 3D texture
};

/// What the channels of a texture mean, and how its tiles or slices lie, in sentences for people; none where
/// the metadata do not tell. Deterministic.
std::vector<std::string> content_description(const Image& image, const Metadata& metadata);

struct FileContent {
  Image image;
  SliceKind slices = SliceKind::layers;  ///< how a KTX2 or DDS holds several slices
  /// What is worth knowing of the file beside its samples: mip levels left out, a flag for sRGB or
  /// premultiplied alpha, several parts, a maxval. No error.
  std::vector<std::string> notes;
  /// What an EXR calls its channels, in their order: R, G, B and A first, then by the alphabet. Empty in
  /// formats without such names.
  std::vector<std::string> channel_names;
  std::optional<Metadata> metadata;  ///< absent in files that this toolkit did not write
  /// Why metadata of ours is there and cannot be read (cut short, edited, from a newer version); empty
  /// otherwise. The picture stands; whoever needs the metadata treats a fault as an error.
  std::string metadata_fault;
};

/// Reads PNG, EXR, TIFF, KTX2, DDS, our own .bin and .h, BMP, GIF, HDR, JPEG, PBM, PGM, PPM, PFM and WebP
/// (all known by their content), and TGA (known by the extension). Samples are those stored: no colour
/// management, no multiplication by alpha, no scaling to a maxval. Palettes and 1, 2 and 4 bit grey are
/// expanded to 8bit; signed and 32 bit integers become floats of the same value,
/// rounded to 24 bits; what could only be read converted is refused (double; TIFF of grey from white to
/// black, YCbCr or Lab; JPEG of CMYK). docs/files.md has the whole list. Recomputes nothing: a pixel hash
/// that does not fit is for the caller to compare. Hostile headers are refused before memory is taken:
/// sides 1..65536, channels 1..64, file and decoded size together within execution.memory_limit_bytes, at
/// most 10,000 decoded bytes a file byte. Only regular files are read. Thread safe. execution.stop is
/// honoured, threads are not used. A file that holds several slices is refused, so that no caller takes a
/// volume for a picture: read_volume() of bn/volume.h reads it. Errors: io (cannot be opened or read; a pipe
/// or device), invalid_input (not an image, truncated, corrupt, deep or volumetric), over_limit, cancelled.
FileContent read_image(const std::filesystem::path& path, const Execution& execution = {});

/// Writes `image` in the format the extension names (upper or lower case):
///   .png         8bit, 16bit; 1..4 channels (the second of two and the fourth are straight alpha)
///   .exr         half, float; volumes, a part a slice
///   .tif, .tiff  8bit, 16bit, float
///   .bin         8bit, 16bit, half, float; volumes; layout in docs/files.md
///   .h           8bit, 16bit, float; volumes; no NaN or infinity
///   .ktx2        8bit, 16bit, half, float; 1..4 channels; volumes
///   .dds         8bit, 16bit, half, float; 1, 2 or 4 channels, of float also 3; volumes
/// The metadata take at most 4 MiB as JSON, in TIFF 64 KiB. Those of NAME.dds go to NAME.dds.json, which is
/// written first; when the .dds then cannot be written, the old .json is put back.
/// `slices` says what an engine makes of the slices of a volume in .ktx2 and .dds.
/// Byte-identical for equal arguments and one version of the libraries. The file is made in memory,
/// then a temporary in the same folder is written, checked, flushed to disk and renamed: a failure or
/// a kill leaves an old file as it was, and no litter. Of two writers at once the last one's file
/// stands, whole. A symbolic link is followed. Thread safe.
/// Errors: io; invalid_input (an extension, sample type or shape that the format cannot hold).
void write_image(const std::filesystem::path& path, const Image& image, Metadata metadata,
                 SliceKind slices = SliceKind::layers);

/// Whether name `a` comes before `b` as people order names: digits by their value, so slice_2 before
/// slice_10.
bool natural_less(std::string_view a, std::string_view b);

/// Throws invalid_input unless write_image() knows the extension of `path`. Looks at the name alone.
void check_extension(const std::filesystem::path& path);

/// Throws what write_image() would throw for this path and type, without writing: unknown
/// extension, unfit sample type, missing folder, no permission. Call it before the work starts.
void check_writable(const std::filesystem::path& path, SampleType type, int channels, int depth = 1);

/// A PNG in memory, without metadata, for embedding. 8bit or 16bit; 1..4 channels. The same bytes for
/// equal images and one version of the libraries. Errors: invalid_input (a type or shape that PNG cannot
/// hold).
std::vector<unsigned char> encode_png(const Image& image);

/// The same crash-safe path for text: manifests, CSV, HTML. Errors: io.
void write_text_file(const std::filesystem::path& path, std::string_view text);

/// All of a regular file, within the memory limit. Errors: io, over_limit.
std::string read_text_file(const std::filesystem::path& path, const Execution& execution = {});

/// Makes a folder and those above it, where they are missing; "" is the current one. Errors: io.
void make_folder(const std::filesystem::path& path);

/// Throws what write_text_file() would throw for this path, without writing.
void check_text_writable(const std::filesystem::path& path);

// --- encodings (docs/conventions.md) -------------------------------------------------------------

/// A rank mask, or a volume of ranks, as samples: 8bit floor(rank * 256 / N), 16bit floor(rank * 65536 / N),
/// float (rank + 0.5) / N, half the nearest half float to that. N is the number of ranks, of a volume in all
/// slices. One channel. Errors: invalid_input (a rank >= N).
Image encode_mask(const Grid<std::uint32_t>& rank, SampleType type);
/// Several masks as the channels of one image, in their order. Errors: as above; invalid_input (no mask, more
/// than 64, masks of different shapes).
Image encode_masks(std::span<const Grid<std::uint32_t>> ranks, SampleType type);

/// Moves as RGB. 8bit: red = x + 128, green = y + 128, blue = 0. Half and float:
/// red = x, green = y, blue = 0. Each component -128..127, checked. Errors: invalid_input (a component that
/// does not fit, a volume, another sample type).
Image encode_moves(const Grid<Offset>& move, SampleType type = SampleType::u8);
/// The inverse. Errors: invalid_input unless 8bit, half or float with at least two channels, of one slice,
/// and, of the last two, whole numbers -128..127.
Grid<Offset> decode_moves(const Image& image);

/// Moves in a volume: `z` is the third axis of `move`, and of the same shape.
struct VolumeMoves {
  Grid<Offset> move;
  Grid<std::int8_t> z;
};
/// Moves in a volume as RGB, of as many slices. 8bit: red = x + 128, green = y + 128, blue = z + 128. Half
/// and float: red = x, green = y, blue = z. Errors: invalid_input (an x or y outside -128..127, grids of
/// different shapes, another sample type).
Image encode_moves(const Grid<Offset>& move, const Grid<std::int8_t>& z, SampleType type = SampleType::u8);
/// The inverse. Errors: invalid_input unless 8bit, half or float with at least three channels, and, of the
/// last two, whole numbers -128..127.
VolumeMoves decode_volume_moves(const Image& image);

/// One channel of an image, for packing.
struct ChannelRef {
  const Image* image = nullptr;
  int channel = 0;
};
/// The channels, in their order, as one image. Nothing is converted. Errors: invalid_input (none, more than
/// 64, no such channel, images of different shapes or sample types), with the number of the offending one.
Image pack_channels(std::span<const ChannelRef> channels);

/// Slice z of a volume, or the picture itself. Errors: invalid_input (no such slice).
Image slice_of(const Image& volume, int z);
/// Pictures as the slices of a volume, in their order. Errors: invalid_input (none, more than 65536, one that
/// is itself a volume, or is unlike the first in size, channels or type; with its number).
Image stack_slices(std::span<const Image> slices);

/// Equal pictures laid out row by row, `columns` to a row; their number is a multiple of it.
/// Errors: invalid_input (none, unequal ones, volumes, an atlas of more than 65536 pixels a side).
Image make_atlas(const std::vector<Image>& tiles, int columns);
/// Tile number `index`, row by row, of an atlas of tiles of `tile_size`. Errors: invalid_input (the
/// atlas is no multiple of the tile, or has no such tile).
Image atlas_tile(const Image& atlas, Extent tile_size, int index);

/// One channel as it is stored, for analysis.
struct ChannelSamples {
  std::vector<double> value;
  /// What an even spread of samples covers: 8bit 0..256, 16bit 0..65536, float and half 0..1, or
  /// least..greatest sample where they leave 0..1.
  double low = 0.0, high = 1.0;
};

/// The samples of one channel, of a volume slice after slice; NaN and infinity are kept.
/// Errors: invalid_input (no such channel).
ChannelSamples samples_of_channel(const Image& image, int channel);
/// Puts `next` behind what `stack` holds, as the next slice of a volume; the range covers both.
void append_samples(ChannelSamples& stack, const ChannelSamples& next);

/// One channel as integer levels, the unit in which energies are stated.
struct Levels {
  Grid<std::int32_t> value;  ///< 8bit 0..255, 16bit 0..65535, float and half 0..65535 over [minimum, maximum]
  double unit = 1.0;    ///< sample difference of one level; float: (maximum - minimum) / 65535, constant: 1
  double offset = 0.0;  ///< sample value of level 0
  double rounding_error = 0;  ///< largest |sample - (offset + unit * level)|; 0 for integer images
  int distinct = 0;           ///< number of different levels
  /// As evenly spread as a baked mask of N pixels: min(N, levels of the type) different levels, each
  /// equally often up to one; for float and half N different samples, or exactly those of encode_mask().
  bool is_permutation = false;
};

/// The samples of one channel as levels. A float s becomes the level nearest to (s - offset) / unit.
/// Errors: invalid_input (no such channel; NaN or infinity, with count and first position).
Levels levels_of_channel(const Image& image, int channel);

}  // namespace bn
