// How long short commands take as whole processes, beside a program that does nothing: bench_startup BN
// [RUNS]. Prints the median of the wall times, the largest resident memory, and the median as a multiple of
// /bin/true's. Commands take turns, so that what else the machine does hits them alike.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fcntl.h>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

struct Command {
  std::vector<std::string> words;
  std::vector<double> milliseconds = {};
  long most_kib = 0;
};

void run(Command& command) {
  std::vector<char*> arguments;
  for (std::string& word : command.words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = ::fork();
  if (child == 0) {
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, 1);
    ::dup2(nowhere, 2);
    ::execv(arguments[0], arguments.data());
    ::_exit(127);
  }
  int status = 0;
  rusage used{};
  ::wait4(child, &status, 0, &used);
  command.milliseconds.push_back(
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  command.most_kib = std::max(command.most_kib, used.ru_maxrss);
  if (status != 0) std::fprintf(stderr, "%s ends with status %d\n", command.words[0].c_str(), status);
}

}  // namespace

int main(int count, char** words) {
  if (count < 2) return std::fprintf(stderr, "bench_startup BN [RUNS]\n"), 1;
  const std::string bn = words[1];
  const int runs = count > 2 ? std::atoi(words[2]) : 51;
  const std::string folder = "/tmp/bn-startup-" + std::to_string(::getpid());
  std::vector<Command> commands = {
      {{"/bin/true"}},
      {{bn, "--version"}},
      {{bn, "help"}},
      {{bn, "noise", "void-and-cluster", "--size", "64x64", "-o", folder + ".png"}},
      {{bn, "noise", "void-and-cluster", "--size", "64x64", "-o", folder + ".exr"}}};
  for (int i = 0; i < runs; ++i) {
    for (Command& command : commands) run(command);
  }
  double nothing = 0.0;
  for (Command& command : commands) {
    std::sort(command.milliseconds.begin(), command.milliseconds.end());
    const double median = command.milliseconds[command.milliseconds.size() / 2];
    if (nothing == 0.0) nothing = median;
    std::string line;
    for (const std::string& word : command.words) line += word.substr(word.rfind('/') + 1) + " ";
    std::printf("%8.1f ms %6.1f MiB %6.1f x  %s\n", median, static_cast<double>(command.most_kib) / 1024.0,
                median / nothing, line.c_str());
  }
  ::unlink((folder + ".png").c_str());
  ::unlink((folder + ".exr").c_str());
}
