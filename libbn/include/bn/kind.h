// bn/kind.h - floor 3 (bake): what a kind of texture is.
//
// A kind of texture (a blue-noise mask, a set of retarget tiles, ...) is one class derived from Entry, in one
// file of libbn/bake/kinds. It says which options its tables in a recipe have, what making it costs, how it
// is made, what its files record and how they are verified. Recipes, the bake, verification, the command
// line, the manual and the window know kinds only through this header. To add one, write the class and add
// its Kind to libbn/bake/kinds/all.cpp; CONTRIBUTING.md has the steps.

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bn/execution.h"
#include "bn/grid.h"
#include "bn/options.h"
#include "bn/texture.h"
#include "bn/value.h"

namespace bn {

class Entry;

/// A kind of texture.
struct Kind {
  std::string table;  ///< its tables in a recipe are [[table]]; also its name in JSON: "mask"
  std::string title;  ///< for headings: "Blue-noise masks"
  /// Of the command that makes one entry: "noise void-and-cluster". Empty: no command of its own.
  std::string verb;
  std::string summary;                                        ///< one line
  std::string details;                                        ///< paragraphs, parted by empty lines
  std::vector<std::pair<std::string, std::string>> examples;  ///< command, and what it is for
  std::function<std::shared_ptr<Entry>()> make;               ///< an entry with every option at its default
  /// Entries of this kind use all threads by themselves, so a bake makes them one after the other.
  bool one_at_a_time = false;
};

/// All kinds, in the order in which a recipe's tables are baked where nothing depends on anything.
const std::vector<const Kind*>& kinds();
/// The kind whose tables are [[table]]; null if there is none.
const Kind* find_kind(std::string_view table);
/// Adds a kind for the rest of the process. It must outlive every use. Not thread safe; call it at the start.
/// Errors: invalid_input (a table or verb that is taken).
void register_kind(const Kind& kind);

/// Where an entry reports that options do not fit together: the option's key, what is wrong ("needs an
/// image"), what is allowed, what to do.
using Complain =
    std::function<void(std::string_view key, std::string problem, std::string limit, std::string remedy)>;

/// What making an entry takes.
struct Cost {
  double seconds = 0.0;            ///< on one core; a guide for progress, not a promise
  std::uint64_t memory_bytes = 0;  ///< peak
};

/// A texture that an entry is made from: the file of another entry, or any image.
struct Input {
  std::filesystem::path path;  ///< where it was read: a file, a folder of slices or a pattern (bn/volume.h)
  std::string hash;            ///< pixel_hash() of `image`
  Image image;                 ///< of several slices where it is a volume
  bool is_mask = false;        ///< its metadata say that this toolkit made it as a mask
};

/// One file as it is to be written: the picture, and figures of it that making it gave.
struct Picture {
  Image image;                           ///< a volume goes to a path as write_volume() says
  SliceKind slices = SliceKind::layers;  ///< what slices are, for .ktx2 and .dds
  std::vector<TileRecord> tiles = {};    ///< of retarget tiles
};

/// What making an entry gives.
struct Made {
  Facts facts = {};                                    ///< figures for the manifest and JSON
  std::vector<TileRecord> tiles = {};                  ///< of retarget tiles: every motion, row by row
  std::vector<std::string> notes = {};                 ///< what a user should know
  std::function<Picture(std::size_t output)> picture;  ///< of each output; called once for each, in order
};

/// Collects the results of verifying one file.
class Checks {
 public:
  virtual ~Checks() = default;
  /// One item: passes with the text that `check` returns, fails with the Error that it throws. Returns
  /// whether it passed. An empty text adds no item. Errors with cancelled and over_limit go through.
  virtual bool attempt(std::string_view name, const std::function<std::string()>& check) = 0;
};
/// Throws verification_failed. For use inside Checks::attempt().
[[noreturn]] void fail_check(std::string what);

/// One table of a recipe: a texture to be made, and its files.
class Entry {
 public:
  std::string name;  ///< unique in its recipe
  int line = 0;      ///< of its table; 0: made by a program

  virtual ~Entry() = default;
  virtual const Kind& kind() const = 0;
  virtual std::shared_ptr<Entry> clone() const = 0;

  // --- options -------------------------------------------------------------------------------------
  /// The options of this entry, bound to it.
  virtual Options options() = 0;
  /// Goes on to the seeds of the number-th of several entries that share one table (`count`). By default adds
  /// `number` to the option `seed`.
  virtual void take_later_seeds(int number);
  /// Complains of options that do not fit together. Ranges are checked already.
  virtual void check(const Complain&) const {}

  // --- outputs -------------------------------------------------------------------------------------
  virtual std::size_t output_count() const = 0;
  virtual void add_output() = 0;
  /// Drops all outputs but this one.
  virtual void keep_output(std::size_t output) = 0;
  virtual void drop_outputs() = 0;
  /// Relative to the output folder; the extension decides the format.
  virtual std::string& output_path(std::size_t output) = 0;
  virtual int& output_line(std::size_t output) = 0;
  /// Gives the output the defaults that follow from its path and from the entry's options.
  virtual void default_output(std::size_t) {}
  /// Further options of an output, bound to it.
  virtual Options output_options(std::size_t output) = 0;
  /// What the output's file will hold, for checks before the work.
  virtual SampleType output_type(std::size_t output) const = 0;
  virtual int output_channels(std::size_t output) const = 0;
  /// This entry with one output alone.
  std::shared_ptr<Entry> with_output(std::size_t output) const;
  const std::string& path_of(std::size_t output) const {
    return const_cast<Entry*>(this)->output_path(output);
  }
  int line_of_output(std::size_t output) const { return const_cast<Entry*>(this)->output_line(output); }

  // --- what it builds on ---------------------------------------------------------------------------
  /// Which output of `source`, an entry that an option of this one names, is read. Errors: invalid_input (it
  /// has no fitting one).
  virtual std::size_t input_output(const Entry& source) const;
  /// Complains of inputs whose shape does not suit. `shapes` are those of the inputs that are known.
  virtual void check_inputs(const std::vector<Shape>&, const Complain&) const {}
  /// Errors: invalid_input, of inputs without what is read of them (no such channel, NaN).
  virtual void check_input_contents(const std::vector<Input>&) const {}

  // --- making it -----------------------------------------------------------------------------------
  /// The shape of what other entries read from this one, where the options alone decide it.
  virtual std::optional<Shape> shape() const { return std::nullopt; }
  /// Slices of an output; more than one is a volume, whose path has a place for a number (slice_%03d.png) or
  /// an extension that holds volumes.
  virtual int output_depth(std::size_t, const std::vector<Shape>&) const { return 1; }
  virtual Cost cost(const std::vector<Shape>& input_shapes, const Execution& execution) const = 0;
  /// Turns what no recipe can say, a budget by the clock, into what it can. Returns whether anything changed.
  virtual bool settle(const std::vector<Input>&, const Execution&) { return false; }
  virtual Made make(const std::vector<Input>& inputs, const Execution& execution) const = 0;
  /// Where a stopped run is kept beside the first output, so that the next one goes on; empty: nowhere.
  virtual void keep_checkpoint_in(const std::filesystem::path&) {}
  virtual std::filesystem::path checkpoint() const { return {}; }

  // --- what a file says of itself -------------------------------------------------------------------
  /// The part of a file's metadata that follows from the entry and its inputs alone: algorithm, version, kind
  /// and facts. `folder` is the file's, for paths relative to it. A file whose metadata differ is not up to
  /// date.
  virtual Metadata metadata(std::size_t output, const std::vector<Input>& inputs,
                            const std::filesystem::path& folder) const = 0;
  /// The kinds (Metadata::kind) that files of this entry may have: "mask", "retarget-tile".
  virtual std::vector<std::string> file_kinds() const = 0;

  // --- verification ----------------------------------------------------------------------------------
  /// Checks a stored file that claims to be output 0 of this entry. By default the metadata must be those of
  /// the entry and the picture equal to one made again.
  virtual void verify(const Image& image, const Metadata& metadata, const std::filesystem::path& folder,
                      Checks& checks, const Execution& execution) const;
};

/// The options of an entry that is only looked at. Nothing may be set through them.
Options options_of(const Entry& entry);
Options output_options_of(const Entry& entry, std::size_t output);

/// What every kind has alike: cloning, and outputs in a vector. Output has the members path and line.
template <class Self, class Output>
class EntryOf : public Entry {
 public:
  std::vector<Output> outputs;

  std::shared_ptr<Entry> clone() const override {
    return std::make_shared<Self>(static_cast<const Self&>(*this));
  }
  std::size_t output_count() const override { return outputs.size(); }
  void add_output() override { outputs.emplace_back(); }
  void keep_output(std::size_t output) override { outputs = {outputs.at(output)}; }
  void drop_outputs() override { outputs.clear(); }
  std::string& output_path(std::size_t output) override { return outputs.at(output).path; }
  int& output_line(std::size_t output) override { return outputs.at(output).line; }
};

}  // namespace bn
