// Where the inspector is drawn: a window, or a picture in memory.

#pragma once

#include <memory>
#include <string>

#include "bn/texture.h"

namespace bn::ui {

class App;

class Surface {
 public:
  virtual ~Surface() = default;
  /// Gathers input for one frame of `app`; false once the user wants to leave.
  virtual bool begin_frame(App& app) = 0;
  /// Draws what ImGui has rendered ...
  virtual void draw() = 0;
  /// ... and brings it before the user's eyes.
  virtual void present() = 0;
  /// After the fonts have changed.
  virtual void upload_fonts() = 0;
  /// What was drawn and not yet presented, RGB.
  virtual Image pixels() = 0;
  /// Dots an inch of the display over 96.
  virtual float display_scale() const = 0;
};

/// A window with an OpenGL 3.3 context. Errors: io, saying what to do: no display, no OpenGL, one too old.
std::unique_ptr<Surface> open_window(Extent size);

/// A picture in memory, through EGL without any display server. Errors: io.
std::unique_ptr<Surface> open_offscreen(Extent size);

/// The bottom left `size` of the bound framebuffer, RGB, top row first.
Image read_framebuffer(Extent size);

}  // namespace bn::ui
