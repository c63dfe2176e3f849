// The work of bn spectrum: reads textures one by one, judges their channels, compares them, averages.

#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "bn/volume.h"
#include "tools/session.h"
#include "tools/spectrum_result.h"

namespace bn::tools {

struct SpectrumSettings {
  std::string channel = "all";  ///< or a number, or a name
  std::optional<Check> check = {};
  Distribution distribution = Distribution::uniform;
};

/// One texture still to be read.
struct SpectrumInput {
  std::vector<std::filesystem::path> paths;  ///< as read_volume() takes them
  bool found = false;                        ///< in a folder: what is no mask is passed over
};

/// The channels of one picture, or of a stack of pictures.
struct StackedTexture;

/// One texture is in memory at a time. A file that cannot be read or analysed becomes a fault of the result.
class SpectrumAnalyst {
 public:
  SpectrumAnalyst(const SpectrumSettings& settings, Session& session, SpectrumResult& result)
      : settings_(settings), session_(session), result_(result) {}

  /// Errors: cancelled.
  void look_at(const SpectrumInput& input);
  /// Adds the average of what is independent.
  void finish();

  bool one_size() const { return one_size_; }
  const std::optional<PowerSpectrum>& average() const { return average_; }

 private:
  /// Ranks at some places: enough to know a texture again in another encoding.
  struct Print {
    std::string name;
    Shape shape;
    std::vector<double> rank;
  };

  void look_at(const StackedTexture& texture);
  std::optional<StackedTexture> read_texture(const SpectrumInput& input);
  void judge(SpectrumRow& row, const Samples& samples, const Analysis& analysis);
  std::vector<int> channels_to_judge(const StackedTexture& texture);
  std::string aside_of(const StackedTexture& texture, int channel) const;
  bool is_again(const StackedTexture& texture, const std::vector<Samples>& samples, int a, int b);
  void take_into_average(const std::string& name, const Samples& samples, const Analysis& analysis);
  std::string known_as(const std::string& name, const Samples& samples);

  const SpectrumSettings& settings_;
  Session& session_;
  SpectrumResult& result_;
  std::vector<Print> prints_;
  Check natural_check_ = Check::blue;  // of the texture looked at last
  std::optional<PowerSpectrum> average_;
  bool one_size_ = true;
  double worst_deviation_ = 0.0, worst_distance_ = std::numeric_limits<double>::quiet_NaN();
  int passed_over_ = 0, failed_ = 0, single_slices_ = 0;
};

}  // namespace bn::tools
