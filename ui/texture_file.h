// A texture as the Texture view holds it: slices of equal size from one file, an atlas, or a folder.

#pragma once

#include <bit>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bn/retarget_anneal.h"
#include "bn/spectrum.h"
#include "bn/texture.h"
#include "bn/volume.h"
#include "ui/image_view.h"

namespace bn::ui {

struct TextureFile {
  std::filesystem::path path;                ///< a file, or a folder of slices
  std::vector<std::filesystem::path> files;  ///< in the order of the slices
  std::vector<Image> images;                 ///< one a file, of one size, type and number of channels
  std::optional<Metadata> metadata;          ///< of the first file
  std::string metadata_fault;
  bool hash_fits = true;                   ///< of the first file
  std::optional<AnnealOptions> annealing;  ///< how it was made, by its recipe, where it was annealed
};

/// Bytes of samples that one texture may have.
inline constexpr std::uint64_t kMaxTextureBytes = std::uint64_t{2} << 30;

/// Reads a file, or the images of a folder, ordered as people order names. Errors: io, invalid_input (none,
/// sizes that differ), over_limit, cancelled.
TextureFile read_texture(const std::filesystem::path& path, const Execution& execution);

/// How an atlas is cut into slices: row by row.
struct AtlasCut {
  int columns = 1, rows = 1;
  int count() const { return columns * rows; }
  friend bool operator==(const AtlasCut&, const AtlasCut&) = default;
};

/// What the metadata say, or, without any, a strip of squares; else one piece. Stacks are never cut.
AtlasCut guess_cut(const TextureFile& texture);
/// Whether the cut leaves whole pixels.
bool fits(const TextureFile& texture, const AtlasCut& cut);

/// The slices of a stack, or the tiles of an atlas.
int slice_count(const TextureFile& texture, const AtlasCut& cut);
Extent slice_size(const TextureFile& texture, const AtlasCut& cut);
Image slice(const TextureFile& texture, const AtlasCut& cut, int index);

inline constexpr unsigned kAllChannels = 15;

/// Which samples of a texture are shown.
struct Section {
  AtlasCut cut;
  unsigned channels = kAllChannels;  ///< bit c: channel c
  bool moves = false;                ///< of a retarget tile, as hues; channels are not used
  bool xz = false;                   ///< time downwards, at row `index`; else slice `index`
  int index = 0;
  friend bool operator==(const Section&, const Section&) = default;
};
/// The first of the chosen channels: the one that spectrum and figures are of.
inline int first_channel(const Section& section) { return std::countr_zero(section.channels); }
/// Whether it says of itself that it holds retarget tiles.
bool is_retarget(const TextureFile& texture);
/// Of an atlas with a tile for each motion: its range, as in recipes; else 0.
int motion_range(const TextureFile& texture);
/// Whether its samples are a retarget tile's moves.
bool holds_moves(const TextureFile& texture);
/// Radius, reach and motion of tile `index` of such a texture.
RetargetOptions move_options(const TextureFile& texture, int index);
Picture picture_of(const TextureFile& texture, const Section& section);

/// What is in one channel of the whole stack, or of one slice: spectrum and figures.
struct TextureAnalysis {
  std::shared_ptr<const Picture> plane_picture;    ///< power in decibels: of the slices, (kx, ky)
  std::shared_ptr<const Picture> in_time_picture;  ///< (kx, kz); null where there is one slice
  RadialCurve radial;                              ///< of the slices
  RadialCurve time;                                ///< by frequency in time; empty where there is one slice
  FiguresOfMerit figures;
};
/// `index` < 0: the stack as a volume. Errors: as analyse().
TextureAnalysis analyse_texture(const TextureFile& texture, const AtlasCut& cut, int channel, int index,
                                const Execution& execution);

}  // namespace bn::ui
