// Reading and writing EXR, TIFF and foreign formats through OpenImageIO, in memory: it never sees a path, so
// it opens no file and leaves none behind. Part of the module bn_oiio, which libbn/texture loads when it
// meets such a file.
//
// What its defaults would do and we do not want: multiply colour by alpha on reading (masks keep
// independent values in the four channels), mark the second or fourth channel as alpha on writing,
// convert colours, write the time into the file, scale integers that become floats, take all threads.

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <mutex>

#include "bn/version.h"
#include "texture/error.h"
#include "texture/image.h"
#include "texture/oiio_module.h"

namespace bn::oiio {

using namespace texture;

namespace {

using OIIO::TypeDesc;

/// Attributes of the whole process: one thread, so nothing can depend on their number.
void configure() {
  static std::once_flag once;
  std::call_once(once, [] {
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
  });
}

/// The bytes of a file as OpenImageIO reads them. Its own memory reader trusts offsets, and those
/// come from the file.
class MemoryReader : public OIIO::Filesystem::IOProxy {
 public:
  explicit MemoryReader(ByteView bytes) : IOProxy("", Read), bytes_(bytes) {}
  const char* proxytype() const override { return "memory"; }
  std::size_t size() const override { return bytes_.size(); }
  bool seek(std::int64_t offset) override {
    if (offset < 0) return false;
    m_pos = offset;
    return true;
  }
  std::size_t read(void* buffer, std::size_t count) override {
    const std::size_t done = pread(buffer, count, m_pos);
    m_pos += static_cast<std::int64_t>(done);
    return done;
  }
  std::size_t pread(void* buffer, std::size_t count, std::int64_t offset) override {
    if (offset < 0 || static_cast<std::uint64_t>(offset) >= bytes_.size()) return 0;
    const ByteView rest = bytes_.subspan(static_cast<std::size_t>(offset));
    count = std::min(count, rest.size());
    std::memcpy(buffer, rest.data(), count);
    return count;
  }

 private:
  ByteView bytes_;
};

/// As what the samples are read, and our type that holds them.
struct StoredType {
  TypeDesc read;
  SampleType ours;
  bool widened() const { return ours == SampleType::f32 && read != TypeDesc::FLOAT; }
};

StoredType stored_type(const OIIO::ImageSpec& spec, const std::string& name) {
  if (!spec.channelformats.empty()) return {TypeDesc::FLOAT, SampleType::f32};
  switch (spec.format.basetype) {
    case TypeDesc::UINT8:
      return {TypeDesc::UINT8, SampleType::u8};
    case TypeDesc::UINT16:
      return {TypeDesc::UINT16, SampleType::u16};
    case TypeDesc::HALF:
    case TypeDesc::FLOAT:
      return {TypeDesc::FLOAT, SampleType::f32};
    case TypeDesc::INT8:
    case TypeDesc::INT16:
    case TypeDesc::INT32:
    case TypeDesc::UINT32:
      return {spec.format, SampleType::f32};
    default:  // double among them: OpenImageIO 2.4 reads it from TIFF as zeros
      fail_input(name, fmt::format("samples of type '{}'", spec.format.c_str()),
                 "integers of at most 32 bits, half, float", "convert them to float");
  }
}

/// Refuses what is not read, and checks the limits, before memory is taken for the samples.
void check_spec(const OIIO::ImageSpec& spec, std::size_t file_bytes, const std::string& name,
                const Execution& execution) {
  if (spec.deep) fail_input(name, "a deep image", "flat images");
  if (spec.depth > 1) fail_input(name, "a volume", "flat images");
  check_shape(spec.width, spec.height, spec.nchannels, name);
  // OpenImageIO 2.4 adds this to a row number in 32 bits, and would go round for ever.
  const int strip = spec.get_int_attribute("tiff:RowsPerStrip");
  if (strip > std::numeric_limits<int>::max() - kMaxSide)
    fail_input(name, fmt::format("strips of {} rows", strip));

  const StoredType type = stored_type(spec, name);
  const std::uint64_t ours = sample_bytes({spec.width, spec.height}, spec.nchannels, type.ours);
  check_decoded_size(ours, file_bytes, name);
  const std::uint64_t native = type.widened() ? ours / 4 * type.read.size() : 0;
  std::uint64_t tiles = 0;  // a row of them
  if (spec.tile_width > 0) {
    check_shape(spec.tile_width, spec.tile_height, 1, name + ", tiles");
    const int across = (spec.width + spec.tile_width - 1) / spec.tile_width * spec.tile_width;
    tiles = sample_bytes({across, spec.tile_height}, spec.nchannels, SampleType::u8) * type.read.size();
  }
  check_memory(execution, ours + native + tiles + file_bytes, name);
}

template <class Sample>
void to_float(const std::vector<std::byte>& native, std::vector<std::byte>& samples) {
  for (std::size_t i = 0; i < samples.size() / sizeof(float); ++i) {
    Sample value;
    std::memcpy(&value, native.data() + i * sizeof value, sizeof value);
    const auto wide = static_cast<float>(value);
    std::memcpy(samples.data() + i * sizeof wide, &wide, sizeof wide);
  }
}

void to_float(TypeDesc type, const std::vector<std::byte>& native, std::vector<std::byte>& samples) {
  switch (type.basetype) {
    case TypeDesc::INT8:
      return to_float<std::int8_t>(native, samples);
    case TypeDesc::INT16:
      return to_float<std::int16_t>(native, samples);
    case TypeDesc::INT32:
      return to_float<std::int32_t>(native, samples);
    default:
      return to_float<std::uint32_t>(native, samples);
  }
}

/// Channel names decide what is alpha in EXR and TIFF: two channels are R and G, so none is, and more
/// than four are numbered so that their alphabetical order, in which EXR keeps them, is ours.
std::vector<std::string> channel_names(int channels) {
  if (channels == 1) return {"Y"};
  std::vector<std::string> names;
  for (int c = 0; c < channels; ++c) {
    names.push_back(channels <= 4 ? std::string(1, "RGBA"[c]) : fmt::format("channel{:02}", c));
  }
  return names;
}

TypeDesc type_desc(SampleType type) {
  return type == SampleType::u8    ? TypeDesc::UINT8
         : type == SampleType::u16 ? TypeDesc::UINT16
                                   : TypeDesc::FLOAT;
}

}  // namespace

Decoded decode(ByteView bytes, const std::string& format, const std::string& name,
               const Execution& execution) {
  configure();
  if (format == "openexr") check_exr_header(bytes, name);
  MemoryReader reader(bytes);
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format);
  if (!input || !input->set_ioproxy(&reader)) {
    fail_input(name, fmt::format("OpenImageIO cannot read '{}' here: {}", format, OIIO::geterror()));
  }
  const auto fail = [&] {
    const std::string message = input->geterror();  // one line a failed strip
    fail_input(name, fmt::format("cannot be decoded: {}", message.substr(0, message.find('\n'))));
  };

  OIIO::ImageSpec spec, wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1);
  if (!input->open("image." + format, spec, wishes)) fail();
  check_spec(spec, bytes.size(), name, execution);
  const StoredType type = stored_type(spec, name);

  Decoded decoded;
  Image& image = decoded.image;
  image = {.size = {spec.width, spec.height}, .channels = spec.nchannels, .type = type.ours, .samples = {}};
  image.samples.resize(sample_bytes(image.size, image.channels, image.type));
  std::vector<std::byte> native(type.widened() ? image.samples.size() / 4 * type.read.size() : 0);

  const OIIO::ProgressCallback stop_requested = [](void* data, float) {
    return static_cast<const Execution*>(data)->stop.stop_requested();
  };
  const bool complete = input->read_image(0, 0, 0, spec.nchannels, type.read,
                                          type.widened() ? native.data() : image.samples.data(),
                                          OIIO::AutoStride, OIIO::AutoStride, OIIO::AutoStride,
                                          stop_requested, const_cast<Execution*>(&execution));
  throw_if_stopped(execution);
  if (!complete || input->has_error()) fail();
  if (type.widened()) to_float(type.read, native, image.samples);
  decoded.description = spec.get_string_attribute("ImageDescription");
  return decoded;
}

Bytes encode(const std::string& format, const Image& image, const std::string& description) {
  configure();
  Bytes bytes;
  OIIO::Filesystem::IOVecOutput writer(bytes);
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
  const auto fail = [&] {
    const std::string reason = output ? output->geterror() : OIIO::geterror();
    fail_input("image", fmt::format("OpenImageIO cannot make a file of format '{}': {}", format, reason));
  };
  if (!output || !output->set_ioproxy(&writer)) fail();

  const TypeDesc type = type_desc(image.type);
  OIIO::ImageSpec spec(image.size.width, image.size.height, image.channels, type);
  spec.channelnames = channel_names(image.channels);
  spec.alpha_channel = -1;
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("compression", "zip");
  spec.attribute("ImageDescription", description);
  spec.attribute("DateTime", "");  // left out, EXR would get the time of writing

  if (!output->open("image." + format, spec)) fail();
  if (!output->write_image(type, image.samples.data())) fail();
  if (!output->close()) fail();
  return bytes;
}

}  // namespace bn::oiio

extern "C" const bn::texture::OiioCodec* bn_oiio_codec() {
  static const bn::texture::OiioCodec codec{
      .version = bn::kVersion, .decode = bn::oiio::decode, .encode = bn::oiio::encode};
  return &codec;
}
