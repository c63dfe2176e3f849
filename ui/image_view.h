// A picture that is zoomed and panned together with others, with the values under the cursor.

#pragma once

#include <imgui.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bn/core.h"
#include "ui/gl_texture.h"

namespace bn::ui {

class Parameters;

/// What an image view shows.
struct Picture {
  Extent size;
  int channels = 1;           ///< 1..4: grey, red and green, RGB, RGBA (alpha is shown by the values only)
  std::vector<float> values;  ///< interleaved, index (y * width + x) * channels + c
  float low = 0.0f;           ///< the value that is black when the range is reset ...
  float high = 255.0f;        ///< ... and the white one
  /// Not empty: shown as it is (IM_COL32 a pixel) in place of the values, without range control.
  std::vector<std::uint32_t> colours = {};
  /// Drawn over each texel that is large enough to hold it: `corner` on the screen, `size` pixels wide.
  std::function<void(ImDrawList& list, int x, int y, ImVec2 corner, float size)> overlay = {};
  /// What to say of a pixel; empty: its values.
  std::function<std::string(int x, int y)> describe = {};
};

/// Zoom, pan and manner, shared by all views that are linked.
struct ViewLink {
  double centre_x = 0.5, centre_y = 0.5;  ///< the middle of the view, in shares of the picture
  double zoom = 0.0;                      ///< screen pixels a texel; 0: as large as fits
  bool nearest = true;
  bool tiled = false;                 ///< 3 x 3 repetitions
  std::optional<Offset> cursor = {};  ///< texel under the mouse in any of the views, of the last frame

  /// `view` tells links apart: "texture".
  void parameters(Parameters& p, const std::string& view);
  void fit() { zoom = 0.0, centre_x = centre_y = 0.5; }
};

/// The switches of a link: fit, 1:1, zoom in and out, nearest or linear, 3 x 3. `name` tells several sets
/// apart.
void draw_link_controls(ViewLink& link);

class ImageView {
 public:
  /// Takes the picture. Same size as before: zoom and range stay. Cheap enough to call for every frame of a
  /// 64² run; a picture whose sides pass GlTexture::kMaxSide is thinned out on the screen.
  void set(Picture picture);
  void clear();
  bool empty() const { return picture_.size.area() == 0; }
  bool has_range() const { return !empty() && picture_.colours.empty() && !picture_.values.empty(); }
  const Picture& picture() const { return picture_; }

  /// The picture with its title above and a line of values below; `name` is its item name for scripts. Drag
  /// pans, the wheel zooms about the cursor, a double click fits.
  void draw(const char* name, ViewLink& link, ImVec2 size);
  /// The range that is shown from black to white, under a histogram: two handles, a reset. Nothing for
  /// coloured ones.
  void draw_range(const char* name, float height);

 private:
  void show_values();
  std::string describe(int x, int y) const;

  Picture picture_;
  GlTexture texture_;
  float low_ = 0.0f, high_ = 255.0f;
  bool stale_ = false;  ///< texture_ must be made again
  std::vector<std::int64_t> histogram_;
};

}  // namespace bn::ui
