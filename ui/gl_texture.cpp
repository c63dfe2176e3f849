#include "ui/gl_texture.h"

#include "ui/gl.h"

namespace bn::ui {

void GlTexture::upload(Extent size, const std::vector<std::uint32_t>& texels) {
  const bool same = name_ != 0 && size == size_;
  if (name_ == 0) glGenTextures(1, &name_);
  glBindTexture(GL_TEXTURE_2D, name_);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  if (same) {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.width, size.height, GL_RGBA, GL_UNSIGNED_BYTE,
                    texels.data());
  } else {
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size.width, size.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 texels.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, nearest_ ? GL_NEAREST : GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
    size_ = size;
  }
  glGenerateMipmap(GL_TEXTURE_2D);
}

void GlTexture::set_nearest(bool nearest) {
  if (nearest == nearest_) return;
  nearest_ = nearest;
  if (name_ == 0) return;
  glBindTexture(GL_TEXTURE_2D, name_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, nearest ? GL_NEAREST : GL_LINEAR);
}

void GlTexture::reset() {
  if (name_ != 0) glDeleteTextures(1, &name_);
  name_ = 0;
  size_ = {};
}

}  // namespace bn::ui
