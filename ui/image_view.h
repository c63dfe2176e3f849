// A picture that is zoomed and panned together with others, with the values under the cursor.

#pragma once

#include <imgui.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bn/grid.h"
#include "ui/gl_texture.h"
#include "ui/task.h"

namespace bn::ui {

class Parameters;

/// What an image view shows.
struct Picture {
  Extent size;
  int channels = 1;           ///< 1..4: grey, red and green, RGB, RGBA (alpha is shown by the values only)
  std::vector<float> values;  ///< interleaved, index (y * width + x) * channels + c
  unsigned visible = 15;      ///< of several channels those that are drawn: bit c
  int hex_digits = 0;         ///< of a value; 0: values are no whole numbers
  float low = 0.0f;           ///< the value that is black when the range is reset ...
  float high = 255.0f;        ///< ... and the white one
  /// Not empty: shown as it is (IM_COL32 a pixel) in place of the values, without range control.
  std::vector<std::uint32_t> colours = {};
  /// Drawn over each texel that is large enough to hold it: `corner` on the screen, `size` pixels wide.
  std::function<void(ImDrawList& list, int x, int y, ImVec2 corner, float size)> overlay = {};
  /// What to say of a pixel; empty: its values.
  std::function<std::string(int x, int y)> describe = {};
};

/// Pixels that are worked on within a frame, in a millisecond or two; what has more goes off the window's
/// thread.
inline constexpr std::int64_t kAtOnce = 512 * 512;

/// Zoom, pan and manner, shared by all views that are linked.
struct ViewLink {
  double centre_x = 0.5, centre_y = 0.5;  ///< the middle of the view, in shares of the picture
  double zoom = 0.0;                      ///< screen pixels a texel; 0: as large as fits
  bool nearest = true;
  bool tiled = false;                 ///< 3 x 3 repetitions
  bool hex = false;                   ///< whole values are written so
  std::optional<Offset> pinned = {};  ///< a texel that is marked, and told of while the mouse is elsewhere
  std::optional<Offset> cursor = {};  ///< texel under the mouse in any of the views, of the last frame

  /// `view` tells links apart: "texture".
  void parameters(Parameters& p, const std::string& view);
  void fit() { zoom = 0.0, centre_x = centre_y = 0.5; }
  /// Brings a texel of a picture into the middle, near enough for its value, and pins it.
  void go_to(Offset texel, Extent size);
};

/// The switches of a link: fit, 1:1, zoom in and out, nearest or linear, 3 x 3. `name` tells several sets
/// apart.
void draw_link_controls(ViewLink& link);

class ImageView {
 public:
  /// Takes the picture. Same size as before: zoom and range stay. Cheap enough to call for every frame of a
  /// 64² run; a large picture's texels are made off the window's thread and brought to the card piece by
  /// piece, the one before stays meanwhile. Sides beyond GlTexture::kMaxSide are thinned out on the screen.
  void set(std::shared_ptr<const Picture> picture);
  void set(Picture picture) { set(std::make_shared<const Picture>(std::move(picture))); }
  void clear();
  bool empty() const { return picture_->size.area() == 0; }
  /// Texels are on their way, so that it must be drawn again without input.
  bool busy() const { return !empty() && (stale_ || preparing_.running() || texture_.pending()); }
  bool has_range() const { return !empty() && picture_->colours.empty() && !picture_->values.empty(); }
  const std::shared_ptr<const Picture>& picture() const { return picture_; }

  /// The picture with its title above and a line of values below; `name` is its item name for scripts. Drag
  /// pans, the wheel zooms about the cursor, a double click fits.
  void draw(const char* name, ViewLink& link, ImVec2 size);
  /// The range that is shown from black to white, under a histogram: two handles, a reset. Nothing for
  /// coloured ones.
  void draw_range(const char* name, float height);
  /// The same as numbers, and what is least and greatest in the picture ("Auto"). One row.
  void draw_range_fields();

 private:
  /// What is made from a picture and a range.
  struct Prepared {
    MipLevels levels;
    std::vector<std::int64_t> histogram;
  };
  static Prepared prepare(const Picture& picture, float low, float high);
  void prepare_texels();
  std::string describe(int x, int y, bool hex) const;
  std::string value_text(float value, bool hex) const;
  std::string below(const ViewLink& link, float width) const;
  /// The values of a texel, where they fit into `size` pixels.
  void draw_values(ImDrawList& list, int x, int y, ImVec2 corner, float size, bool hex) const;
  float widest_value(bool hex) const;

  std::shared_ptr<const Picture> picture_ = std::make_shared<const Picture>();
  GlTexture texture_;
  float low_ = 0.0f, high_ = 255.0f;
  bool stale_ = false;   ///< texture_ must be made again
  bool failed_ = false;  ///< there was no memory for it
  std::vector<std::int64_t> histogram_;
  Task<Prepared> preparing_;
};

}  // namespace bn::ui
