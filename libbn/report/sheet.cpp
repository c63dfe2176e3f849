#include "report/sheet.h"

#include <cstring>

namespace bn::report {

std::optional<Image> sheet_picture(const Image& sheet, Extent columns_and_rows, Offset at) {
  const auto side_of = [](int whole, int count) {
    const int pitch = count < 1 ? 0 : (whole - kSheetGap) / count;
    return count * pitch + kSheetGap == whole ? (pitch - kSheetGap) / kSheetScale : 0;
  };
  const int side = side_of(sheet.size.width, columns_and_rows.width);
  if (side < 1 || side != side_of(sheet.size.height, columns_and_rows.height)) return {};
  const int pitch = side * kSheetScale + kSheetGap;
  Image picture{.size = {side, side}, .channels = sheet.channels, .type = sheet.type, .samples = {}};
  const std::size_t bytes = static_cast<std::size_t>(sheet.channels) * bytes_per_sample(sheet.type);
  picture.samples.resize(picture.size.area() * bytes);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const std::int64_t from_x = at.x * pitch + kSheetGap + x * kSheetScale;
      const std::int64_t from_y = at.y * pitch + kSheetGap + y * kSheetScale;
      std::memcpy(&picture.samples[static_cast<std::size_t>(y * side + x) * bytes],
                  &sheet.samples[static_cast<std::size_t>(from_y * sheet.size.width + from_x) * bytes],
                  bytes);
    }
  }
  return picture;
}

}  // namespace bn::report
