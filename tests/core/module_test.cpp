// Protects: a module that is not there, or that lacks what is asked of it, ends in an error that says what it is for and
// what to do; the current folder is never searched.
#include "core/module.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "bn/error.h"

namespace bn {
namespace {

ErrorInfo refusal(const std::string& module, const std::string& symbol) {
  try {
    module_symbol(module, symbol, "reading slates", "install chalk");
  } catch (const Error& error) {
    return error.info();
  }
  ADD_FAILURE() << "found " << module;
  return {};
}

TEST(Module, AMissingOneIsNamed) {
  const ErrorInfo info = refusal("bn_no_such_module", "anything");
  EXPECT_EQ(info.code, ErrorCode::io);
  EXPECT_EQ(info.where, "libbn_no_such_module.so");
  EXPECT_NE(info.what.find("reading slates needs a module"), std::string::npos) << info.what;
  EXPECT_EQ(info.remedy, "install chalk");
}

TEST(Module, TheCurrentFolderIsNotSearched) {
  std::string folder = (std::filesystem::temp_directory_path() / "bn-module-XXXXXX").string();
  ASSERT_NE(::mkdtemp(folder.data()), nullptr);
  std::ofstream(folder + "/libbn_trap.so") << "no library at all";
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder);
  const ErrorInfo info = refusal("bn_trap", "anything");
  std::filesystem::current_path(before);
  EXPECT_NE(info.what.find("is not in"), std::string::npos) << info.what;
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace bn
