// bn/volume.h - floor 1: volumes in files. A volume is one file that holds several slices, a picture a slice,
// or one picture in which the slices lie side by side.
//
//   bn::Volume v = bn::read_volume("stbn");                         // a folder: its images in numeric order
//   bn::Volume v = bn::read_volume("stbn/slice_%03d.png");          // all files of that name and a number
//   bn::Volume v = bn::read_volume("strip.png", {.columns = 1});    // one below the other
//   bn::write_volume("volume.ktx2", v.image, *v.metadata);          // a 2D array
//   bn::write_volume("slice_%03d.png", v.image, *v.metadata);       // slice_000.png, slice_001.png, ...

#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bn/execution.h"
#include "bn/texture.h"

namespace bn {

/// Whether the file name of `path` asks for a number: "%d" or "%0Nd", N = 1..9, once. In such a name "%%"
/// stands for "%"; any other name is taken as it is. Errors: invalid_input (two numbers, or one beside a "%"
/// that means something else).
bool has_number(const std::filesystem::path& path);
/// `pattern` with `number` >= 0 in its place. Errors: as above; invalid_input (no place for a number).
std::filesystem::path numbered_path(const std::filesystem::path& pattern, int number);

/// Whether `path` ends as files do that read_image() reads. Looks at the name alone.
bool has_image_name(const std::filesystem::path& path);

/// The images right in a folder (see has_image_name()), in numeric order of their names.
/// Left out are hidden files (their names begin with a dot), what is no regular file, and contact sheets.
/// Errors: io (no such folder, no permission).
std::vector<std::filesystem::path> image_files(const std::filesystem::path& folder);
/// The same of a folder and all folders below it but hidden ones; what cannot be listed below it is passed
/// over.
std::vector<std::filesystem::path> image_files_below(const std::filesystem::path& folder);

/// The files that hold the slices of a volume.
struct SliceFiles {
  std::vector<std::filesystem::path> files;  ///< in their order, at least one
  std::vector<std::string> notes;  ///< that they were put in order, or numbers that a list leaves out
};
/// What `inputs` name: each of them a file, a folder (see image_files()), or a pattern (see has_number()).
/// Several files are put into numeric order, so that 2 comes before 10 however a shell lists them.
/// Where the names differ in one number only, numbers must not be missing in between, nor come twice; in a
/// list of files, which may be a choice, missing ones are noted. Errors: invalid_input (an empty list, a
/// folder or pattern without images or with gaps; a number that comes twice); io.
SliceFiles slice_files(std::span<const std::filesystem::path> inputs);

/// Whether writing to `output`, a file or a pattern, could replace one of the files of `input`, which is a
/// file, a folder of slices or a pattern. Links are followed. What cannot be read is taken for no file.
bool would_replace(const std::filesystem::path& output, const std::filesystem::path& input);

/// How slices lie in one picture: row by row, `columns` to a row. A vertical strip has one column, a
/// horizontal one has one row.
struct AtlasLayout {
  int columns = 0;  ///< 0: the picture is no atlas
  int rows = 0;     ///< 0: as many as make the slices square
};

struct Volume {
  Image image;                           ///< depth 1 where the input is one picture
  SliceKind slices = SliceKind::layers;  ///< as in FileContent
  std::vector<std::filesystem::path> files;
  std::optional<Metadata> metadata;  ///< of the first file
  std::string metadata_fault;        ///< of the first file that has one, as in FileContent
  /// Every file that records a pixel hash has the pixels of that hash. (The hash in `metadata` is that of the
  /// first file as it stands on disk, not that of `image` where slices were put together or an atlas was
  /// cut.)
  bool as_recorded = true;
  std::vector<std::string> notes;          ///< of the files and of their order
  std::vector<std::string> channel_names;  ///< of the first file, as in FileContent
};

/// Reads a volume, or a single picture as one of depth 1. All slices must have the same size, channels and
/// type. Files are read one by one; memory is checked for all of them when the first is known. Thread safe;
/// execution.stop and execution.progress are honoured, threads are not used. Deterministic.
/// Errors: those of read_image() and slice_files(); invalid_input (a slice unlike the first, which names
/// both; several files of which one holds several slices; an atlas that its columns and rows do not divide).
Volume read_volume(std::span<const std::filesystem::path> inputs, AtlasLayout atlas = {},
                   const Execution& execution = {});
Volume read_volume(const std::filesystem::path& input, AtlasLayout atlas = {},
                   const Execution& execution = {});

/// Makes the folder of `path`, a name with a place for a number, if only that folder is missing: files of one
/// series have a folder of their own. Errors: io.
void make_folder_of(const std::filesystem::path& path);

struct VolumeOutput {
  SliceKind slices = SliceKind::layers;  ///< for .ktx2 and .dds
  AtlasLayout atlas = {};                ///< columns > 0: one picture; rows need not be given
};
/// Writes `volume`, in this order of preference: a file a slice, numbered from 0, if `path` has a place for a
/// number, in a folder that is made if only it is missing; one picture if `output.atlas` says so; one file in
/// a format that holds volumes (.ktx2, .dds, .exr, .bin, .h). A volume of one slice may go to any format as a
/// picture. Every file is written as by write_image(), each with the hash of its own pixels. Nothing is
/// written before all paths have been checked; a disk that fills up later leaves whole files, some old, some
/// new. Returns the files. Errors: those of write_image(); invalid_input (several slices for one picture;
/// files that a reader of the pattern would take for further slices; columns that do not divide the slices).
std::vector<std::filesystem::path> write_volume(const std::filesystem::path& path, const Image& volume,
                                                const Metadata& metadata, const VolumeOutput& output = {});

/// Throws what write_volume() would throw for such a volume, without writing. Call it before the work starts.
void check_volume_writable(const std::filesystem::path& path, Shape shape, SampleType type, int channels,
                           const VolumeOutput& output = {});

}  // namespace bn
