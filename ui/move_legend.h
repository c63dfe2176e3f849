// The legend of moves shown as hues.

#pragma once

#include <string>

#include "ui/gl_texture.h"

namespace bn::ui {

class MoveLegend {
 public:
  /// A disc `side` pixels wide: each colour stands where the move leads from the middle. On hover it is shown
  /// large, with words. `longest`: the length in pixels that has the full colour. Recorded as "Hues".
  void draw(float side, double longest);
  /// The same with its words around it.
  void draw_with_words(float side, double longest);

 private:
  void make();
  void draw_disc(ImDrawList& list, ImVec2 corner, float side) const;
  void draw_labelled(ImDrawList& list, ImVec2 corner, float side, double longest) const;

  GlTexture disc_;
  ImU32 around_ = 0;  ///< the colour that the disc was made to stand on
};

}  // namespace bn::ui
