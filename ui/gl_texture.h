// A picture on the graphics card.

#pragma once

#include <imgui.h>

#include <cstdint>
#include <vector>

#include "bn/core.h"

namespace bn::ui {

/// One RGBA texture with mip levels, repeating, for ImGui::Image. Only for the thread of the OpenGL context,
/// which must outlive it.
class GlTexture {
 public:
  GlTexture() = default;
  ~GlTexture() { reset(); }
  GlTexture(const GlTexture&) = delete;
  GlTexture& operator=(const GlTexture&) = delete;

  /// Texels as ImGui packs colours (IM_COL32), row by row. Sides up to kMaxSide.
  void upload(Extent size, const std::vector<std::uint32_t>& texels);
  /// How it is enlarged. It is always reduced smoothly, so that a distant mask looks grey and not aliased.
  void set_nearest(bool nearest);
  void reset();
  ImTextureID id() const { return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(name_)); }
  bool empty() const { return name_ == 0; }

  static constexpr int kMaxSide = 8192;

 private:
  std::uint32_t name_ = 0;
  Extent size_;
  bool nearest_ = true;
};

}  // namespace bn::ui
