// Protects: a page that is whole without gnuplot, safe whatever files hold, the same bytes each time; errors
// before work; figures as files, or a word why there are none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <thread>

#include "bn/error.h"
#include "report/candidates.h"
#include "report/child_process.h"
#include "report/fixtures.h"
#include "report/html.h"
#include "report/plot.h"

namespace bn::report {
namespace {

TEST(Html, EscapesWhatMeansSomethingAndReplacesWhatIsNoText) {
  EXPECT_EQ(escaped("<a href=\"x\" id='y'>&"), "&lt;a href=&quot;x&quot; id=&#39;y&#39;&gt;&amp;");
  EXPECT_EQ(escaped("a\x01\x02\x7f\xc2\x85\n"), "a\uFFFD\uFFFD\uFFFD\uFFFD\n");
  EXPECT_EQ(escaped("\xff\xc0\xaf\xe2\x82"), "\uFFFD\uFFFD\uFFFD\uFFFD\uFFFD");
  EXPECT_EQ(escaped("blå 藍"), "blå 藍");
}

TEST(Html, Base64HasTheVectorsOfRfc4648) {
  const auto of = [](std::string_view text) {
    return base64({reinterpret_cast<const unsigned char*>(text.data()), text.size()});
  };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
}

TEST(Html, NumbersHaveThreeDigits) {
  EXPECT_EQ(number(0.05181), "0.0518");
  EXPECT_EQ(number(-12.34), "−12.3");
  EXPECT_EQ(number(348180), "348,180");
  EXPECT_EQ(number(2.36e-5), "0.000024");
  EXPECT_EQ(number(0.007), "0.007");
  EXPECT_EQ(number(3e-9), "&lt;\u202F0.000001");
  EXPECT_EQ(number(123456.7), "123,457");
  EXPECT_EQ(number(1e300), "1,000,000,000,000,000,000");
  EXPECT_EQ(number(std::nan("")), "–");
}

TEST(Sources, NamesAreOrderedByTheValueOfTheirNumbers) {
  EXPECT_TRUE(natural_less("slice2.png", "slice10.png"));
  EXPECT_FALSE(natural_less("slice10.png", "slice2.png"));
  EXPECT_TRUE(natural_less("a", "b"));
  EXPECT_TRUE(natural_less("a", "a1"));
  EXPECT_FALSE(natural_less("a1", "a1"));
  EXPECT_NE(natural_less("a01", "a1"), natural_less("a1", "a01"));
}

TEST(Child, IsEndedAtItsLimitAndOnRequest) {
  const auto begin = std::chrono::steady_clock::now();
  const auto late = run_child("/bin/sleep", {"100"}, "", std::chrono::milliseconds(50), {});
  EXPECT_FALSE(late.succeeded);
  EXPECT_NE(late.failure, "");
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(run_child("/bin/sleep", {"100"}, "", std::chrono::seconds(100), stop.get_token()).succeeded);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60));
}

TEST(Child, PassesMuchInputAndOutputAndReportsFailure) {
  const std::string much(3'000'000, 'x');
  EXPECT_EQ(run_child("/bin/cat", {}, much, std::chrono::seconds(60), {}).output, much);
  EXPECT_FALSE(run_child("/bin/false", {}, "", std::chrono::seconds(60), {}).succeeded);
  EXPECT_FALSE(run_child("/nowhere/at/all", {}, "", std::chrono::seconds(60), {}).succeeded);
}

TEST(Figures, StandAsFilesOrSayWhyNot) {
  TemporaryFolder folder;
  const std::string script = "set output figure('a')\nplot x linestyle 1\n";
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "", 1);
  const std::string failure = draw_figures(folder.path(), script);
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(failure.find("gnuplot is not installed"), 0u) << failure;
  // By hand then, later.
  EXPECT_NE(bytes_of(folder / kFigureScript).find(script), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.svg"));
  if (!find_program("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
  EXPECT_EQ(draw_figures(folder.path(), script), "");
  const std::string light = bytes_of(folder / "a.svg"), dark = bytes_of(folder / "a-dark.svg");
  EXPECT_NE(light.find("</svg>"), std::string::npos);
  EXPECT_NE(dark.find("</svg>"), std::string::npos);
  EXPECT_NE(light, dark);
  EXPECT_NE(draw_figures(folder.path(), "plot nothing").find("nothing"), std::string::npos);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(draw_figures(folder.path(), script, {.stop = stop.get_token()}), Error);
}

TEST(Plot, CsvQuotesNamesAndKeepsEveryDigit) {
  const Plot plot{PlotStyle::power,
                  "p",
                  "x",
                  "y",
                  {{"a \"b\", c", Role::texture, 0, {0.1, 0.2}, {1.0 / 3, std::nan("")}}}};
  EXPECT_EQ(to_csv(plot), "curve,x,y\n\"a \"\"b\"\", c\",0.1,0.3333333333333333\n\"a \"\"b\"\", c\",0.2,\n");
}

class Report : public ::testing::Test {
 protected:
  TemporaryFolder folder;
  std::string page() const { return bytes_of(folder / "r.html"); }
};

TEST_F(Report, IsWholeWithoutGnuplotAndSaysSo) {
  write_mask(folder / "mask.png", 32, 1);
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "", 1);
  const auto summary = write_report({.inputs = {folder / "mask.png"}, .out = folder / "r.html"});
  ::setenv("PATH", path.c_str(), 1);
  ASSERT_EQ(summary.notes.size(), 1u);
  EXPECT_NE(summary.notes[0].find("gnuplot"), std::string::npos);
  EXPECT_NE(page().find("gnuplot is not installed"), std::string::npos);
  EXPECT_NE(page().find("class=\"merit\""), std::string::npos);
  EXPECT_GT(count_of(page(), "<img"), 30u);
  EXPECT_EQ(count_of(page(), "<svg"), 0u);
}

TEST_F(Report, HasTheSameBytesForAnyNumberOfThreads) {
  write_set(folder.path());
  write_report({.inputs = {folder.path()}, .out = folder / "r.html", .compare = true}, {.threads = 1});
  const std::string one = page();
  write_report({.inputs = {folder.path()}, .out = folder / "r.html", .compare = true}, {.threads = 5});
  EXPECT_TRUE(one == page());
}

TEST_F(Report, LetsNothingOfAFileBecomeMarkup) {
  const std::string evil = "x<script>alert(1)</script>&\"'.png";
  Metadata metadata = mask_metadata();
  metadata.recipe = "</pre><script>alert(2)</script>";
  metadata.algorithm = "<img src=x>";
  const std::string name = "<b onclick='x'>.png";
  write_image(folder / name, mask_image(16, 1), metadata);
  put_bytes(folder / "<i>broken.png", evil);
  const auto summary = write_report({.inputs = {folder.path()}, .out = folder / "r.html"});
  EXPECT_EQ(summary.masks, 1);
  EXPECT_EQ(count_of(page(), "<script"), 0u);
  EXPECT_EQ(count_of(page(), "<b onclick"), 0u);
  EXPECT_EQ(count_of(page(), "<img src=x"), 0u);
  EXPECT_EQ(count_of(page(), "<i>broken"), 0u);
  EXPECT_GE(count_of(page(), "&lt;i&gt;broken"), 1u);
}

TEST_F(Report, NotesWhatIsUnreadableAndFailsOnlyIfAllIs) {
  put_bytes(folder / "bad.png", "no picture");
  EXPECT_THROW(write_report({.inputs = {folder / "bad.png"}, .out = folder / "r.html"}), Error);
  EXPECT_FALSE(std::filesystem::exists(folder / "r.html"));
  write_mask(folder / "mask.png", 16, 1);
  const auto summary = write_report(
      {.inputs = {folder / "bad.png", folder / "mask.png", folder / "none.png"}, .out = folder / "r.html"});
  EXPECT_EQ(summary.masks, 1);
  EXPECT_GE(summary.notes.size(), 2u);
  EXPECT_THROW(write_report({.inputs = {}, .out = folder / "r.html"}), Error);
}

TEST_F(Report, ChecksItsOutputBeforeTheWork) {
  // The input does not exist, so whoever complains of the output has looked at that first.
  for (const ReportOptions& options :
       {ReportOptions{.inputs = {folder / "none"}, .out = folder / "no/r.html"},
        ReportOptions{.inputs = {folder / "none"}, .out = folder.path()},
        ReportOptions{.inputs = {folder / "none"}, .out = folder / "r.html", .csv_dir = folder / "no/csv"}}) {
    try {
      write_report(options);
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::io);
      EXPECT_EQ(error.info().where.find("none"), std::string::npos) << error.what();
    }
  }
}

TEST_F(Report, RecomputesRetargetSetsAndFindsWhatIsWrong) {
  write_set(folder.path());
  auto summary = write_report({.inputs = {folder.path()}, .out = folder / "r.html"});
  EXPECT_EQ(summary.retarget_sets, 1);
  EXPECT_EQ(summary.failed, 0);
  EXPECT_NE(page().find("proven optimal"), std::string::npos);
  EXPECT_NE(page().find("made in 1.25 s"), std::string::npos);  // from the manifest

  FileContent content = read_image(folder / "set/atlas.png");
  content.metadata->tiles[0].energy += 1;
  write_image(folder / "set/atlas.png", content.image, *content.metadata);
  summary = write_report({.inputs = {folder.path()}, .out = folder / "r.html"});
  EXPECT_EQ(summary.failed, 1);
  EXPECT_NE(page().find("not as recorded"), std::string::npos);
}

TEST_F(Report, WritesTheCurvesAsCsv) {
  write_set(folder.path());
  write_report({.inputs = {folder.path()}, .out = folder / "r.html", .csv_dir = folder / "csv"});
  EXPECT_TRUE(bytes_of(folder / "csv/set-mask-png-power.csv")
                  .starts_with("curve,frequency_cycles_per_pixel,power\n"));
  EXPECT_EQ(count_of(bytes_of(folder / "csv/moves-energies.csv"), "\n"), 10u);  // a header and nine motions
}

TEST_F(Report, MakesTheFolderOfCurvesOnlyWhenThereAreSome) {
  EXPECT_THROW(
      write_report({.inputs = {folder / "none"}, .out = folder / "r.html", .csv_dir = folder / "csv"}),
      Error);
  EXPECT_FALSE(std::filesystem::exists(folder / "csv"));
  put_bytes(folder / "file", "");
  write_mask(folder / "mask.png", 16, 1);
  EXPECT_THROW(
      write_report({.inputs = {folder / "mask.png"}, .out = folder / "r.html", .csv_dir = folder / "file"}),
      Error);
  EXPECT_FALSE(std::filesystem::exists(folder / "r.html"));
  write_report({.inputs = {folder / "mask.png"}, .out = folder / "r.html", .csv_dir = folder / "csv/"});
  EXPECT_TRUE(std::filesystem::exists(folder / "csv"));
}

TEST_F(Report, TakesAFolderAsAVolume) {
  write_volume(folder / "slices");
  const auto summary =
      write_report({.inputs = {folder / "slices"}, .out = folder / "r.html", .volume = true});
  EXPECT_EQ(summary.volumes, 1);
  EXPECT_EQ(summary.failed, 0);
  EXPECT_EQ(summary.weak, 1);  // a plain one: the best known are far better in the fourth band
  EXPECT_NE(page().find("Spectrum in x and time"), std::string::npos);
  EXPECT_NE(page().find("<span class=\"badge weak\">weakly blue in space and time</span>"),
            std::string::npos);
}

TEST_F(Report, JudgesOnlyWhatIsOrLooksLikeNoise) {
  const auto outcome = [&](const Image& image, std::optional<Metadata> metadata = {}) {
    write_image(folder / "x.png", image, metadata.value_or(Metadata{}));
    const auto summary = write_report({.inputs = {folder / "x.png"}, .out = folder / "r.html"});
    return summary.failed == 1 ? "failed" : summary.not_judged == 1 ? "not judged" : "passed";
  };
  Image ramp{.size = {64, 64}, .channels = 1, .type = SampleType::u8, .samples = {}};
  for (int i = 0; i < 4096; ++i) {
    ramp.samples.push_back(
        static_cast<std::byte>(i % 64 * (i / 64) / 16));  // dark corners, bright ones: a picture
  }
  EXPECT_STREQ(outcome(ramp), "not judged");
  EXPECT_STREQ(outcome(ramp, mask_metadata()), "failed");  // it says it is a mask
  EXPECT_STREQ(outcome(mask_image(64, 1)), "passed");
  EXPECT_STREQ(outcome(encode_mask(white_noise_mask({64, 64}, 1), SampleType::u8)), "failed");
  EXPECT_NE(page().find(">white noise</span>"), std::string::npos);
  EXPECT_STREQ(outcome(encode_mask(bayer_mask(64), SampleType::u8)), "failed");
  // A good mask with noise added is no picture: it fails, as it does for bn spectrum.
  Image noisy = mask_image(64, 1);
  const auto noise = white_noise_mask({64, 64}, 9);
  for (std::size_t i = 0; i < noisy.samples.size(); ++i) {
    const int value = std::to_integer<int>(noisy.samples[i]) + static_cast<int>(noise[i] % 41) - 20;
    noisy.samples[i] = static_cast<std::byte>(std::clamp(value, 0, 255));
  }
  EXPECT_STREQ(outcome(noisy), "failed");
}

TEST_F(Report, GivesTheReasonOfEveryVerdict) {
  Image gamma = mask_image(64, 1);
  for (std::byte& sample : gamma.samples) {
    sample =
        static_cast<std::byte>(std::lround(255 * std::pow(std::to_integer<int>(sample) / 255.0, 1 / 2.2)));
  }
  write_image(folder / "gamma.png", gamma, {});
  Image photo{.size = {64, 64}, .channels = 1, .type = SampleType::u8, .samples = {}};
  for (int i = 0; i < 4096; ++i) photo.samples.push_back(static_cast<std::byte>(i % 64 * (i / 64) / 16));
  write_image(folder / "photo.png", photo, {});
  write_image(folder / "tiny.png", encode_mask(bayer_mask(2), SampleType::u8), {});
  write_report({.inputs = {folder.path()}, .out = folder / "r.html"});
  EXPECT_NE(page().find("<li>looks gamma-encoded, exponent .45 (1/2.2)</li>"), std::string::npos);
  EXPECT_NE(page().find("<li>not judged: it does not say that it is a mask, and it looks like a picture"),
            std::string::npos);
  EXPECT_NE(page().find("<li>2 x 2 pixels have no frequency"), std::string::npos);
  EXPECT_EQ(page().find(">nan"), std::string::npos);
}

TEST_F(Report, ComparesTheChannelsOfAFile) {
  const Image a = mask_image(64, 1), b = mask_image(64, 2);
  const auto write = [&](const std::string& name, const auto& sample) {
    Image image{.size = {64, 64}, .channels = 3, .type = SampleType::u8, .samples = {}};
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        for (int c = 0; c < 3; ++c) image.samples.push_back(sample(x, y, c));
      }
    }
    write_image(folder / name, image, {});
    return write_report({.inputs = {folder / name}, .out = folder / "r.html"});
  };
  const auto at = [](const Image& image, int x, int y) {
    return image.samples[static_cast<std::size_t>(wrap(y, 64) * 64 + wrap(x, 64))];
  };
  auto summary =
      write("moved.png", [&](int x, int y, int c) { return c == 1 ? at(b, x, y) : at(a, x + 3 * c, y); });
  EXPECT_EQ(summary.failed, 1);
  EXPECT_NE(page().find("<li>is channel 0 moved by (-6, 0)</li>"), std::string::npos);
  EXPECT_NE(page().find("Independent of the channels before it"), std::string::npos);
  summary = write("grey.png", [&](int x, int y, int) { return at(a, x, y); });
  EXPECT_EQ(summary.masks, 1);
  ASSERT_EQ(summary.notes.size(), 1u);
  EXPECT_NE(summary.notes[0].find("grey stored as colour"), std::string::npos);
  summary = write("constant.png",
                  [&](int x, int y, int c) { return c == 2 ? std::byte{7} : at(c == 0 ? a : b, x, y); });
  EXPECT_EQ(summary.masks, 2);
  ASSERT_EQ(summary.notes.size(), 1u);
  EXPECT_NE(summary.notes[0].find("channel 2 is constant (every value is 7)"), std::string::npos);
}

TEST_F(Report, HiddenFilesAreNoTexturesAndABadSliceIsNamed) {
  write_volume(folder / "slices");
  put_bytes(folder / "slices/._slice0.png", "no picture");
  write_mask(folder / "slices/.slice3.png", 32, 1);
  auto summary = write_report({.inputs = {folder / "slices"}, .out = folder / "r.html", .volume = true});
  EXPECT_EQ(summary.volumes, 1);
  EXPECT_TRUE(summary.notes.empty());
  EXPECT_NE(page().find("32 × 32 × 16"), std::string::npos);
  put_bytes(folder / "slices/slice7.png", "no picture");
  try {
    write_report({.inputs = {folder / "slices"}, .out = folder / "r.html", .volume = true});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("slice7.png"), std::string::npos) << error.what();
  }
}

TEST_F(Report, FindsFilesOfEveryFormatThatIsRead) {
  const Image mask = encode_mask(void_and_cluster({.size = {32, 32}}), SampleType::u8);
  std::string bytes(reinterpret_cast<const char*>(mask.samples.data()), mask.samples.size());
  put_bytes(folder / "a.pgm", "P5 32 32 255\n" + bytes);
  for (char& c : bytes) c = static_cast<char>(c < 0 ? 0 : 1);
  std::string bits;
  for (std::size_t i = 0; i < bytes.size(); i += 8) {
    int byte = 0;
    for (std::size_t k = 0; k < 8; ++k) byte = 2 * byte + bytes[i + k];
    bits += static_cast<char>(byte);
  }
  put_bytes(folder / "b.pbm", "P4 32 32\n" + bits);
  EXPECT_EQ(write_report({.inputs = {folder.path()}, .out = folder / "r.html"}).masks, 2);
}

TEST_F(Report, SortsItsTableWithoutAScript) {
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    write_mask(folder / ("m" + std::to_string(seed) + ".png"), 32, seed);
  }
  write_report({.inputs = {folder.path()}, .out = folder / "r.html", .compare = true});
  EXPECT_EQ(count_of(page(), "<script"), 0u);
  EXPECT_EQ(count_of(page(), "class=\"overview\""), 1u);
  EXPECT_EQ(count_of(page(), "<input type=\"radio\""), 11u);
  for (int place = 1; place <= 9; ++place) {
    EXPECT_EQ(count_of(page(), "--o2:" + std::to_string(place) + ";"), 1u) << "by grade";
  }
  EXPECT_NE(page().find("4 others"), std::string::npos) << "nine curves are five in colour and a grey band";
}

}  // namespace
}  // namespace bn::report
