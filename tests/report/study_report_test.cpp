// Protects: the page of a validation study. It shows what the study's files say and nothing else, and names
// the file that is no study's.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "bn/error.h"
#include "bn/report.h"
#include "bn/texture.h"
#include "report/fixtures.h"

namespace bn::report {
namespace {

class StudyReport : public testing::Test {
 protected:
  StudyReport() : folder_(std::filesystem::path(testing::TempDir()) / "bn_study_report") {
    std::filesystem::remove_all(folder_);
    write_study(folder_);
  }

  void write_picture(const std::string& name, Extent size) { write_blank(folder_ / "room" / name, size); }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }

  std::string page() {
    write_study_report(folder_, folder_ / "report.html");
    std::ifstream file(folder_ / "report.html");
    return std::string(std::istreambuf_iterator<char>(file), {});
  }

  ErrorCode refusal() {
    try {
      page();
    } catch (const Error& error) {
      EXPECT_FALSE(std::filesystem::exists(folder_ / "report.html"));
      return error.code();
    }
    ADD_FAILURE() << "not refused";
    return ErrorCode::usage;
  }

  std::filesystem::path folder_;
};

TEST_F(StudyReport, ShowsScenesFiguresPicturesAndCosts) {
  const std::string html = page();
  for (const char* part :
       {"<h2>room</h2>", "<title>Validation</title>", "12.50 ms", "80.0 %", "2 KiB", "A room &amp; a lamp.",
        "a &lt;device&gt;", "64 paths a pixel", ">0.125<", ">0.06<"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
  EXPECT_EQ(html.find("http://"), std::string::npos) << "the page loads nothing";
  EXPECT_EQ(html, page()) << "equal files, equal bytes";
}

TEST_F(StudyReport, NamesTheBestAndExplainsEqualRows) {
  const std::string html = page();
  for (const char* part :
       {"Best in the whole picture: retarget, \u22129.0 dB",
        "Within the scatter of about 1 dB of it: reproject.", "<b class=\"best\">\u22129.0</b>",
        "The rows of retarget and reproject are the same.", "Nothing moves here",
        "retarget with the tile for the picture&#39;s motion"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
  EXPECT_EQ(html.find("<b class=\"best\">0.5</b>"), std::string::npos) << "all RMSE are equal";
}

TEST_F(StudyReport, AGainWithinTheScatterIsNone) {
  write("summary.csv",
        "scene,variant,region,db_against_white\nroom,white,picture,0.00\nroom,sort,picture,-0.90\n");
  const std::string html = page();
  EXPECT_NE(html.find("no method leaves less"), std::string::npos);
  EXPECT_EQ(html.find("Best in"), std::string::npos);
  EXPECT_NE(html.find("With retarget:"), std::string::npos) << "to be looked at all the same";
}

TEST_F(StudyReport, EachPictureStandsBesideItsMethod) {
  const std::string html = page();
  for (const char* part : {"<figcaption>sort</figcaption>", "last frame, sort: spectrum of the error",
                           "Without:</b> white noise", "With retarget:</b>"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
  // A sheet of another division is named, not shown askew.
  write_picture("methods.png", {500, 340});
  const std::string other = page();
  EXPECT_EQ(other.find("<figcaption>sort</figcaption>"), std::string::npos);
  EXPECT_NE(other.find("not a sheet of 4 columns and 3 rows"), std::string::npos);
}

TEST_F(StudyReport, RefusesWhatIsNoStudy) {
  write("summary.csv", "scene,variant,region\nroom,white,picture\n");
  EXPECT_EQ(refusal(), ErrorCode::invalid_input) << "a column is missing";
  write("summary.csv", "scene,variant,region,db_against_white\nroom,white,picture\n");
  EXPECT_EQ(refusal(), ErrorCode::invalid_input) << "a cell is missing";
  write("summary.csv", "scene,variant,region,db_against_white\nroom,white,picture,much\n");
  EXPECT_EQ(refusal(), ErrorCode::invalid_input) << "no number";
  write("summary.csv", "scene,variant,region,db_against_white\n../room,white,picture,0\n");
  EXPECT_EQ(refusal(), ErrorCode::invalid_input) << "a path for a name";
  write("summary.csv", "scene,variant,region,db_against_white\nhall,white,picture,0\n");
  EXPECT_EQ(refusal(), ErrorCode::invalid_input) << "a scene that study.json lacks";
  write("summary.csv", "scene,variant,region,db_against_white\nroom,a/b,picture,0\n");
  EXPECT_EQ(refusal(), ErrorCode::invalid_input) << "a path for a method";
  std::filesystem::remove(folder_ / "summary.csv");
  EXPECT_EQ(refusal(), ErrorCode::io);
  write("study.json", "{}");
  write("summary.csv", "scene,variant,region,db_against_white\n");
  EXPECT_EQ(refusal(), ErrorCode::invalid_input) << "no study.json that says anything";
}

}  // namespace
}  // namespace bn::report
