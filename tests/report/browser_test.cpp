// Protects: the page as a browser shows it: every picture and plot there, nothing wider than the window at
// 1280 and 400 pixels, no word on the console. Needs Chromium and gnuplot; skips without.
#include <gtest/gtest.h>

#include "report/child_process.h"
#include "report/fixtures.h"
#include "report/html.h"

namespace bn::report {
namespace {

/// Looks at the page and writes what it finds into its root element, which --dump-dom prints. The probes are
/// frames of a known width: a window of 400 pixels is less than some systems give.
constexpr const char* kProbe = R"html(<!DOCTYPE html><html><head><meta charset="utf-8"></head><body><script>
const page = new TextDecoder().decode(Uint8Array.from(atob("PAGE"), c => c.charCodeAt(0)));
const found = [];
let left = 2;
for (const width of [1280, 400]) {
  const frame = document.createElement("iframe");
  frame.style.cssText = "border:0;height:900px;width:" + width + "px";
  frame.onload = () => {
    const d = frame.contentDocument;
    const images = [...d.images], charts = [...d.querySelectorAll("svg.chart")];
    const wide = [...d.querySelectorAll("main *")].filter(e => e.getBoundingClientRect().right > width + 0.5 &&
        !e.closest(".wide, .zoom, pre, svg")).map(e => e.tagName + "." + e.className).join(" ");
    found.push("[" + width + " window " + frame.contentWindow.innerWidth + " overflow " +
        (d.documentElement.scrollWidth - d.documentElement.clientWidth) + " images " + images.length + " broken " +
        images.filter(i => !i.complete || i.naturalWidth == 0).length + " charts " + charts.length + " empty " +
        charts.filter(c => c.getBBox().width < 300 || c.querySelectorAll("path, polygon").length < 5).length +
        " wide:" + wide + "]");
    if (--left == 0) document.documentElement.setAttribute("data-found", found.sort().join(""));
  };
  frame.srcdoc = page;
  document.body.append(frame);
}
</script></body></html>)html";

std::string chromium(const std::filesystem::path& program, const std::filesystem::path& profile,
                     std::vector<std::string> more, std::string& messages) {
  std::vector<std::string> arguments{"--headless",
                                     "--no-sandbox",
                                     "--disable-gpu",
                                     "--disable-quic",
                                     "--no-first-run",
                                     "--disable-background-networking",
                                     "--disable-component-update",
                                     "--disable-sync",
                                     "--disable-dev-shm-usage",
                                     "--enable-logging=stderr",
                                     "--user-data-dir=" + profile.string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const auto result = run_child(program, arguments, "", std::chrono::seconds(120), {});
  messages = result.errors;
  EXPECT_TRUE(result.succeeded) << result.failure;
  return result.output;
}

TEST(Browser, ShowsEverythingFitsAndStaysSilent) {
  const auto program = find_program("chromium");
  if (!program) GTEST_SKIP() << "chromium is not installed";
  if (!find_program("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "textures");
  write_set(folder / "textures");
  const std::string long_name(120, 'w');
  write_mask(folder / "textures" / (long_name + ".png"), 48, 2);
  const auto summary =
      write_report({.inputs = {folder / "textures"}, .out = folder / "r.html", .compare = true});
  EXPECT_EQ(summary.notes, std::vector<std::string>{});
  const std::string page = bytes_of(folder / "r.html");
  const std::size_t images = count_of(page, "<img "), charts = count_of(page, "<svg ");
  EXPECT_EQ(images, 2u * (5 + 30) + 2 * 2 + 7);  // two textures, their cards, a retarget set
  EXPECT_EQ(charts, 2u * 4 + 3 + 2);

  std::string probe = kProbe;
  probe.replace(probe.find("PAGE"), 4,
                base64({reinterpret_cast<const unsigned char*>(page.data()), page.size()}));
  put_bytes(folder / "probe.html", probe);
  std::string messages;
  const std::string dom = chromium(
      *program, folder / "profile",
      {"--virtual-time-budget=20000", "--dump-dom", "file://" + (folder / "probe.html").string()}, messages);
  const auto expect = [&](int width) {
    const std::string text = "[" + std::to_string(width) + " window " + std::to_string(width) +
                             " overflow 0 images " + std::to_string(images) + " broken 0 charts " +
                             std::to_string(charts) + " empty 0 wide:]";
    EXPECT_NE(dom.find(text), std::string::npos) << dom.substr(0, 600);
  };
  expect(1280);
  expect(400);

  chromium(*program, folder / "profile", {"--dump-dom", "file://" + (folder / "r.html").string()}, messages);
  EXPECT_EQ(messages.find("CONSOLE"), std::string::npos) << messages;
}

}  // namespace
}  // namespace bn::report
