// Protects: the real window, its keys, mouse and settings, under a display server.

#include <fstream>
#include <iterator>

#include "ui/inspector.h"

namespace bn::ui {
namespace {

TEST(Window, AnswersKeysAndMouseAndKeepsItsSettings) {
  const Workplace here;
  if (here.shell("command -v xvfb-run xdotool").exit_code != 0) GTEST_SKIP() << "no Xvfb or xdotool here";
  here.write_mask("mask.png", 64);
  const Outcome outcome = here.shell(BN_TESTS "/ui/window " BN_INSPECTOR " .");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;

  std::ifstream file(here / "session.json");
  const std::string session(std::istreambuf_iterator<char>(file), {});
  EXPECT_NE(session.find("\"dark\": \"no\""), std::string::npos) << session;
  EXPECT_NE(session.find("\"tab\": \"2\""), std::string::npos) << session;
  EXPECT_NE(session.find("mask.png"), std::string::npos) << session;

  const Image shot = read_image(here / "window.png").image;
  ASSERT_EQ(shot.size, (Extent{1280, 770}));
  EXPECT_GT(contrast(shot, {0.05, 0.3, 0.40, 0.7}), 50.0) << "the mask";
  EXPECT_GT(contrast(shot, {0.73, 0.1, 0.98, 0.5}), 10.0) << "its facts";
}

}  // namespace
}  // namespace bn::ui
