// The Bake view: a recipe, its plan, its jobs, its results.

#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "bn/bake.h"
#include "ui/image_view.h"
#include "ui/task.h"

namespace bn::ui {

class App;
class Parameters;

class BakeView {
 public:
  /// Reads and plans it in the background.
  void open(const std::filesystem::path& recipe);
  void draw(App& app);
  void parameters(Parameters& p);
  bool busy() const {
    return planning_.running() || baking_.running() || reading_.running() || sheet_.busy();
  }

 private:
  struct Planned {
    Recipe recipe;
    BakePlan plan;
  };
  struct Watch;  ///< what the bake's events say, for both threads

  void update(App& app);
  void plan();
  void bake();
  BakeOptions options() const;
  void draw_controls(App& app);
  void draw_jobs(App& app);
  /// `narrow`: in three columns, else in five.
  void draw_job(App& app, int index, bool narrow);
  void draw_recipe();
  void read_sheet();
  void draw_sheet(float height);

  // What the user has set.
  std::filesystem::path recipe_path_;
  std::string out_dir_ = "out";
  bool force_ = false;
  int threads_ = 0;

  std::filesystem::path planned_path_;  ///< the recipe that was last tried ...
  std::string planned_out_;             ///< ... for this folder
  bool fresh_ = false;                  ///< opened, and not yet said so
  std::optional<Planned> planned_;
  std::shared_ptr<Watch> watch_;
  Task<Planned> planning_;
  Task<BakeResult> baking_;
  ImageView sheet_;
  ViewLink sheet_link_ = {.nearest = false};
  Task<std::shared_ptr<const Picture>> reading_;
};

}  // namespace bn::ui
