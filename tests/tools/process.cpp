#include "process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace bn::tools {
namespace {

// Generous: the sanitizer builds run the same tests. Reached only by a hang.
constexpr auto kTimeout = std::chrono::seconds(120);

}  // namespace

Process::Process(const std::vector<std::string>& arguments, const ProcessSetup& setup)
    : deadline_(std::chrono::steady_clock::now() + kTimeout) {
  std::vector<std::string> words{BN_BINARY};
  words.insert(words.end(), arguments.begin(), arguments.end());
  if (!setup.shell_prefix.empty()) {
    const std::vector<std::string> shell{"/bin/sh", "-c", setup.shell_prefix + "; exec \"$@\"", "sh"};
    words.insert(words.begin(), shell.begin(), shell.end());
  }
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  int out[2], err[2];
  if (::pipe2(out, O_CLOEXEC) != 0 || ::pipe2(err, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, setup.folder.c_str());
  posix_spawn_file_actions_adddup2(&actions, err[1], STDERR_FILENO);
  if (setup.stdout_closed) {
    posix_spawn_file_actions_addclose(&actions, STDOUT_FILENO);
  } else if (!setup.stdout_to.empty()) {
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, setup.stdout_to.c_str(), O_WRONLY, 0);
  } else {
    posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
  }
  const int failure = ::posix_spawn(&pid_, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(out[1]);
  ::close(err[1]);
  out_ = out[0];
  err_ = err[0];
  if (failure != 0) throw std::runtime_error("cannot start " + words.front());
}

Process::~Process() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    wait();
  }
}

/// Reads what there is on either stream; false when both have ended.
bool Process::read_some() {
  pollfd polled[2] = {{out_, POLLIN, 0}, {err_, POLLIN, 0}};
  if (out_ < 0 && err_ < 0) return false;
  const auto left = deadline_ - std::chrono::steady_clock::now();
  const auto milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(left).count();
  if (milliseconds <= 0 || ::poll(polled, 2, static_cast<int>(milliseconds)) == 0) {
    ADD_FAILURE() << "bn hangs; so far it said: " << result_.out << result_.err;
    ::kill(pid_, SIGKILL);
    deadline_ += kTimeout;
    return true;
  }
  char buffer[4096];
  for (auto [stream, events, text] : {std::tuple{&out_, polled[0].revents, &result_.out},
                                      std::tuple{&err_, polled[1].revents, &result_.err}}) {
    if (events == 0 || *stream < 0) continue;
    const ssize_t count = ::read(*stream, buffer, sizeof buffer);
    if (count > 0) {
      text->append(buffer, static_cast<std::size_t>(count));
    } else {
      ::close(*stream);
      *stream = -1;
    }
  }
  return true;
}

bool Process::wait_for_message(const std::string& text) {
  while (result_.err.find(text) == std::string::npos) {
    if (!read_some()) return false;
  }
  return true;
}

void Process::send(int signal) { ::kill(pid_, signal); }

void Process::close_output() {
  ::close(out_);
  out_ = -1;
}

ProcessResult Process::wait() {
  while (read_some()) {
  }
  int status = 0;
  ::waitpid(pid_, &status, 0);
  pid_ = -1;
  if (WIFEXITED(status)) result_.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result_.signal = WTERMSIG(status);
  return result_;
}

ProcessResult run_bn(const std::vector<std::string>& arguments, const ProcessSetup& setup) {
  return Process(arguments, setup).wait();
}

ScratchFolder::ScratchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "bn-test-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file.good()) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    names.push_back(std::filesystem::relative(entry.path(), folder).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace bn::tools
