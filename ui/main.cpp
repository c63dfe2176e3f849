// bn-inspector: the command line, and the way out for every error.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "bn/error.h"
#include "bn/version.h"
#include "ui/loop.h"

namespace bn::ui {
namespace {

struct Options {
  std::string file, script, screenshot;
  bool headless = false;
  int width = 1280, height = 800;
  std::optional<std::string> session;
};

void run(const Options& options) {
  std::optional<Script> script;
  if (!options.script.empty()) script = Script::read(options.script);
  if (options.headless && !script && options.screenshot.empty()) {
    throw Error({.code = ErrorCode::usage,
                 .what = "nothing would be seen",
                 .where = "--headless",
                 .limit = "",
                 .remedy = "add --script FILE or --screenshot OUT.png"});
  }
  if (!options.screenshot.empty()) check_writable(options.screenshot, SampleType::u8, 3);

  const Extent size{options.width, options.height};
  ImGuiSession session;
  const auto surface = options.headless ? open_offscreen(size) : open_window(size);
  App app(options.session    ? std::filesystem::path(*options.session)
          : options.headless ? std::filesystem::path()
                             : session_file());
  if (!options.file.empty()) app.open(options.file);
  run_loop(app, *surface, script ? &*script : nullptr);
  if (!options.screenshot.empty()) {
    Script last(fmt::format("wait 4\nscreenshot \"{}\"", options.screenshot), "--screenshot");
    app.quit = false;
    run_loop(app, *surface, &last);
  }
  app.close();
}

}  // namespace
}  // namespace bn::ui

int main(int argc, char** argv) {
  bn::ui::Options options;
  CLI::App line("bn-inspector: watch, steer and compare annealing; look at textures; bake recipes.");
  line.add_option("FILE", options.file, "A texture, a folder of slices, or a recipe (.toml) to open.");
  line.add_flag("--headless", options.headless, "Draw into memory; no display is needed.");
  line.add_option("--script", options.script, "Do what this file says (docs/inspector.md).");
  line.add_option("--screenshot", options.screenshot, "Write the last frame to this PNG.");
  line.add_option("--width", options.width, "Of the window.")->check(CLI::Range(320, 8192));
  line.add_option("--height", options.height, "Of the window.")->check(CLI::Range(240, 8192));
  line.add_option("--session", options.session, "Keep settings in this file; empty: nowhere.");
  line.set_version_flag("--version", std::string("bn-inspector ") + std::string(bn::kVersion));
  try {
    line.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return line.exit(error) == 0 ? 0 : 1;
  }
  try {
    bn::ui::run(options);
    return 0;
  } catch (const bn::Error& error) {
    std::fprintf(stderr, "bn-inspector: %s\n", error.what());
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bn-inspector: a defect: %s\n", error.what());
    return 70;
  }
}
