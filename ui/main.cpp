// bn-inspector: the command line, and the way out for every error.

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <optional>

#include "bn/error.h"
#include "bn/version.h"
#include "tools/command_line.h"
#include "tools/failure.h"
#include "tools/help_text.h"
#include "tools/output.h"
#include "ui/loop.h"

namespace bn::ui {
namespace {

struct Options {
  std::filesystem::path file, script, screenshot;
  bool headless = false, help = false, version = false;
  int width = 1280, height = 800;
  std::optional<std::filesystem::path> session;  ///< empty: none is kept
};

/// A file, or the word "none" for none.
tools::ValueKind<std::optional<std::filesystem::path>> session_path() {
  tools::ValueKind<std::optional<std::filesystem::path>> kind;
  kind.placeholder = "FILE|none";
  kind.completion = tools::Completion::file;
  kind.parse = [](std::string_view text, std::string_view) {
    return std::filesystem::path(text == "none" ? "" : text);
  };
  return kind;
}

tools::Verb declare(Options& options) {
  tools::Verb program{
      .name = "bn-inspector",
      .summary = "",
      .examples = {{"bn-inspector textures/64/mask.png", "a texture: its spectrum, its figures, verified"},
                   {"bn-inspector slices", "the slices of a folder, as one texture"},
                   {"bn-inspector textures/default.toml", "a recipe, to be baked"},
                   {"bn-inspector --headless --screenshot shot.png mask.png", "a picture, without a display"},
                   {"bn-inspector --headless --script steps.script", "what the script says, likewise"}},
      .details =
          "A window in which annealing is watched, steered and compared, textures are looked at, and recipes "
          "are baked. Without an argument it begins where the last session ended.\n\n"
          "docs/inspector.md has the keys and the commands of scripts."};
  tools::Arguments& list = program.arguments;
  list.optional_positional("FILE", options.file, tools::file_path(),
                           "A texture, a folder of slices, or a recipe (.toml) to open.");
  list.flag("--headless", options.headless, true,
            "Draw into memory, without a display; needs --script or --screenshot.");
  list.option("--script", options.script, tools::file_path(), "Do what this file says.");
  list.option(
      "--screenshot", options.screenshot, tools::texture_path(),
      "Write the last frame to this picture; without a script, the first after which nothing is being "
      "computed.");
  list.option("--width", options.width, tools::integer_in(320, 8192), "Of the window, in pixels.");
  list.option("--height", options.height, tools::integer_in(240, 8192), "Of the window, in pixels.");
  list.option("--session", options.session, session_path(),
              "Where settings are kept between starts; none: nowhere. Default: with --headless none, else "
              "bn-inspector/session.json below $XDG_STATE_HOME.");
  list.flag("--help", options.help, true, "Print this help.", "-h");
  list.flag("--version", options.version, true, "Print the version.", "-V");
  return program;
}

/// What can be said before anything is drawn.
void check(const Options& options) {
  if (options.headless && options.script.empty() && options.screenshot.empty()) {
    throw Error({.code = ErrorCode::usage,
                 .what = "nothing would be seen",
                 .where = "--headless",
                 .limit = "",
                 .remedy = "add --screenshot OUT.png or --script FILE"});
  }
  std::error_code error;
  if (!options.file.empty() && !std::filesystem::exists(options.file, error)) {
    throw Error({.code = ErrorCode::io,
                 .what = "does not exist",
                 .where = options.file.string(),
                 .limit = "",
                 .remedy = "check the path"});
  }
  if (!options.screenshot.empty()) check_writable(options.screenshot, SampleType::u8, 3);
}

void run(const Options& options) {
  check(options);
  std::optional<Script> script;
  if (!options.script.empty()) script = Script::read(options.script);

  const Extent size{options.width, options.height};
  ImGuiSession session;
  const auto surface = options.headless ? open_offscreen(size) : open_window(size);
  App app(options.session.value_or(options.headless ? std::filesystem::path() : session_file()));
  if (!options.file.empty()) app.open(options.file);
  const bool only_a_picture = options.headless && !script;
  if (only_a_picture) {
    run_until_idle(app, *surface);
  } else {
    run_loop(app, *surface, script ? &*script : nullptr);
  }
  if (!options.screenshot.empty()) {
    Script last(fmt::format("wait 4\nscreenshot \"{}\"", options.screenshot.string()), "--screenshot");
    app.quit = false;
    run_loop(app, *surface, &last);
  }
  app.close();
  // Nobody saw the window say it.
  if (only_a_picture && !app.errors().empty()) throw app.errors().front();
}

int guarded_run(const std::vector<std::string>& words) {
  Options options;
  const tools::Verb program = declare(options);
  try {
    tools::parse_arguments(words, program.name, program.arguments);
    if (options.help) {
      tools::Output().write(tools::program_help(program));
    } else if (options.version) {
      tools::Output().write(fmt::format("bn-inspector {}\n", kVersion));
    } else {
      run(options);
    }
    return 0;
  } catch (...) {
    const Error error = tools::error_in_flight(program.name);
    std::fprintf(stderr, "bn-inspector: %s\n", error.what());
    return tools::exit_code_of(error.code());
  }
}

}  // namespace
}  // namespace bn::ui

int main(int argc, char** argv) {
  return bn::ui::guarded_run(std::vector<std::string>(argv + (argc > 0), argv + argc));
}
