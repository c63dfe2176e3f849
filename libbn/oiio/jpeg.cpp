// JPEG, by libjpeg. Grey gives one channel, YCbCr and RGB give three. What libjpeg only warns of, a file that
// is cut short among it, is an error here.
//
// libjpeg leaves on errors by longjmp(). It does so only inside guarded(), whose bodies own nothing that
// would need a destructor.

#include <cstdio>
// jpeglib.h needs FILE and size_t.
#include <fmt/format.h>
#include <jpeglib.h>

#include <csetjmp>
#include <cstring>

#include "oiio/formats.h"
#include "texture/error.h"
#include "texture/image.h"

namespace bn::oiio {
namespace {

using namespace texture;

/// A progressive file may hold any number of scans of a few bytes, each of which is work for all pixels.
constexpr int kMaxScans = 500;

class Reader {
 public:
  Reader(ByteView bytes, const std::string& name, const Execution& execution)
      : name_(name), execution_(execution) {
    jpeg_.err = jpeg_std_error(&errors_);
    jpeg_.client_data = this;
    errors_.error_exit = [](j_common_ptr jpeg) { leave(jpeg); };
    errors_.emit_message = [](j_common_ptr jpeg, int level) {
      if (level < 0) leave(jpeg);
    };
    guarded([&] {
      jpeg_create_decompress(&jpeg_);
      jpeg_mem_src(&jpeg_, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    });
    progress_.progress_monitor = [](j_common_ptr jpeg) {
      auto* const self = static_cast<Reader*>(jpeg->client_data);
      self->stopped_ = self->execution_.stop.stop_requested();
      self->too_many_scans_ = self->jpeg_.input_scan_number > kMaxScans;
      if (self->stopped_ || self->too_many_scans_) std::longjmp(self->on_error_, 1);
    };
    jpeg_.progress = &progress_;
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { jpeg_destroy_decompress(&jpeg_); }

  /// Runs calls of libjpeg. `body` may have no object with a destructor alive around such a call.
  template <class Body>
  void guarded(Body body) {
    if (setjmp(on_error_) != 0) {
      throw_if_stopped(execution_);
      if (too_many_scans_)
        fail_input(name_, fmt::format("more than {} scans", kMaxScans), "a picture for people");
      fail_input(name_, fmt::format("not a whole JPEG: {}", message_));
    }
    body();
  }

  jpeg_decompress_struct& jpeg() { return jpeg_; }

 private:
  [[noreturn]] static void leave(j_common_ptr jpeg) {
    auto* const self = static_cast<Reader*>(jpeg->client_data);
    (*jpeg->err->format_message)(jpeg, self->message_);
    std::longjmp(self->on_error_, 1);
  }

  const std::string& name_;
  const Execution& execution_;
  jpeg_decompress_struct jpeg_ = {};
  jpeg_error_mgr errors_ = {};
  jpeg_progress_mgr progress_ = {};
  std::jmp_buf on_error_ = {};
  bool stopped_ = false, too_many_scans_ = false;
  char message_[JMSG_LENGTH_MAX] = {};
};

}  // namespace

Decoded decode_jpeg(ByteView bytes, const std::string& name, const Execution& execution) {
  Reader reader(bytes, name, execution);
  jpeg_decompress_struct& jpeg = reader.jpeg();
  reader.guarded([&] { jpeg_read_header(&jpeg, TRUE); });
  check_shape(jpeg.image_width, jpeg.image_height, jpeg.num_components, name);
  const bool grey = jpeg.jpeg_color_space == JCS_GRAYSCALE;
  if (!grey && jpeg.jpeg_color_space != JCS_YCbCr && jpeg.jpeg_color_space != JCS_RGB) {
    const bool cmyk = jpeg.jpeg_color_space == JCS_CMYK || jpeg.jpeg_color_space == JCS_YCCK;
    fail_input(name, cmyk ? "colours as CMYK" : "colours of an unknown kind", "grey, RGB",
               "convert it to RGB");
  }
  jpeg.out_color_space = grey ? JCS_GRAYSCALE : JCS_RGB;
  Decoded decoded;
  Image& image = decoded.image;
  image.size = {static_cast<int>(jpeg.image_width), static_cast<int>(jpeg.image_height)};
  image.channels = grey ? 1 : 3;
  const std::uint64_t ours = sample_bytes(image.size, image.channels, SampleType::u8);
  check_decoded_size(ours, bytes.size(), name);
  // A progressive file is kept as coefficients of two bytes until its end.
  check_memory(execution, ours + bytes.size() + (jpeg.progressive_mode != FALSE ? 2 * ours : 0), name);
  image.samples.resize(ours);
  reader.guarded([&] { jpeg_start_decompress(&jpeg); });
  const std::size_t row = ours / jpeg.image_height;
  while (jpeg.output_scanline < jpeg.image_height) {
    throw_if_stopped(execution);
    auto* to = reinterpret_cast<unsigned char*>(image.samples.data()) + jpeg.output_scanline * row;
    reader.guarded([&] { jpeg_read_scanlines(&jpeg, &to, 1); });
  }
  reader.guarded([&] { jpeg_finish_decompress(&jpeg); });
  decoded.notes.emplace_back(kLossyNote);
  return decoded;
}

}  // namespace bn::oiio
