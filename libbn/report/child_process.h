// A program run to its end: no shell, fixed environment, a time limit.

#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace bn::report {

/// The first executable file called `name` in the absolute folders of PATH. An empty part of PATH, which to a
/// shell is the current folder, is passed over.
std::optional<std::filesystem::path> find_program(std::string_view name);

struct ChildResult {
  bool succeeded = false;  ///< ended by itself with exit code 0
  std::string failure;     ///< else why, in words, with the last line of its stderr
  std::string output;      ///< its stdout
  std::string errors;      ///< its stderr
};

/// Runs `program` in `folder` ("" for the current one) with `input` as its stdin. Its locale is C whatever
/// ours is. Killed at the limit or when `stop` is requested, with every process it has started.
ChildResult run_child(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                      std::string_view input, std::chrono::milliseconds limit, std::stop_token stop,
                      const std::filesystem::path& folder = {});

}  // namespace bn::report
