// Runs the real bn-inspector without a display, as docs/inspector.md says, and looks at its pictures.

#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "bn/texture.h"

namespace bn::ui {

struct Outcome {
  int exit_code = -1;
  std::string output;  ///< stdout and stderr
};

/// 0 is success; anything else shows what the program said.
inline void expect_success(const Outcome& outcome) { EXPECT_EQ(outcome.exit_code, 0) << outcome.output; }

/// An empty folder, the current one of what runs in it; removed at the end.
class Workplace {
 public:
  Workplace();
  ~Workplace();
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// A shell command, here.
  Outcome shell(const std::string& command) const;
  /// bn-inspector with this script. `arguments` come before, `environment` before the program.
  Outcome script(const std::string& text, const std::string& arguments = "",
                 const std::string& environment = "") const;
  /// For script(): a user who may not write into folders of ours, whoever runs the test. Lets them read here.
  std::string as_stranger() const;
  /// A void-and-cluster mask with its metadata.
  void write_mask(const std::string& name, int side, std::uint64_t seed = 1) const;

 private:
  std::filesystem::path folder_;
};

/// A part of a picture, as shares of its sides.
struct Part {
  double x0, y0, x1, y1;
};

/// Standard deviation of the grey levels: 0 where nothing is drawn.
double contrast(const Image& image, Part part);

}  // namespace bn::ui
