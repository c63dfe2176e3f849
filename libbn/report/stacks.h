// Stacks that were written a file a slice, put together again. Each slice says of itself, beside its own
// pixel hash, the same as its sisters, and how many they are.

#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bn/texture.h"
#include "report/candidates.h"

namespace bn::report {

/// Slices of the file's stack by its metadata, or 1: of tiles that only tell how many they are, so many.
int slices_of(const FileContent& content);

class Stacks {
 public:
  struct Stack {
    Candidate first;
    FileContent content;  ///< the volume, with the first slice's metadata
    std::vector<std::string> names;
  };

  /// Keeps a slice of a stack. Returns the stack with its last slice; nothing before. Slices come in their
  /// order.
  std::optional<Stack> add(const Candidate& candidate, FileContent content);

  /// Those of which slices are missing.
  struct Part {
    std::vector<std::pair<Candidate, FileContent>> slices;
    int wanted = 0;
  };
  std::vector<Part> incomplete();

 private:
  std::map<std::string, Part> parts_;
};

}  // namespace bn::report
