// bn/kinds.h - floor 3 (bake): the kinds of texture as classes, for programs that make them.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bn/kind.h"
#include "bn/noise.h"
#include "bn/retarget.h"
#include "bn/retarget_anneal.h"
#include "bn/spatiotemporal.h"
#include "bn/vector_mask.h"

namespace bn {

// --- masks ---------------------------------------------------------------------------------------

/// One file of a mask.
struct MaskOutput {
  std::string path;
  SampleType type = SampleType::u8;
  int line = 0;
};

/// `[[mask]]`: a blue-noise mask by void-and-cluster, of one to four channels.
class MaskEntry : public EntryOf<MaskEntry, MaskOutput> {
 public:
  VoidAndClusterOptions void_and_cluster = {};
  int channels = 1;  ///< 1..4, each a mask of its own: channel c is the mask of the seed + c

  const Kind& kind() const override;
  Options options() override;
  void take_later_seeds(int number) override;
  void default_output(std::size_t output) override;
  Options output_options(std::size_t output) override;
  SampleType output_type(std::size_t output) const override { return outputs.at(output).type; }
  int output_channels(std::size_t) const override { return channels; }
  std::optional<Shape> shape() const override { return void_and_cluster.size; }
  Cost cost(const std::vector<Shape>& input_shapes, const Execution& execution) const override;
  Made make(const std::vector<Input>& inputs, const Execution& execution) const override;
  Metadata metadata(std::size_t output, const std::vector<Input>& inputs,
                    const std::filesystem::path& folder) const override;
  std::vector<std::string> file_kinds() const override { return {"mask"}; }
};

// --- spatiotemporal masks -------------------------------------------------------------------------

/// `[[spatiotemporal]]`: a blue-noise mask in a volume, a slice a frame. Depth 1: a mask made for a blur.
class SpatiotemporalEntry : public EntryOf<SpatiotemporalEntry, MaskOutput> {
 public:
  SpatiotemporalOptions mask = {};

  const Kind& kind() const override;
  Options options() override;
  void check(const Complain& complain) const override;
  void default_output(std::size_t output) override;
  Options output_options(std::size_t output) override;
  SampleType output_type(std::size_t output) const override { return outputs.at(output).type; }
  int output_channels(std::size_t) const override { return 1; }
  std::optional<Shape> shape() const override { return mask.size; }
  int output_depth(std::size_t, const std::vector<Shape>&) const override { return mask.size.depth; }
  Cost cost(const std::vector<Shape>& input_shapes, const Execution& execution) const override;
  Made make(const std::vector<Input>& inputs, const Execution& execution) const override;
  Metadata metadata(std::size_t output, const std::vector<Input>& inputs,
                    const std::filesystem::path& folder) const override;
  std::vector<std::string> file_kinds() const override { return {"spatiotemporal-mask"}; }
};

// --- vector masks ---------------------------------------------------------------------------------

/// `[[vector]]`: a blue-noise mask of vectors or directions, a slice a frame.
class VectorEntry : public EntryOf<VectorEntry, MaskOutput> {
 public:
  VectorMaskOptions vectors = {};

  const Kind& kind() const override;
  Options options() override;
  void check(const Complain& complain) const override;
  void default_output(std::size_t output) override;
  Options output_options(std::size_t output) override;
  SampleType output_type(std::size_t output) const override { return outputs.at(output).type; }
  int output_channels(std::size_t output) const override;
  std::optional<Shape> shape() const override { return vectors.mask.size; }
  int output_depth(std::size_t, const std::vector<Shape>&) const override { return vectors.mask.size.depth; }
  Cost cost(const std::vector<Shape>& input_shapes, const Execution& execution) const override;
  Made make(const std::vector<Input>& inputs, const Execution& execution) const override;
  Metadata metadata(std::size_t output, const std::vector<Input>& inputs,
                    const std::filesystem::path& folder) const override;
  std::vector<std::string> file_kinds() const override { return {"vector-mask"}; }
};

// --- retarget sets -------------------------------------------------------------------------------

/// What a pixel of a retarget tile says: where its seed goes, or where its seed comes from.
enum class MoveForm { scatter, gather };
std::string_view name_of(MoveForm form);
std::string_view name_of(Reach reach);
std::string_view name_of(Metric metric);

/// One file of a retarget set.
struct RetargetOutput {
  enum class Kind {
    tile,   ///< the tile of one motion
    atlas,  ///< all motions, (2 range + 1) tiles a row, tile (m.x + range, m.y + range)
  };
  std::string path;
  Kind kind = Kind::tile;
  MoveForm form = MoveForm::scatter;
  Offset motion = {};  ///< of a tile; (0, 0) is the plain retarget tile
  /// 8bit, half or float; none: float in .exr, else 8bit.
  std::optional<SampleType> type = {};
  int line = 0;
};

/// `method = "anneal"` of a retarget entry: what bn/anneal.h anneals, and with which options.
struct AnnealMethod {
  AnnealOptions options = {};  ///< custom, lower_bound and checkpoint are not used
  /// Channels of the image, whose weighted sum is the energy; empty: the entry's one channel, of weight 1.
  std::vector<int> channels = {};
  std::vector<int> weights = {};   ///< one a channel, 1..1000; empty: 1 each
  double residual_sigma_px = 0.0;  ///< AnnealProblem's
  /// The rest is no part of a recipe, as it changes no byte once the budget is known.
  double seconds = 0.0;  ///< above 0: a budget by the clock in place of options.proposals; make_entry() only
  /// Where a run keeps its checkpoint, and goes on from if it is there; empty: nowhere. A bake sets it
  /// itself, beside the entry's first output.
  std::filesystem::path checkpoint = {};
  AnnealTrace* trace = nullptr;  ///< of one tile
};

/// `[[retarget]]`: the retarget tiles of one source for every motion within a range. A source of several
/// slices has as many tiles for each motion, the slices of its files.
class RetargetEntry : public EntryOf<RetargetEntry, RetargetOutput> {
 public:
  /// The source: the name of a mask of this recipe ...
  std::string mask;
  /// ... or an image file, relative to Recipe::folder, and its channel. One of the two is empty.
  std::string image;
  int channel = 0;
  /// The mask of the next frame, where it is not the source moved by the step: an image file, or the name of
  /// a mask of this recipe. Both empty: a picture moves, and of a stack of slices each is followed by the
  /// next one, the last by the first.
  std::string to, to_mask;
  /// For a mask: the sample type whose levels the tiles are optimised for, which is what the
  /// renderer reads; the mask must have an output of it. An image has its own type.
  SampleType levels = SampleType::u8;
  std::optional<Offset> step = {};  ///< none: auto_step() of the source's size
  RetargetOptions problem = {};     ///< step and motion are ignored
  bool anneals = false;             ///< by `anneal`; else the exact solver, with problem.gap
  AnnealMethod anneal = {};
  bool volume = false;  ///< of a stack, annealed: seeds move between its slices too
  int step_z = 0;       ///< slices that a volume moves from frame to frame
  int motion = 0;       ///< range 0..8: (2 motion + 1)^2 tiles; 4 gives the 81 variants

  const Kind& kind() const override;
  Options options() override;
  void check(const Complain& complain) const override;
  void default_output(std::size_t output) override;
  Options output_options(std::size_t output) override;
  SampleType output_type(std::size_t output) const override;
  int output_channels(std::size_t output) const override;
  std::size_t input_output(const Entry& source) const override;
  void check_inputs(const std::vector<Shape>& shapes, const Complain& complain) const override;
  void check_input_contents(const std::vector<Input>& inputs) const override;
  int output_depth(std::size_t output, const std::vector<Shape>& input_shapes) const override;
  Cost cost(const std::vector<Shape>& input_shapes, const Execution& execution) const override;
  bool settle(const std::vector<Input>& inputs, const Execution& execution) override;
  Made make(const std::vector<Input>& inputs, const Execution& execution) const override;
  /// What make() would give, of a tile that was made before, after checking its permutation and its energies.
  /// Errors: verification_failed.
  Made made_elsewhere(const std::vector<Input>& inputs, const RetargetTile& tile) const;
  void keep_checkpoint_in(const std::filesystem::path& file) override { anneal.checkpoint = file; }
  std::filesystem::path checkpoint() const override {
    return anneals ? anneal.checkpoint : std::filesystem::path();
  }
  Metadata metadata(std::size_t output, const std::vector<Input>& inputs,
                    const std::filesystem::path& folder) const override;
  std::vector<std::string> file_kinds() const override { return {"retarget-tile", "retarget-atlas"}; }
  void verify(const Image& image, const Metadata& metadata, const std::filesystem::path& folder,
              Checks& checks, const Execution& execution) const override;
};

}  // namespace bn
