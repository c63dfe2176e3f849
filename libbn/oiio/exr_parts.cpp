// Volumes as EXR: a part a slice, by OpenEXR. OpenImageIO 2.4 writes several parts only by path, so not
// crash-safely. The metadata stand in the first part.

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <fmt/format.h>

#include <cstring>
#include <vector>

#include "oiio/formats.h"
#include "texture/error.h"

namespace bn::oiio {
namespace {

class MemoryWriter : public Imf::OStream {
 public:
  explicit MemoryWriter(texture::Bytes& bytes) : OStream("memory"), bytes_(bytes) {}
  void write(const char* data, int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (bytes_.size() < at_ + size) bytes_.resize(at_ + size);
    std::memcpy(bytes_.data() + at_, data, size);
    at_ += size;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = position; }

 private:
  texture::Bytes& bytes_;
  std::size_t at_ = 0;
};

}  // namespace

texture::Bytes encode_exr_parts(const Image& image, const std::vector<std::string>& channel_names,
                                const std::string& description) {
  const Imf::PixelType type = image.type == SampleType::f16 ? Imf::HALF : Imf::FLOAT;
  const std::size_t sample = bytes_per_sample(image.type);
  std::vector<Imf::Header> headers;
  for (int z = 0; z < image.depth; ++z) {
    Imf::Header header(image.size.width, image.size.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    header.setName(fmt::format("slice_{:05}", z));
    header.setType(Imf::SCANLINEIMAGE);
    for (const std::string& name : channel_names) header.channels().insert(name, Imf::Channel(type));
    if (z == 0 && !description.empty()) Imf::addComments(header, description);
    headers.push_back(header);
  }
  texture::Bytes bytes;
  const std::size_t pixel = channel_names.size() * sample;
  const std::size_t row = pixel * static_cast<std::size_t>(image.size.width);
  const std::size_t slice = row * static_cast<std::size_t>(image.size.height);
  try {
    MemoryWriter writer(bytes);
    Imf::MultiPartOutputFile file(writer, headers.data(), image.depth, false, 0);
    for (int z = 0; z < image.depth; ++z) {
      // Imf::Slice takes memory that it may change, whether it reads or writes.
      auto* const samples = reinterpret_cast<char*>(
          const_cast<std::byte*>(image.samples.data() + static_cast<std::size_t>(z) * slice));
      Imf::FrameBuffer buffer;
      for (std::size_t c = 0; c < channel_names.size(); ++c)
        buffer.insert(channel_names[c], Imf::Slice(type, samples + c * sample, pixel, row));
      Imf::OutputPart part(file, z);
      part.setFrameBuffer(buffer);
      part.writePixels(image.size.height);
    }
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    texture::fail_input("image",
                        fmt::format("OpenEXR cannot make a file of several parts: {}", error.what()));
  }
  return bytes;
}

}  // namespace bn::oiio
