// The passes of a frame, in their order: one list that both renderers execute.
//
// A pass names the images it reads and writes. It has one function for the processor and one that records it
// on a device; the two are equal bit for bit where the device rounds like IEEE. To add a pass, add it here,
// and its two functions to plain_renderer.cpp and vulkan_renderer.cpp.
#pragma once

#include <string_view>
#include <vector>

#include "bn/render.h"

namespace bn::render {

/// What passes read and write.
enum class FrameImage {
  scene,
  position,
  normal,
  albedo,
  motion,
  chosen_motion,  ///< one number, not an image of the screen
  moves,          ///< the retarget tiles
  seeds,
  moved_seeds,  ///< where retarget writes; the two change places after it
  levels,       ///< of the masks that pixels sample
  mask,         ///< that seeds are sorted like
  luminance,
  colour,
  shown
};

/// What the functions of passes work on; plain_renderer.cpp and vulkan_renderer.cpp have their definitions.
struct PlainFrame;
struct DeviceFrame;

struct FramePass {
  std::string_view name;
  std::vector<FrameImage> inputs;
  std::vector<FrameImage> outputs;
  void (*on_processor)(PlainFrame&);
  void (*on_device)(DeviceFrame&);
  /// Frame::seeds are what they are after this pass: later ones move them for the next frame.
  bool seeds_are_final = false;
};

/// The passes of frame `frame` of a sequence.
std::vector<FramePass> passes_of(const Method& method, int frame);

namespace on_processor {
void gbuffer(PlainFrame& frame);
void choose_motion(PlainFrame& frame);
void retarget(PlainFrame& frame);
void trace(PlainFrame& frame);
void sort(PlainFrame& frame);
void tone_map(PlainFrame& frame);
}  // namespace on_processor

namespace on_device {
void gbuffer(DeviceFrame& frame);
void choose_motion(DeviceFrame& frame);
void retarget(DeviceFrame& frame);
void trace(DeviceFrame& frame);
void sort(DeviceFrame& frame);
void tone_map(DeviceFrame& frame);
}  // namespace on_device

}  // namespace bn::render
