// Runs the real `bn` as a user's shell does, and keeps what it says.

#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace bn::tools {

struct ProcessSetup {
  std::filesystem::path folder = ".";  ///< current folder of the process
  std::string stdout_to = {};          ///< a path instead of the pipe, for example "/dev/full"
  bool stdout_closed = false;
  std::string shell_prefix = {};  ///< shell commands before it, for example "ulimit -f 8"
};

struct ProcessResult {
  int exit_code = -1;  ///< -1: ended by a signal
  int signal = 0;
  std::string out;
  std::string err;
};

/// A running `bn`. A process that outlives kTimeout is killed and the test fails.
class Process {
 public:
  explicit Process(const std::vector<std::string>& arguments, const ProcessSetup& setup = {});
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Waits until stderr contains `text`; false if it ended without.
  bool wait_for_message(const std::string& text);
  void send(int signal);
  /// Closes our end of its stdout, as `| head -1` does.
  void close_output();
  ProcessResult wait();

 private:
  bool read_some();

  pid_t pid_ = -1;
  int out_ = -1;
  int err_ = -1;
  std::chrono::steady_clock::time_point deadline_;
  ProcessResult result_;
};

/// Runs `bn arguments` to its end.
ProcessResult run_bn(const std::vector<std::string>& arguments, const ProcessSetup& setup = {});

/// An empty folder for one test; removed with everything in it at the end.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string read_bytes(const std::filesystem::path& path);
void write_bytes(const std::filesystem::path& path, const std::string& bytes);
/// Names of everything in and below `folder`, sorted, also hidden ones.
std::vector<std::string> names_in(const std::filesystem::path& folder);

}  // namespace bn::tools
