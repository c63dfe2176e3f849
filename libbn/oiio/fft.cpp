#include "oiio/fft.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

extern "C" void bn_oiio_fft(const float* values, int side,
                            const std::function<void(const std::function<void()>&)>& measure,
                            std::vector<std::complex<float>>& spectrum, std::string& error) {
  std::vector<float> copy(values, values + static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  const OIIO::ImageBuf source(OIIO::ImageSpec(side, side, 1, OIIO::TypeDesc::FLOAT), copy.data());
  OIIO::ImageBuf result;
  measure([&] {
    if (!OIIO::ImageBufAlgo::fft(result, source, OIIO::ROI::All(), 1)) error = result.geterror();
  });
  if (!error.empty()) return;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x)
      spectrum.emplace_back(result.getchannel(x, y, 0, 0), result.getchannel(x, y, 0, 1));
  }
}
