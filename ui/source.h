// The image that a run anneals: read from a file, or baked on the spot.

#pragma once

#include <filesystem>
#include <string>

#include "bn/noise.h"
#include "bn/texture.h"

namespace bn::ui {

/// Which image. Equal choices load equal images, as long as the file stays as it is.
struct SourceChoice {
  bool baked = true;
  VoidAndClusterOptions mask = {};  ///< baked: written as 8 bit levels, as most renderers read it
  std::filesystem::path file = {};  ///< else
  int channel = 0;
  friend bool operator==(const SourceChoice& a, const SourceChoice& b) {
    return a.baked == b.baked && a.mask.size == b.mask.size && a.mask.sigma_px == b.mask.sigma_px &&
           a.mask.seed == b.mask.seed && a.file == b.file && a.channel == b.channel;
  }
};

struct Source {
  SourceChoice choice;
  std::string name;  ///< "mask 64 x 64, seed 1" or the file's name and channel
  int channels = 1;
  Levels levels;
};

/// Errors: as read_image(), levels_of_channel() and void_and_cluster(); naming the file.
Source load_source(const SourceChoice& choice, const Execution& execution = {});

/// Throws invalid_input where there is nothing to anneal: a constant image has energy 0 however it is
/// permuted.
void check_source(const Source& source);

}  // namespace bn::ui
