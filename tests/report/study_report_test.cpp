// Protects: the page of a validation study. It shows what the study's files say and nothing else, and names
// the file that is no study's.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "bn/error.h"
#include "bn/report.h"
#include "bn/texture.h"

namespace bn {
namespace {

class StudyReport : public testing::Test {
 protected:
  StudyReport() : folder_(std::filesystem::path(testing::TempDir()) / "bn_study_report") {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "room");
    write("summary.csv",
          "scene,variant,region,db_against_white\nroom,white,picture,0.00\nroom,sort,picture,-3.25\n");
    write("errors.csv",
          "scene,variant,frame,region,rmse,power_to_0.1,reference_power_to_0.1\n"
          "room,white,0,picture,0.5,0.25,0.001\nroom,white,1,picture,0.5,0.25,0.001\n"
          "room,sort,0,picture,0.5,0.25,0.001\nroom,sort,1,picture,0.5,0.1,0.001\n");
    write("radial.csv",
          "scene,variant,frame,region,frequency,power\nroom,sort,1,picture,0.1,0.1\nroom,sort,1,picture,0.2,"
          "0.3\n");
    write("passes.csv",
          "scene,variant,pass,milliseconds,percent_of_frame,bytes\nroom,reproject,trace,12.5,80,2048\n");
    Image sheet{.size = {4, 2}, .channels = 3, .type = SampleType::u8, .samples = {}};
    sheet.samples.resize(24);
    write_image(folder_ / "room" / "methods.png", sheet, {});
  }

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
  for (const char* part : {"<h2>room</h2>", ">-3.2<", "<title>Validation</title>", "data:image/png;base64,",
                           "12.50 ms", "80.0 %", "2 KiB", "white, sort"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
  EXPECT_EQ(html.find("http://"), std::string::npos) << "the page loads nothing";
  EXPECT_EQ(html, page()) << "equal files, equal bytes";
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
  std::filesystem::remove(folder_ / "summary.csv");
  EXPECT_EQ(refusal(), ErrorCode::io);
}

}  // namespace
}  // namespace bn
