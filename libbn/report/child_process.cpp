// Running another program.
//
// Its three streams are files in memory, so that no pipe can fill up and block either side, and waiting is
// all that is left to do. It gets a process group of its own: a kill reaches what it may have started, and
// Ctrl-C at the terminal reaches us alone, who end it.

#include "report/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <thread>

#include "bn/error.h"

namespace bn::report {
namespace {

[[noreturn]] void fail(std::string_view what, int error) {
  throw Error({.code = ErrorCode::io,
               .what = fmt::format("{}: {}", what, std::generic_category().message(error)),
               .where = "running a program",
               .limit = "",
               .remedy = ""});
}

/// A file that exists in memory only.
class MemoryFile {
 public:
  explicit MemoryFile(const char* name) : fd_(::memfd_create(name, MFD_CLOEXEC)) {
    if (fd_ < 0) fail("no file in memory", errno);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(fd_); }

  int get() const { return fd_; }

  void fill(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t written = ::write(fd_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) fail("cannot write to a file in memory", errno);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    ::lseek(fd_, 0, SEEK_SET);
  }

  std::string content() const {
    const off_t size = ::lseek(fd_, 0, SEEK_END);
    std::string bytes(static_cast<std::size_t>(std::max<off_t>(size, 0)), '\0');
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t got = ::pread(fd_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) break;
      done += static_cast<std::size_t>(got);
    }
    bytes.resize(done);
    return bytes;
  }

 private:
  int fd_;
};

std::string last_line(const std::string& text) {
  const auto end = text.find_last_not_of(" \n");
  if (end == std::string::npos) return {};
  const auto begin = text.find_last_of('\n', end);
  return text.substr(begin == std::string::npos ? 0 : begin + 1,
                     end - (begin == std::string::npos ? 0 : begin));
}

}  // namespace

std::optional<std::filesystem::path> find_program(std::string_view name) {
  const char* variable = std::getenv("PATH");
  std::string_view rest = variable == nullptr ? "" : variable;
  while (!rest.empty()) {
    const auto end = std::min(rest.find(':'), rest.size());
    const std::filesystem::path folder(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (!folder.is_absolute()) continue;
    const auto candidate = folder / name;
    struct stat status = {};
    if (::stat(candidate.c_str(), &status) == 0 && S_ISREG(status.st_mode) &&
        ::access(candidate.c_str(), X_OK) == 0) {
      return candidate;
    }
  }
  return std::nullopt;
}

ChildResult run_child(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                      std::string_view input, std::chrono::milliseconds limit, std::stop_token stop,
                      const std::filesystem::path& folder) {
  const MemoryFile in("stdin"), out("stdout"), err("stderr");
  in.fill(input);
  std::string name = program.string();
  std::vector<std::string> words = arguments;
  std::vector<char*> argv{name.data()};
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  char locale[] = "LC_ALL=C", path[] = "PATH=/usr/bin:/bin";
  char* environment[] = {locale, path, nullptr};

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in.get(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out.get(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.get(), STDERR_FILENO);
  if (!folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t child = 0;
  const int error = ::posix_spawn(&child, name.c_str(), &actions, &attributes, argv.data(), environment);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  ChildResult result;
  if (error != 0) {
    result.failure = fmt::format("cannot be started: {}", std::generic_category().message(error));
    return result;
  }

  const auto deadline = std::chrono::steady_clock::now() + limit;
  bool killed = false;
  int status = 0;
  while (true) {
    const pid_t ended = ::waitpid(child, &status, killed ? 0 : WNOHANG);
    if (ended == child) break;
    if (ended < 0 && errno != EINTR) fail("cannot wait for it", errno);
    if (!killed && (stop.stop_requested() || std::chrono::steady_clock::now() >= deadline)) {
      ::kill(-child, SIGKILL);
      killed = true;
      continue;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  result.output = out.content();
  result.errors = err.content();
  const std::string said = last_line(result.errors);
  if (killed) {
    result.failure = fmt::format("took more than {} s", std::chrono::duration<double>(limit).count());
  } else if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    result.failure = WIFEXITED(status) ? fmt::format("ended with exit code {}", WEXITSTATUS(status))
                                       : fmt::format("ended by signal {}", WTERMSIG(status));
    if (!said.empty()) result.failure += ": " + said;
  } else {
    result.succeeded = true;
  }
  return result;
}

}  // namespace bn::report
