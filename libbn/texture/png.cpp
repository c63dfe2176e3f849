// Reading PNG with libpng itself. OpenImageIO lets libpng print to stderr when a file is corrupt, hands out
// half a picture when only the end is missing, and takes 0.2 s to start.
//
// Samples are those stored: no gamma, no multiplication by alpha. Palettes become colours, with alpha where
// they have transparency; 1, 2 and 4 bit grey becomes 8 bit (0..255). A single value of grey or colour that
// is marked as transparent (tRNS) is a mark on samples and none itself, so it adds no channel.
//
// libpng leaves on errors by longjmp(). It does so only inside guarded(), whose bodies own nothing
// that would need a destructor.

#include <fmt/format.h>
#include <png.h>

#include <csetjmp>
#include <cstring>
#include <new>

#include "texture/codec.h"
#include "texture/error.h"
#include "texture/image.h"

namespace bn::texture {
namespace {

class Reader {
 public:
  Reader(ByteView bytes, const std::string& name) : rest_(bytes), name_(name) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
    info_ = png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw std::bad_alloc();
    }
    png_set_read_fn(png_, this, on_read);
    // Our own limits come with better messages.
    png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }

  /// Runs calls of libpng. `body` may have no object with a destructor alive around such a call.
  template <class Body>
  void guarded(Body body) {
    if (setjmp(png_jmpbuf(png_)) != 0) fail_input(name_, fmt::format("not a whole PNG: {}", message_));
    body(png_, info_);
  }

 private:
  static void on_error(png_structp png, png_const_charp message) {
    auto* const self = static_cast<Reader*>(png_get_error_ptr(png));
    std::strncpy(self->message_, message, sizeof self->message_ - 1);
    png_longjmp(png, 1);
  }
  static void on_warning(png_structp, png_const_charp) {}
  static void on_read(png_structp png, png_bytep to, std::size_t count) {
    auto* const self = static_cast<Reader*>(png_get_io_ptr(png));
    if (count > self->rest_.size()) png_error(png, "it ends too early");
    std::memcpy(to, self->rest_.data(), count);
    self->rest_ = self->rest_.subspan(count);
  }

  ByteView rest_;
  const std::string& name_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  char message_[128] = {};
};

/// The text "Description", which may stand before or after the picture.
std::string description_of(png_structp png, png_infop info) {
  png_textp texts = nullptr;
  const int count = png_get_text(png, info, &texts, nullptr);
  for (int i = 0; i < count; ++i) {
    if (std::strcmp(texts[i].key, "Description") != 0) continue;
    return {texts[i].text, std::max(texts[i].text_length, texts[i].itxt_length)};
  }
  return {};
}

}  // namespace

Decoded decode_png(ByteView bytes, const std::string& name, const Execution& execution) {
  Reader reader(bytes, name);
  std::int64_t width = 0, height = 0;
  reader.guarded([&](png_structp png, png_infop info) {
    png_read_info(png, info);
    width = png_get_image_width(png, info);
    height = png_get_image_height(png, info);
  });
  check_shape(width, height, 1, name);

  int passes = 0, channels = 0, depth = 0;
  bool marks_one_colour = false;
  std::size_t row_bytes = 0;
  reader.guarded([&](png_structp png, png_infop info) {
    const bool has_transparency = png_get_valid(png, info, PNG_INFO_tRNS) != 0;
    const bool palette = png_get_color_type(png, info) == PNG_COLOR_TYPE_PALETTE;
    marks_one_colour = has_transparency && !palette;
    if (palette) png_set_palette_to_rgb(png);
    if (palette && has_transparency) png_set_tRNS_to_alpha(png);
    if (png_get_color_type(png, info) == PNG_COLOR_TYPE_GRAY) png_set_expand_gray_1_2_4_to_8(png);
    png_set_swap(png);  // 16 bit samples to little-endian
    passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    channels = png_get_channels(png, info);
    depth = png_get_bit_depth(png, info);
    row_bytes = png_get_rowbytes(png, info);
  });
  Decoded decoded;
  if (marks_one_colour) {
    decoded.notes.emplace_back(
        "it marks one value as transparent (tRNS); the mark is left out, and no alpha is read");
  }
  Image& image = decoded.image;
  image.size = {static_cast<int>(width), static_cast<int>(height)};
  image.channels = channels;
  image.type = depth == 16 ? SampleType::u16 : SampleType::u8;
  const std::uint64_t samples_bytes = sample_bytes(image.size, image.channels, image.type);
  if (samples_bytes != row_bytes * static_cast<std::uint64_t>(height))
    fail_input(name, "PNG of an unknown layout");
  check_decoded_size(samples_bytes, bytes.size(), name);
  check_memory(execution, samples_bytes + bytes.size(), name);
  image.samples.resize(samples_bytes);

  auto* const first_row = reinterpret_cast<png_bytep>(image.samples.data());
  for (int pass = 0; pass < passes; ++pass) {
    for (std::int64_t y = 0; y < height; ++y) {
      throw_if_stopped(execution);
      png_bytep const row = first_row + static_cast<std::size_t>(y) * row_bytes;
      reader.guarded([row](png_structp png, png_infop) { png_read_row(png, row, nullptr); });
    }
  }
  reader.guarded([](png_structp png, png_infop info) { png_read_end(png, info); });
  reader.guarded([&](png_structp png, png_infop info) { decoded.description = description_of(png, info); });
  return decoded;
}

}  // namespace bn::texture
