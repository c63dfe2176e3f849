// Protects: a study writes its files whole and the same each time, keeps its references, and refuses before
// it writes.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "bn/error.h"
#include "bn/report.h"
#include "render/scratch.h"
#include "render/test_textures.h"
#include "study/validation.h"

namespace bn {
using namespace study;
namespace {

using test::fresh_folder;

StudyOptions small_study(const std::string& scene) {
  StudyOptions options;
  options.scenes = {scene};
  options.methods = {{Method::white}, {Method::retarget}};
  options.variations = false;
  options.screen = {48, 32};
  options.frames = 3;
  options.reference_samples = 4;
  return options;
}

TEST(Study, ReferencesAreKeptAndDamagedOnesMadeAgain) {
  const auto folder = fresh_folder("references");
  const auto run = [&] {
    run_study(small_study("slow-pan"), test::proven_textures(), nullptr, folder, {.threads = 1});
    std::ifstream file(folder / "errors.csv");
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string once = run();
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "references"))
    files.push_back(entry.path());
  ASSERT_EQ(files.size(), 4u) << "a view a frame";
  const auto written = std::filesystem::last_write_time(files[0]);
  std::filesystem::resize_file(files[1], 100);
  EXPECT_EQ(run(), once);
  EXPECT_EQ(std::filesystem::last_write_time(files[0]), written);
  EXPECT_GT(std::filesystem::file_size(files[1]), 100u);
  // All frames, all regions, though the camera moves.
  EXPECT_EQ(std::count(once.begin(), once.end(), '\n'), 1 + 2 * 4 * 3);
}

TEST(Study, WritesItsFilesWholeAndTheSameEachTime) {
  const auto run = [](const std::string& folder_name) {
    const auto folder = fresh_folder(folder_name);
    StudyOptions options = small_study("poster");
    options.variations = true;
    run_study(options, test::proven_textures(), nullptr, folder, {.threads = 1});
    std::ifstream file(folder / "errors.csv");
    for (const char* name :
         {"first-frames.png", "methods.png", "blocks.png", "retarget.png", "retarget-block-4.png"})
      EXPECT_TRUE(std::filesystem::exists(folder / "poster" / name)) << name;
    EXPECT_TRUE(std::filesystem::exists(folder / "report.md"));
    // The page cuts the sheets as they were put together.
    write_study_report(folder, folder / "report.html");
    std::ifstream page_file(folder / "report.html");
    const std::string page(std::istreambuf_iterator<char>(page_file), {});
    EXPECT_EQ(page.find("not a sheet"), std::string::npos);
    EXPECT_NE(page.find("last frame, retarget-by-light: error"), std::string::npos);
    EXPECT_NE(page.find("retarget, 16 × 16: spectrum"), std::string::npos) << "blocks";
    EXPECT_NE(page.find("retarget, frame 3: error"), std::string::npos) << "first frames";
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string once = run("study_1");
  EXPECT_EQ(run("study_2"), once);
  // A header, and two methods, three more block sizes and two by light, four frames, three regions.
  EXPECT_EQ(std::count(once.begin(), once.end(), '\n'), 1 + 7 * 4 * 3);
}

TEST(Study, RefusesBeforeItWrites) {
  const auto folder = fresh_folder("refused") / "never";
  StudyOptions options;
  options.scenes = {"no-such-scene"};
  EXPECT_THROW(run_study(options, test::proven_textures(), nullptr, folder), Error);
  EXPECT_FALSE(std::filesystem::exists(folder));
}

}  // namespace
}  // namespace bn
