// GIF, by giflib: the first picture, as its palette says. Grey palettes give one channel, other ones three; a
// transparent colour, where it occurs, one more.

#include <fmt/format.h>
#include <gif_lib.h>

#include <array>
#include <cstring>
#include <memory>

#include "oiio/formats.h"
#include "texture/error.h"
#include "texture/image.h"
#include "texture/palette_image.h"

namespace bn::oiio {
namespace {

using namespace texture;

int read_bytes(GifFileType* gif, GifByteType* to, int count) {
  auto& rest = *static_cast<ByteView*>(gif->UserData);
  const std::size_t taken = std::min(rest.size(), static_cast<std::size_t>(std::max(count, 0)));
  std::memcpy(to, rest.data(), taken);
  rest = rest.subspan(taken);
  return static_cast<int>(taken);
}

struct Closer {
  void operator()(GifFileType* gif) const { DGifCloseFile(gif, nullptr); }
};

class Reader {
 public:
  Reader(ByteView bytes, const std::string& name, const Execution& execution)
      : bytes_(bytes), rest_(bytes), name_(name), execution_(execution) {
    int error = 0;
    gif_.reset(DGifOpen(&rest_, read_bytes, &error));
    if (!gif_) fail(error);
  }

  Decoded decode() {
    int pictures = 0;
    for (;;) {
      throw_if_stopped(execution_);
      GifRecordType record = UNDEFINED_RECORD_TYPE;
      check(DGifGetRecordType(gif_.get(), &record));
      if (record == TERMINATE_RECORD_TYPE) break;
      if (record == EXTENSION_RECORD_TYPE) read_extension();
      if (record != IMAGE_DESC_RECORD_TYPE) continue;
      if (pictures++ == 0) {
        read_picture();
      } else {
        pass_over_picture();
      }
    }
    if (pictures == 0) fail_input(name_, "a GIF without a picture");
    if (pictures > 1)
      decoded_.notes.push_back(fmt::format("an animation of {} pictures; the first is read", pictures));
    return std::move(decoded_);
  }

 private:
  [[noreturn]] void fail(int error) const {
    const char* const text = GifErrorString(error);
    fail_input(name_, fmt::format("not a whole GIF: {}", text != nullptr ? text : "it ends too early"));
  }
  void check(int result) const {
    if (result != GIF_OK) fail(gif_->Error);
  }

  /// Keeps the number of the colour that is transparent in the next picture.
  void read_extension() {
    int code = 0;
    GifByteType* block = nullptr;
    check(DGifGetExtension(gif_.get(), &code, &block));
    while (block != nullptr) {
      GraphicsControlBlock control = {};
      if (code == GRAPHICS_EXT_FUNC_CODE && DGifExtensionToGCB(block[0], block + 1, &control) == GIF_OK)
        transparent_ = control.TransparentColor;
      check(DGifGetExtensionNext(gif_.get(), &block));
    }
  }

  void read_picture() {
    check(DGifGetImageDesc(gif_.get()));
    const GifImageDesc& frame = gif_->Image;
    check_shape(frame.Width, frame.Height, 1, name_);
    PaletteImage picture{.size = {frame.Width, frame.Height}};
    // LZW packs at most 4096 pixels into nine bits and more.
    check_decoded_size(4 * static_cast<std::uint64_t>(picture.size.area()), bytes_.size(), name_);
    check_memory(execution_, 5 * static_cast<std::uint64_t>(picture.size.area()) + bytes_.size(), name_);
    take_palette(frame.ColorMap != nullptr ? frame.ColorMap : gif_->SColorMap, picture);
    picture.indices.resize(static_cast<std::size_t>(picture.size.area()));
    const auto read_row = [&](int y) {
      throw_if_stopped(execution_);
      check(DGifGetLine(gif_.get(), picture.indices.data() + std::ptrdiff_t{y} * frame.Width, frame.Width));
    };
    if (frame.Interlace) {
      constexpr std::array<std::array<int, 2>, 4> kPasses = {{{0, 8}, {4, 8}, {2, 4}, {1, 2}}};
      for (const auto& [first, step] : kPasses) {
        for (int y = first; y < frame.Height; y += step) read_row(y);
      }
    } else {
      for (int y = 0; y < frame.Height; ++y) read_row(y);
    }
    decoded_.image = expand_palette(picture, name_);
    if (frame.Left != 0 || frame.Top != 0 || frame.Width != gif_->SWidth || frame.Height != gif_->SHeight) {
      decoded_.notes.push_back(
          fmt::format("its first picture covers a part of the {}x{} pixels of its screen; that part is read",
                      gif_->SWidth, gif_->SHeight));
    }
  }

  void take_palette(const ColorMapObject* map, PaletteImage& picture) const {
    if (map == nullptr) fail_input(name_, "a GIF without a palette");
    picture.colours = static_cast<std::size_t>(std::clamp(map->ColorCount, 0, 256));
    for (std::size_t i = 0; i < picture.colours; ++i) {
      const GifColorType& colour = map->Colors[i];
      const bool opaque = static_cast<int>(i) != transparent_;
      picture.palette[i] = {std::byte{colour.Red}, std::byte{colour.Green}, std::byte{colour.Blue},
                            std::byte{opaque ? GifByteType{255} : GifByteType{0}}};
    }
  }

  void pass_over_picture() {
    check(DGifGetImageDesc(gif_.get()));
    int size = 0;
    GifByteType* block = nullptr;
    check(DGifGetCode(gif_.get(), &size, &block));
    while (block != nullptr) check(DGifGetCodeNext(gif_.get(), &block));
  }

  ByteView bytes_, rest_;
  const std::string& name_;
  const Execution& execution_;
  std::unique_ptr<GifFileType, Closer> gif_;
  int transparent_ = NO_TRANSPARENT_COLOR;
  Decoded decoded_;
};

}  // namespace

Decoded decode_gif(ByteView bytes, const std::string& name, const Execution& execution) {
  return Reader(bytes, name, execution).decode();
}

}  // namespace bn::oiio
