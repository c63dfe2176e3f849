// A picture on the graphics card.

#pragma once

#include <imgui.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bn/grid.h"

namespace bn::ui {

/// Texels as ImGui packs colours (IM_COL32), row by row, and their halvings down to one texel.
struct MipLevels {
  Extent size;
  std::vector<std::vector<std::uint32_t>> texels;  ///< level i has sides max(1, side >> i)
};
/// Each level is the mean of four texels of the one before: for any thread.
MipLevels with_halvings(Extent size, std::vector<std::uint32_t> texels);

/// One RGBA texture with mip levels, repeating, for ImGui::Image. A large picture is brought to the card
/// piece by piece, while what was there before is shown. Only for the thread of the OpenGL context, which
/// must outlive it.
class GlTexture {
 public:
  GlTexture() = default;
  ~GlTexture() { reset(); }
  GlTexture(const GlTexture&) = delete;
  GlTexture& operator=(const GlTexture&) = delete;

  /// What is to be shown next. Sides up to kMaxSide.
  void begin(MipLevels levels);
  /// Brings about kBytesPerStep more to the card; when all is there, id() is it. Call it once a frame.
  void advance();
  /// Not all of what began last is there.
  bool pending() const { return !coming_levels_.texels.empty(); }
  /// How it is enlarged. It is always reduced smoothly, so that a distant mask looks grey and not aliased.
  void set_nearest(bool nearest);
  void reset();
  ImTextureID id() const { return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(shown_.name)); }
  bool empty() const { return shown_.name == 0; }

  static constexpr int kMaxSide = 8192;
  static constexpr std::size_t kBytesPerStep = std::size_t{4} << 20;

 private:
  struct Name {
    std::uint32_t name = 0;
    Extent size;
  };
  void allocate(Name& texture, Extent size) const;

  Name shown_, coming_;
  MipLevels coming_levels_;
  std::size_t level_ = 0;
  int row_ = 0;  ///< of that level, the next to go
  bool nearest_ = true;
};

}  // namespace bn::ui
