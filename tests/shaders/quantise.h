// textures/shaders/bn_quantise.glsl as C++: the very text that runs on the device.
#pragma once

#include <cmath>

namespace bn::test {

struct Quantise {
  static float pow(float x, float y) { return std::pow(x, y); }
  static float floor(float x) { return std::floor(x); }
  static float min(float a, float b) { return b < a ? b : a; }

#include "bn_quantise.glsl"
};

}  // namespace bn::test
