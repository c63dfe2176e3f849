#include "ui/source.h"

#include <fmt/format.h>

#include "bn/error.h"

namespace bn::ui {

Source load_source(const SourceChoice& choice, const Execution& execution) {
  if (choice.baked) {
    const Image image = encode_mask(void_and_cluster(choice.mask, execution), SampleType::u8);
    const auto [width, height] = choice.mask.size;
    return {.choice = choice,
            .name = fmt::format("mask {} × {}, seed {}", width, height, choice.mask.seed),
            .channels = 1,
            .levels = levels_of_channel(image, 0)};
  }
  if (choice.file.empty()) {
    throw Error({.code = ErrorCode::invalid_input,
                 .what = "no file is chosen",
                 .where = "image",
                 .limit = "",
                 .remedy = "type a path, drop a file onto the window, or bake a mask"});
  }
  const Image image = read_image(choice.file, execution).image;
  try {
    return {.choice = choice,
            .name = image.channels == 1
                        ? choice.file.filename().string()
                        : fmt::format("{}, channel {}", choice.file.filename().string(), choice.channel),
            .channels = image.channels,
            .levels = levels_of_channel(image, choice.channel)};
  } catch (const Error& error) {
    ErrorInfo info = error.info();
    info.where = choice.file.filename().string() + (info.where.empty() ? "" : ": " + info.where);
    throw Error(info);
  }
}

void check_source(const Source& source) {
  if (source.levels.distinct > 1) return;
  throw Error(
      {.code = ErrorCode::invalid_input,
       .what = "the image is constant: every permutation of it has energy 0, so there is nothing to anneal",
       .where = source.name,
       .limit = "two levels or more",
       .remedy = "choose another image or another channel"});
}

}  // namespace bn::ui
