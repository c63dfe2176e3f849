// Protects: every verb that takes a stack of slices names what is wrong with it: a number that is missing or
// comes twice, a slice unlike the first; and takes hidden files for no slices.
#include <gtest/gtest.h>

#include "bn/noise.h"
#include "bn/texture.h"
#include "process.h"

namespace bn::tools {
namespace {

class Stacks : public testing::Test {
 protected:
  Stacks() {
    std::filesystem::create_directory(scratch_ / "s");
    for (int z = 0; z < 4; ++z) write("s_" + std::to_string(z) + ".png", 16);
  }
  void write(const std::string& name, int side) const {
    write_image(scratch_ / ("s/" + name), encode_mask(white_noise_mask({side, side}, 1), SampleType::u8), {});
  }
  void remove(const std::string& name) const { std::filesystem::remove(scratch_ / ("s/" + name)); }
  ProcessResult run(const std::vector<std::string>& arguments) const {
    return run_bn(arguments, {.folder = scratch_.path()});
  }
  /// All that judge or use the folder as one volume end with 3 and say so.
  void expect_refused(const std::string& text) const {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"spectrum", "--volume", "s"},
                                                      {"report", "--volume", "s", "-o", "r.html"},
                                                      {"retarget", "s", "--radius", "2", "-o", "t_%d.png"},
                                                      {"info", "s/s_%d.png"},
                                                      {"pack", "s", "-o", "p.ktx2"}}) {
      const ProcessResult result = run(arguments);
      EXPECT_EQ(result.exit_code, 3) << arguments[0] << ": " << result.err;
      EXPECT_NE(result.err.find(text), std::string::npos) << arguments[0] << ": " << result.err;
    }
    EXPECT_FALSE(std::filesystem::exists(scratch_ / "r.html"));
    EXPECT_FALSE(std::filesystem::exists(scratch_ / "t_0.png"));
  }

  ScratchFolder scratch_;
};

TEST_F(Stacks, AWholeOneIsTakenWhateverElseIsHidden) {
  write_bytes(scratch_ / "s/._s_1.png", "no picture");
  write_bytes(scratch_ / "s/.s_9.png", "no picture");
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"spectrum", "--volume", "s"},
                                                    {"report", "--volume", "s", "-o", "r.html"},
                                                    {"retarget", "s", "--radius", "2", "-o", "t_%d.png"},
                                                    {"info", "s"},
                                                    {"pack", "s", "-o", "p.ktx2"}}) {
    const ProcessResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 0) << arguments[0] << ": " << result.err;
    EXPECT_EQ(result.err.find("s_9"), std::string::npos) << result.err;
  }
}

TEST_F(Stacks, AreVerifiedByTheirPattern) {
  ASSERT_EQ(run({"retarget", "s", "--radius", "2", "-o", "t_%d.png"}).exit_code, 0);
  write_bytes(scratch_ / "._t_0.png", "no picture");
  for (const char* path : {"t_%d.png", "t_2.png", "."}) {
    const ProcessResult result = run({"verify", path});
    EXPECT_EQ(result.exit_code, path[0] == '.' ? 5 : 0)
        << result.out << result.err;  // in "." foreign masks too
    EXPECT_NE(result.out.find("4 of 4 tiles optimal"), std::string::npos) << result.out;
    EXPECT_EQ(result.out.find("._t_0"), std::string::npos) << result.out;
  }
  EXPECT_NE(run({"verify", "u_%d.png"}).out.find("there is no file of this name and a number"),
            std::string::npos);
}

TEST_F(Stacks, AMissingNumberIsNamed) {
  remove("s_2.png");
  expect_refused("number 2 is missing between 0 and 3");
  // To bn info a folder may be pictures that have nothing in common; it says what speaks against a volume.
  const ProcessResult folder = run({"info", "s"});
  EXPECT_EQ(folder.exit_code, 0);
  EXPECT_NE(folder.err.find("no volume: s: number 2 is missing"), std::string::npos) << folder.err;
}

TEST_F(Stacks, ASliceOfAnotherSizeIsNamedWithTheFirst) {
  write("s_3.png", 8);
  expect_refused("s/s_3.png: a slice of 8x8");
}

TEST_F(Stacks, ANumberThatComesTwiceIsNamed) {
  write("s_01.png", 16);
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"spectrum", "--volume", "s"},
                                                    {"report", "--volume", "s", "-o", "r.html"},
                                                    {"retarget", "s", "--radius", "2", "-o", "t_%d.png"}}) {
    const ProcessResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_NE(result.err.find("number 1 comes twice"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("s_01.png"), std::string::npos) << result.err;
  }
  EXPECT_NE(run({"info", "s"}).err.find("number 1 comes twice"), std::string::npos);
}

}  // namespace
}  // namespace bn::tools
