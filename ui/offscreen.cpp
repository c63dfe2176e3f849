// The inspector without a display: EGL's surfaceless platform, a framebuffer object, and input that a script
// sets.

#define EGL_EGLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>

#include <cstring>
#include <utility>

#include "bn/error.h"
#include "ui/gl.h"
#include "ui/keys.h"
#include "ui/surface.h"

namespace bn::ui {
namespace {

[[noreturn]] void fail(std::string what, std::string remedy) {
  throw Error({.code = ErrorCode::io,
               .what = std::move(what),
               .where = "--headless",
               .limit = "",
               .remedy = std::move(remedy)});
}

class Offscreen final : public Surface {
 public:
  explicit Offscreen(Extent size) : size_(size) {
    make_context();
    make_framebuffer();
    ImGuiIO& io = ImGui::GetIO();
    io.BackendPlatformName = "offscreen";
    io.DisplaySize = {static_cast<float>(size.width), static_cast<float>(size.height)};
    map_keys(io);
    if (!ImGui_ImplOpenGL3_Init("#version 330 core")) fail("ImGui cannot use this OpenGL", "");
  }

  ~Offscreen() override {
    ImGui_ImplOpenGL3_Shutdown();
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    // The display is the process's, and ends with it: terminated, Mesa would unload its driver, and a leak
    // sanitizer could no longer tell the driver's last allocations from leaks of ours.
  }

  bool begin_frame(App&) override {
    ImGuiIO& io = ImGui::GetIO();
    const Extent wanted{static_cast<int>(io.DisplaySize.x), static_cast<int>(io.DisplaySize.y)};
    if (!(wanted == size_)) {
      size_ = wanted;
      make_framebuffer();
    }
    io.DeltaTime = 1.0f / 60.0f;  // so that equal scripts see equal times
    ImGui_ImplOpenGL3_NewFrame();
    return true;
  }

  void draw() override {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glViewport(0, 0, size_.width, size_.height);
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  }

  void present() override { glFinish(); }  // a frame counts when it is drawn

  void upload_fonts() override {
    if (!std::exchange(begun_, true)) return;  // the first frame makes all textures
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
  }

  Image pixels() override {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    return read_framebuffer(size_);
  }

  float display_scale() const override { return 1.0f; }

 private:
  void make_context() {
    const auto get_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (get_display != nullptr)
      display_ = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display_ == EGL_NO_DISPLAY || !eglInitialize(display_, nullptr, nullptr)) {
      fail("EGL has no surfaceless platform here",
           "install Mesa's drivers (Debian: libegl-mesa0, libgl1-mesa-dri)");
    }
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    eglBindAPI(EGL_OPENGL_API);
    if (!eglChooseConfig(display_, wanted, &config, 1, &count) || count == 0) config = EGL_NO_CONFIG_KHR;
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION,
                              3,
                              EGL_CONTEXT_MINOR_VERSION,
                              3,
                              EGL_CONTEXT_OPENGL_PROFILE_MASK,
                              EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                              EGL_NONE};
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version);
    if (context_ == EGL_NO_CONTEXT || !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
      fail("this machine's OpenGL is older than 3.3",
           "update the driver, or use Mesa's software renderer: LIBGL_ALWAYS_SOFTWARE=1");
    }
  }

  void make_framebuffer() {
    if (framebuffer_ == 0) {
      glGenFramebuffers(1, &framebuffer_);
      glGenTextures(1, &colour_);
    }
    glBindTexture(GL_TEXTURE_2D, colour_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size_.width, size_.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_, 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      fail(fmt::format("OpenGL cannot draw into a picture of {} x {}", size_.width, size_.height),
           "take a smaller one");
    }
  }

  Extent size_;
  bool begun_ = false;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
  GLuint framebuffer_ = 0, colour_ = 0;
};

}  // namespace

std::unique_ptr<Surface> open_offscreen(Extent size) { return std::make_unique<Offscreen>(size); }

Image read_framebuffer(Extent size) {
  Image image{.size = size, .channels = 3, .type = SampleType::u8, .samples = {}};
  const std::size_t row = static_cast<std::size_t>(size.width) * 3;
  std::vector<std::byte> upside_down(row * static_cast<std::size_t>(size.height));
  image.samples.resize(upside_down.size());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size.width, size.height, GL_RGB, GL_UNSIGNED_BYTE, upside_down.data());
  for (int y = 0; y < size.height; ++y) {
    const auto from = static_cast<std::size_t>(size.height - 1 - y) * row;
    std::memcpy(image.samples.data() + static_cast<std::size_t>(y) * row, upside_down.data() + from, row);
  }
  return image;
}

}  // namespace bn::ui
