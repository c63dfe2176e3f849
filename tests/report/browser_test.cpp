// Protects: the page as a browser shows it: every picture and plot there, nothing wider than the window at
// 1280 and 400 pixels, no word on the console. Needs Chromium and gnuplot; skips without.
#include <gtest/gtest.h>

#include "report/child_process.h"
#include "report/fixtures.h"
#include "report/html.h"

namespace bn::report {
namespace {

/// Looks at the page and writes what it finds into its root element, which --dump-dom prints. The probes are
/// frames of a known width: a window of 400 pixels is less than some systems give. "faint" counts the texts
/// and curves of plots that stand out from the page by less than they should: a contrast of 4.5
/// (WCAG 2.2, 1.4.3) for texts, of 3 (1.4.11) for the curves of textures. "uneven" counts pictures whose
/// pixels are no whole number of the page's, though they are shown unsmoothed.
constexpr const char* kProbe =
    R"html(<!DOCTYPE html><html><head><meta charset="utf-8"><meta name="color-scheme"
content="light dark"></head><body><script>
const page = new TextDecoder().decode(Uint8Array.from(atob("PAGE"), c => c.charCodeAt(0)));
const luminance = color => {
  const [r, g, b] = color.match(/[\d.]+/g).slice(0, 3).map(v => v / 255).map(v =>
      v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
};
const contrast = (a, b) => {
  const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return (high + 0.05) / (low + 0.05);
};
const found = [];
let left = 2;
for (const width of [1280, 400]) {
  const frame = document.createElement("iframe");
  frame.style.cssText = "border:0;height:900px;width:" + width + "px";
  frame.onload = () => {
    const d = frame.contentDocument, style = e => frame.contentWindow.getComputedStyle(e);
    const images = [...d.images], charts = [...d.querySelectorAll("svg.chart")];
    const wide = [...d.querySelectorAll("main *")].filter(e => e.getBoundingClientRect().right > width + 0.5 &&
        !e.closest(".wide, .zoom, pre, svg")).map(e => e.tagName + "." + e.className).join(" ");
    const paper = style(d.body).backgroundColor;
    const texts = [...d.querySelectorAll("svg.chart text")], curves = [...d.querySelectorAll("svg.chart path")].filter(
        e => /--plot-[3-8]\b/.test(e.getAttribute("stroke")));
    const faint = texts.filter(e => contrast(style(e).fill, paper) < 4.5).length +
        curves.filter(e => contrast(style(e).stroke, paper) < 3).length;
    const uneven = images.filter(i => !i.closest(".cut, .narrow-cut") && getComputedStyle(i).imageRendering == "pixelated" && i.getBoundingClientRect().width % i.naturalWidth != 0).length;
    found.push("[" + width + " window " + frame.contentWindow.innerWidth + " overflow " +
        (d.documentElement.scrollWidth - d.documentElement.clientWidth) + " images " + images.length + " broken " +
        images.filter(i => !i.complete || i.naturalWidth == 0).length + " charts " + charts.length + " empty " +
        charts.filter(c => c.getBBox().width < 300 || c.querySelectorAll("path, polygon").length < 5).length +
        " faint " + faint + " uneven " + uneven + " wide:" + wide + "] paper " + paper + " texts " + texts.length +
        " curves " + curves.length);
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

class Browser : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!find_program("chromium")) GTEST_SKIP() << "chromium is not installed";
    if (!find_program("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
    std::filesystem::create_directories(folder / "textures");
  }

  /// Opens the page at both widths, light and dark; it holds so many pictures and plots.
  void expect_page(std::size_t images, std::size_t charts) const {
    const auto program = *find_program("chromium");
    const std::string page = bytes_of(folder / "r.html");
    EXPECT_EQ(count_of(page, "<img "), images);
    EXPECT_EQ(count_of(page, "<svg "), charts);
    std::string probe = kProbe, messages;
    probe.replace(probe.find("PAGE"), 4,
                  base64({reinterpret_cast<const unsigned char*>(page.data()), page.size()}));
    put_bytes(folder / "probe.html", probe);
    for (const bool dark : {false, true}) {
      std::vector<std::string> arguments{"--virtual-time-budget=20000", "--dump-dom",
                                         "file://" + (folder / "probe.html").string()};
      if (dark) arguments.insert(arguments.begin(), "--blink-settings=preferredColorScheme=0");
      const std::string dom = chromium(program, folder / "profile", arguments, messages);
      for (const std::string width : {"1280", "400"}) {
        const std::string text = "[" + width + " window " + width + " overflow 0 images " +
                                 std::to_string(images) + " broken 0 charts " + std::to_string(charts) +
                                 " empty 0 faint 0 uneven 0 wide:] paper rgb(" +
                                 (dark ? "20, 23, 26" : "251, 251, 249");
        EXPECT_NE(dom.find(text), std::string::npos) << dom.substr(0, 900);
      }
    }
    const std::string address = "file://" + (folder / "r.html").string();
    chromium(program, folder / "profile", {"--dump-dom", address}, messages);
    EXPECT_EQ(messages.find("CONSOLE"), std::string::npos) << messages;

    // On paper a section takes one or two pages.
    const auto pdf = folder / "r.pdf";
    chromium(program, folder / "profile", {"--print-to-pdf=" + pdf.string(), address}, messages);
    const std::size_t pages = count_of(bytes_of(pdf), "/Type /Page\n");
    EXPECT_GE(pages, 2u);
    EXPECT_LE(pages, 2 * count_of(page, "<section"));
  }

  TemporaryFolder folder;
};

TEST_F(Browser, ShowsTexturesAndSetsSideBySide) {
  write_set(folder / "textures");
  write_mask(folder / "textures" / (std::string(120, 'w') + ".png"), 48, 2);
  const auto summary =
      write_report({.inputs = {folder / "textures"}, .out = folder / "r.html", .compare = true});
  EXPECT_EQ(summary.notes, std::vector<std::string>{});
  // Two textures with their cards, a retarget set; common plots.
  expect_page(2 * (5 + 30 + 2) + 4 + 4, 2 * 4 + 3 + 2);
}

TEST_F(Browser, ShowsVolumesAndLargePictures) {
  write_volume(folder / "textures");
  ASSERT_EQ(write_report({.inputs = {folder / "textures"}, .out = folder / "r.html", .volume = true}).volumes,
            1);
  // Four pictures, tiling, thresholds, slices, the mean of 1, 4 and 16 frames. Plots: as a texture has, in
  // time, by slice.
  expect_page(4 + 1 + 30 + 8 + 3, 6);
  write_mask(folder / "large.png", 400, 1);
  write_report({.inputs = {folder / "large.png"}, .out = folder / "r.html"});
  expect_page(5 + 30, 4);
}

TEST_F(Browser, ShowsAStudy) {
  write_study(folder.path());
  write_study_report(folder.path(), folder / "r.html");
  // The frame with and without; four methods of three pictures each.
  expect_page(2 + 12, 2);
}

}  // namespace
}  // namespace bn::report
