// What a validation study left in its folder, read back for its page. So a study made elsewhere can be shown
// here, and the page can hold nothing that no file says.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace bn::report {

/// A CSV file without quotes, as the study writes them: rows by column name. Errors name the file.
class Csv {
 public:
  Csv(const std::filesystem::path& path, const std::vector<std::string>& needed);

  std::size_t rows() const { return rows_.size(); }
  const std::string& text(std::size_t row, const std::string& name) const { return rows_[row][column(name)]; }
  /// NaN for an empty cell.
  double number(std::size_t row, const std::string& name) const;

 private:
  std::size_t column(const std::string& name) const;

  std::filesystem::path path_;
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> rows_;
};

/// The values of a column in the order they first appear; of one scene, or of all where `scene` is empty.
std::vector<std::string> distinct(const Csv& csv, const std::string& column, const std::string& scene);

struct StudyScene {
  std::string name;
  std::string about;
  bool moves = false;  ///< the camera, within the frames
  double reference_rmse = 0.0;
};

struct Study {
  explicit Study(const std::filesystem::path& folder);

  Csv summary, errors, radial, passes;
  // study.json
  int width = 0, height = 0, bounces = 0, first_counted = 0, frames = 0, block = 0, reference_paths = 0;
  std::string device;
  std::vector<StudyScene> scenes;
};

/// The figures of one method in one scene.
struct MethodRow {
  std::string name;
  std::vector<double> db;  ///< by region: low-frequency error against white noise; NaN where there is none
  double rmse = 0.0, blurred = 0.0, flicker = 0.0;  ///< whole picture, last frame; NaN: none
  double averaged = 0.0, averaged_blurred = 0.0;
};
std::vector<MethodRow> rows_of(const Study& study, const std::string& scene);

/// What a method does, in words, by its name in the study: "reproject-by-light".
std::string words_for(const std::string& method);

/// The row with the least error in the region that is looked at, white noise apart; null where none gains
/// more than the scatter of about 1 dB.
inline constexpr double kScatter_db = 1.0;
const MethodRow* best_of(const std::vector<MethodRow>& rows, std::size_t region);

}  // namespace bn::report
