// An EXR whose channels have names of their own, as a renderer writes it.

#pragma once

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

#include "bn/noise.h"
#include "bn/texture.h"

namespace bn::tools {

/// `mask` is the channel Z; R and id are white noise.
inline void write_named_exr(const std::filesystem::path& path, const Grid<std::uint32_t>& mask) {
  const auto [width, height] = mask.size();
  Imf::Header header(width, height);
  Imf::FrameBuffer buffer;
  std::vector<Image> images;
  for (const char* name : {"Z", "id", "R"}) {
    images.push_back(
        encode_mask(*name == 'Z' ? mask : white_noise_mask(mask.size(), images.size()), SampleType::f32));
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    buffer.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(images.back().samples.data()),
                                   sizeof(float), sizeof(float) * static_cast<std::size_t>(width)));
  }
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(buffer);
  file.writePixels(height);
}

}  // namespace bn::tools
