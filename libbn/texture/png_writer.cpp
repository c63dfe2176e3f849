// Writing PNG with libpng. The bytes are those of version 0.1.0, which wrote through OpenImageIO: compression
// level 6, no filters, an offset of 0, the description as plain text before the picture. A test holds them to
// shipped files.
//
// libpng leaves on errors by longjmp(). It does so only inside guarded(), whose bodies own nothing that would
// need a destructor.

#include <fmt/format.h>
#include <png.h>
#include <zlib.h>

#include <csetjmp>
#include <cstring>
#include <new>

#include "texture/codec.h"
#include "texture/error.h"
#include "texture/image.h"

namespace bn::texture {
namespace {

class Writer {
 public:
  Writer() {
    png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
    info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_write_struct(&png_, nullptr);
      throw std::bad_alloc();
    }
    png_set_write_fn(png_, this, on_write, on_flush);
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() { png_destroy_write_struct(&png_, &info_); }

  /// Runs calls of libpng. `body` may have no object with a destructor alive around such a call.
  template <class Body>
  void guarded(Body body) {
    if (setjmp(png_jmpbuf(png_)) != 0) {
      if (no_memory_) throw std::bad_alloc();
      fail_input("image", fmt::format("libpng cannot make a file: {}", message_));
    }
    body(png_, info_);
  }

  Bytes take() { return std::move(bytes_); }

 private:
  static void on_error(png_structp png, png_const_charp message) {
    auto* const self = static_cast<Writer*>(png_get_error_ptr(png));
    std::strncpy(self->message_, message, sizeof self->message_ - 1);
    png_longjmp(png, 1);
  }
  static void on_warning(png_structp, png_const_charp) {}
  static void on_write(png_structp png, png_bytep from, std::size_t count) {
    auto* const self = static_cast<Writer*>(png_get_io_ptr(png));
    // No exception may pass through libpng.
    try {
      self->bytes_.insert(self->bytes_.end(), from, from + count);
    } catch (const std::bad_alloc&) {
      self->no_memory_ = true;
    }
    if (self->no_memory_) png_error(png, "out of memory");
  }
  static void on_flush(png_structp) {}

  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  Bytes bytes_;
  bool no_memory_ = false;
  char message_[128] = {};
};

int colour_type(int channels) {
  constexpr int kTypes[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                            PNG_COLOR_TYPE_RGBA};
  return kTypes[channels - 1];
}

}  // namespace

Bytes encode_png(const Image& image, const std::string& description) {
  Writer writer;
  char key[] = "Description";
  png_text text{};
  text.compression = PNG_TEXT_COMPRESSION_NONE;
  text.key = key;
  text.text = const_cast<char*>(description.c_str());
  text.text_length = description.size();
  writer.guarded([&](png_structp png, png_infop info) {
    png_set_compression_level(png, 6);
    png_set_compression_strategy(png, Z_DEFAULT_STRATEGY);
    png_set_filter(png, 0, PNG_NO_FILTERS);
    png_set_IHDR(png, info, static_cast<png_uint_32>(image.size.width),
                 static_cast<png_uint_32>(image.size.height), image.type == SampleType::u16 ? 16 : 8,
                 colour_type(image.channels), PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_oFFs(png, info, 0, 0, PNG_OFFSET_PIXEL);
    if (!description.empty()) png_set_text(png, info, &text, 1);
    png_write_info(png, info);
    if (image.type == SampleType::u16) png_set_swap(png);  // samples are little-endian here
  });
  const std::uint64_t row_bytes = sample_bytes({image.size.width, 1}, image.channels, image.type);
  for (int y = 0; y < image.size.height; ++y) {
    const auto* const row =
        reinterpret_cast<png_const_bytep>(image.samples.data()) + static_cast<std::uint64_t>(y) * row_bytes;
    writer.guarded([row](png_structp png, png_infop) { png_write_row(png, row); });
  }
  writer.guarded([](png_structp png, png_infop info) { png_write_end(png, info); });
  return writer.take();
}

}  // namespace bn::texture
