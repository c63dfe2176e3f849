// Collects everything that is wrong with a text file, so that a user sees it all at once.

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bn/error.h"

namespace bn::document {

/// What is wrong with one file.
class Diagnostics {
 public:
  explicit Diagnostics(std::string file) : file_(std::move(file)) {}
  /// `line` 0: of no particular line.
  void add(int line, std::string what, std::string limit = "", std::string remedy = "");
  /// Throws one Error: the mistake itself, or all of them, one to a line, in the order of the lines.
  void throw_if_any() const;

 private:
  std::string file_;
  std::vector<std::pair<int, ErrorInfo>> found_;
};

}  // namespace bn::document
