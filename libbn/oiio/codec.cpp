// Reading and writing EXR, TIFF and foreign formats through OpenImageIO, in memory: it never sees a path, so
// it opens no file and leaves none behind. Part of the module bn_oiio, which libbn/texture loads when it
// meets such a file.
//
// What its defaults would do and we do not want: multiply colour by alpha on reading (masks keep
// independent values in the four channels), mark the second or fourth channel as alpha on writing,
// convert colours, write the time into the file, scale integers that become floats, take all threads.
//
// Parts of an EXR and pages of a TIFF that are alike in size, channels and type are the slices of a volume.
// Where they are not, the first is the picture, and a note says how many there are.

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <mutex>

#include "bn/version.h"
#include "oiio/formats.h"
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
      return {TypeDesc::HALF, SampleType::f16};
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

/// Refuses the TIFFs whose samples OpenImageIO would convert, or that mean something else than they say.
void check_tiff_colours(const OIIO::ImageSpec& spec, const std::string& name) {
  enum Photometric { kWhiteIsZero, kBlackIsZero, kRgb, kPalette, kMask, kInks, kYcbcr, kLab = 8 };
  const int photometric = spec.get_int_attribute("tiff:PhotometricInterpretation", kBlackIsZero);
  const auto refuse = [&](std::string_view what, const char* remedy) {
    fail_input(name, fmt::format("a TIFF of {}", what),
               "grey from black to white, RGB, palettes, inks (CMYK)", remedy);
  };
  switch (photometric) {
    case kBlackIsZero:
    case kRgb:
    case kPalette:
    case kInks:  // as stored, by the wish for raw colour
      break;
    case kWhiteIsZero:
      return refuse("grey from white to black", "convert it to grey from black to white");
    case kYcbcr:
      return refuse("colours as YCbCr", "convert it to RGB");
    case kLab:
      return refuse("colours as Lab", "convert it to RGB");
    default:
      return refuse(fmt::format("photometric interpretation {}", photometric), "convert it to grey or RGB");
  }
  const int bits = spec.get_int_attribute("oiio:BitsPerSample", 8);  // 64: stored_type() refuses it
  if (bits != 24 && (bits % 8 == 0 || bits == 1 || bits == 2 || bits == 4)) return;
  // OpenImageIO would stretch them to 8, 16 or 32.
  fail_input(name, fmt::format("samples of {} bits", bits), "1, 2, 4, 8, 16, 32 bits",
             "convert it to 16 bit");
}

/// Refuses what is not read, before memory is taken for the samples.
void check_spec(const OIIO::ImageSpec& spec, const std::string& format, const std::string& name) {
  if (spec.deep) fail_input(name, "a deep image", "flat images");
  if (spec.depth > 1) fail_input(name, "a volume", "flat images");
  check_shape(spec.width, spec.height, spec.nchannels, name);
  // OpenImageIO 2.4 adds this to a row number in 32 bits, and would go round for ever.
  const int strip = spec.get_int_attribute("tiff:RowsPerStrip");
  if (strip > std::numeric_limits<int>::max() - kMaxSide)
    fail_input(name, fmt::format("strips of {} rows", strip));
  if (format == "tiff") check_tiff_colours(spec, name);
}

/// The limits, of that many parts.
void check_size(const OIIO::ImageSpec& spec, int parts, std::size_t file_bytes, const std::string& name,
                const Execution& execution) {
  const StoredType type = stored_type(spec, name);
  const std::uint64_t ours = sample_bytes({spec.width, spec.height, parts}, spec.nchannels, type.ours);
  check_decoded_size(ours, file_bytes, name);
  const std::uint64_t native =
      type.widened() ? ours / static_cast<std::uint64_t>(parts) / 4 * type.read.size() : 0;
  std::uint64_t tiles = 0;  // a row of them
  if (spec.tile_width > 0) {
    check_shape(spec.tile_width, spec.tile_height, 1, name + ", tiles");
    const int across = (spec.width + spec.tile_width - 1) / spec.tile_width * spec.tile_width;
    tiles = sample_bytes({across, spec.tile_height}, spec.nchannels, SampleType::u8) * type.read.size();
  }
  check_memory(execution, ours + native + tiles + file_bytes, name);
}

template <class Sample>
void to_float(const std::vector<std::byte>& native, std::span<std::byte> samples) {
  for (std::size_t i = 0; i < samples.size() / sizeof(float); ++i) {
    Sample value;
    std::memcpy(&value, native.data() + i * sizeof value, sizeof value);
    const auto wide = static_cast<float>(value);
    std::memcpy(samples.data() + i * sizeof wide, &wide, sizeof wide);
  }
}

void to_float(TypeDesc type, const std::vector<std::byte>& native, std::span<std::byte> samples) {
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
         : type == SampleType::f16 ? TypeDesc::HALF
                                   : TypeDesc::FLOAT;
}

/// One file, open.
class File {
 public:
  File(ByteView bytes, const std::string& format, const std::string& name, const Execution& execution)
      : reader_(bytes), format_(format), name_(name), execution_(execution), file_bytes_(bytes.size()) {
    input_ = OIIO::ImageInput::create(format);
    if (!input_ || !input_->set_ioproxy(&reader_))
      fail_input(name, fmt::format("OpenImageIO cannot read '{}' here: {}", format, OIIO::geterror()));
    OIIO::ImageSpec wishes;
    wishes.attribute("oiio:UnassociatedAlpha", 1);
    wishes.attribute("oiio:RawColor", 1);
    if (!input_->open("image." + format, first_, wishes)) fail();
  }

  /// `parts`: how many there are.
  Decoded decode(int parts) {
    check_spec(first_, format_, name_);
    Decoded decoded;
    decoded.description = first_.get_string_attribute("ImageDescription");
    if (format_ == "openexr") decoded.channel_names = first_.channelnames;
    const bool alike = parts > 1 && parts_are_alike(parts);
    const int slices = alike ? parts : 1;
    check_size(first_, slices, file_bytes_, name_, execution_);
    note_parts(parts, alike, decoded);
    Image& image = decoded.image;
    image = {.size = {first_.width, first_.height},
             .depth = slices,
             .channels = first_.nchannels,
             .type = stored_type(first_, name_).ours,
             .samples = {}};
    image.samples.resize(sample_bytes(image.shape(), image.channels, image.type));
    const std::size_t slice = image.samples.size() / static_cast<std::size_t>(slices);
    for (int part = 0; part < slices; ++part)
      read_part(part, std::span(image.samples).subspan(static_cast<std::size_t>(part) * slice, slice));
    return decoded;
  }

 private:
  [[noreturn]] void fail() const {
    const std::string message = input_->geterror();  // one line a failed strip
    fail_input(name_, fmt::format("cannot be decoded: {}", message.substr(0, message.find('\n'))));
  }

  bool parts_are_alike(int parts) {
    const StoredType type = stored_type(first_, name_);
    for (int part = 1; part < parts; ++part) {
      throw_if_stopped(execution_);
      if (!input_->seek_subimage(part, 0)) fail();
      const OIIO::ImageSpec& spec = input_->spec();
      if (spec.width != first_.width || spec.height != first_.height || spec.nchannels != first_.nchannels ||
          spec.deep || spec.depth > 1) {
        return false;
      }
      check_spec(spec, format_, name_);
      const StoredType other = stored_type(spec, name_);
      if (other.read != type.read || other.ours != type.ours) return false;
    }
    return true;
  }

  void note_parts(int parts, bool alike, Decoded& decoded) {
    const char* const word = format_ == "tiff" ? "pages" : "parts";
    if (alike) decoded.notes.push_back(fmt::format("it has {} {}, which are read as slices", parts, word));
    if (parts > 1 && !alike) {
      decoded.notes.push_back(
          fmt::format("it has {} {} that differ in size, channels or type; the first is read", parts, word));
    }
    // First back to the first: after a search in vain OpenImageIO 2.4 would keep what the last part says of
    // itself.
    if (!input_->seek_subimage(0, 0)) fail();
    if (input_->seek_subimage(0, 1)) decoded.notes.emplace_back("it has mip levels; the largest is read");
    input_->geterror();  // that there are none
  }

  void read_part(int part, std::span<std::byte> samples) {
    if (!input_->seek_subimage(part, 0)) fail();
    const OIIO::ImageSpec& spec = input_->spec();
    const StoredType type = stored_type(spec, name_);
    std::vector<std::byte> native(type.widened() ? samples.size() / 4 * type.read.size() : 0);
    const OIIO::ProgressCallback stop_requested = [](void* data, float) {
      return static_cast<const Execution*>(data)->stop.stop_requested();
    };
    const bool complete = input_->read_image(part, 0, 0, spec.nchannels, type.read,
                                             type.widened() ? native.data() : samples.data(),
                                             OIIO::AutoStride, OIIO::AutoStride, OIIO::AutoStride,
                                             stop_requested, const_cast<Execution*>(&execution_));
    throw_if_stopped(execution_);
    if (!complete || input_->has_error()) fail();
    if (type.widened()) to_float(type.read, native, samples);
  }

  MemoryReader reader_;
  const std::string& format_;
  const std::string& name_;
  const Execution& execution_;
  std::size_t file_bytes_;
  std::unique_ptr<OIIO::ImageInput> input_;
  OIIO::ImageSpec first_;
};

}  // namespace

Decoded decode(ByteView bytes, const std::string& format, const std::string& name,
               const Execution& execution) {
  if (format == "jpeg") return decode_jpeg(bytes, name, execution);
  if (format == "gif") return decode_gif(bytes, name, execution);
  if (format == "webp") return decode_webp(bytes, name, execution);
  configure();
  int parts = 1;
  if (format == "openexr") parts = exr_parts(bytes, name);
  if (format == "tiff") parts = tiff_pages(bytes, name);
  return File(bytes, format, name, execution).decode(parts);
}

Bytes encode(const std::string& format, const Image& image, const std::string& description) {
  configure();
  if (image.depth > 1) return encode_exr_parts(image, channel_names(image.channels), description);
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
