// What holds for every image, whatever file it is in.

#pragma once

#include <string>
#include <string_view>

#include "bn/texture.h"

namespace bn::texture {

inline constexpr std::int64_t kMaxSide = 65536;
inline constexpr std::int64_t kMaxDepth = 65536;
inline constexpr std::int64_t kMaxChannels = 64;

/// Throws invalid_input unless sides and channels are within the limits above.
void check_shape(std::int64_t width, std::int64_t height, std::int64_t channels, std::string_view where);
/// Throws invalid_input unless a volume may have so many slices.
void check_depth(std::int64_t depth, std::string_view where);

/// Bytes of the samples of such an image. The limits keep it at 2^56 or below.
std::uint64_t sample_bytes(Shape shape, int channels, SampleType type);

/// "64x64 pixels, 2 channels, 8bit" and, of a volume, "64x64x16".
std::string describe(const Image& image);
/// Whether two images have the same size, depth, channels and type.
bool same_layout(const Image& a, const Image& b);

/// Throws invalid_input if a file of `file_bytes` claims to hold `decoded_bytes` and cannot.
void check_decoded_size(std::uint64_t decoded_bytes, std::uint64_t file_bytes, std::string_view where);

/// check_shape(), check_depth(), and that there are as many samples as the shape says.
void check_image(const Image& image, std::string_view where);

}  // namespace bn::texture
