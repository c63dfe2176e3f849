// The inspector in a window of the desktop, by GLFW.

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <cstdlib>
#include <set>
#include <utility>
#include <vector>

#include "bn/error.h"
#include "ui/app.h"
#include "ui/gl.h"
#include "ui/surface.h"

namespace bn::ui {
namespace {

// Between frames without input: while nothing happens, and while something runs, whose processor drawing
// shares.
constexpr double kIdleSeconds = 0.25;
constexpr double kBusySeconds = 1.0 / 60.0;

std::string glfw_message() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "unknown reason";
}

class Window final : public Surface {
 public:
  explicit Window(Extent size) {
    if (!glfwInit()) {
      const bool none = std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr;
      throw Error({.code = ErrorCode::io,
                   .what = none ? "there is no display (DISPLAY is not set)" : "no window: " + glfw_message(),
                   .where = "bn-inspector",
                   .limit = "",
                   .remedy = "start it on a desktop, or without one: --headless --script FILE"});
    }
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    window_ = glfwCreateWindow(size.width, size.height, "bn inspector", nullptr, nullptr);
    if (window_ == nullptr) {
      const std::string reason = glfw_message();
      glfwTerminate();
      throw Error(
          {.code = ErrorCode::io,
           .what = "no window with OpenGL 3.3: " + reason,
           .where = "bn-inspector",
           .limit = "OpenGL 3.3 or newer",
           .remedy = "update the graphics driver, or use Mesa's software renderer: LIBGL_ALWAYS_SOFTWARE=1"});
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    glfwSetWindowUserPointer(window_, this);
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
      auto& self = *static_cast<Window*>(glfwGetWindowUserPointer(window));
      self.dropped_.assign(paths, paths + count);
    });
    ImGui_ImplGlfw_InitForOpenGL(window_, true);
    // A key that is pressed and let go between two frames would be missed: its end waits for the next frame.
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int code, int action, int modifiers) {
      auto& self = *static_cast<Window*>(glfwGetWindowUserPointer(window));
      if (action == GLFW_RELEASE && self.pressed_.contains(key)) {
        self.released_.push_back({key, code, modifiers});
      } else {
        if (action == GLFW_PRESS) self.pressed_.insert(key);
        ImGui_ImplGlfw_KeyCallback(window, key, code, action, modifiers);
      }
    });
    ImGui_ImplOpenGL3_Init("#version 330 core");
  }

  ~Window() override {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    glfwDestroyWindow(window_);
    glfwTerminate();
  }

  bool begin_frame(App& app) override {
    for (const auto& [key, code, modifiers] : released_) {
      ImGui_ImplGlfw_KeyCallback(window_, key, code, GLFW_RELEASE, modifiers);
    }
    released_.clear();
    pressed_.clear();
    if (lively_frames_ > 0) {
      glfwPollEvents();
      --lively_frames_;
    } else {
      const double before = glfwGetTime(), pause = app.busy() ? kBusySeconds : kIdleSeconds;
      glfwWaitEventsTimeout(pause);
      // Input: ImGui takes a few frames to settle, and the next input is likely near.
      if (glfwGetTime() - before < pause) lively_frames_ = 30;
    }
    for (const auto& path : dropped_) app.take(path);
    dropped_.clear();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    return !glfwWindowShouldClose(window_);
  }

  void draw() override {
    glfwGetFramebufferSize(window_, &size_.width, &size_.height);
    glViewport(0, 0, size_.width, size_.height);
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  }

  void present() override { glfwSwapBuffers(window_); }

  void upload_fonts() override {
    if (!std::exchange(begun_, true)) return;  // the first frame makes all textures
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
  }

  Image pixels() override {
    glReadBuffer(GL_BACK);
    return read_framebuffer(size_);
  }

  float display_scale() const override {
    float x = 1.0f, y = 1.0f;
    glfwGetWindowContentScale(window_, &x, &y);
    return x;
  }

 private:
  GLFWwindow* window_ = nullptr;
  Extent size_;
  bool begun_ = false;
  int lively_frames_ = 30;
  std::vector<std::string> dropped_;
  struct Release {
    int key, code, modifiers;
  };
  std::set<int> pressed_;          ///< since the last frame
  std::vector<Release> released_;  ///< likewise
};

}  // namespace

std::unique_ptr<Surface> open_window(Extent size) { return std::make_unique<Window>(size); }

}  // namespace bn::ui
