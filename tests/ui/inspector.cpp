#include "ui/inspector.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>

#include "bn/bake.h"

namespace bn::ui {

Workplace::Workplace() {
  std::string name = (std::filesystem::temp_directory_path() / "bn-inspector-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  folder_ = name;
}

Workplace::~Workplace() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

Outcome Workplace::shell(const std::string& command) const {
  const std::string whole = "cd '" + folder_.string() + "' && timeout 120 sh -c '" + command + "' 2>&1";
  std::FILE* pipe = popen(whole.c_str(), "r");
  Outcome outcome;
  char block[4096];
  while (const std::size_t n = std::fread(block, 1, sizeof block, pipe)) outcome.output.append(block, n);
  const int status = pclose(pipe);
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

Outcome Workplace::script(const std::string& text, const std::string& arguments,
                          const std::string& environment) const {
  std::ofstream(folder_ / "test.script") << text;
  return shell(environment + " " BN_INSPECTOR " --headless --script test.script " + arguments);
}

std::string Workplace::as_stranger() const {
  namespace fs = std::filesystem;
  fs::permissions(folder_, fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec |
                               fs::perms::others_read | fs::perms::others_exec);
  // Root may write anywhere; others not into what is read-only.
  return geteuid() == 0 ? "HOME=/nonexistent setpriv --reuid=65534 --regid=65534 --clear-groups"
                        : "HOME=/nonexistent";
}

void Workplace::write_mask(const std::string& name, int side, std::uint64_t seed) const {
  std::filesystem::create_directories((folder_ / name).parent_path());
  MaskEntry mask;
  mask.name = "mask";
  mask.void_and_cluster = {.size = {side, side}, .seed = seed};
  mask.outputs = {{.path = (folder_ / name).string()}};
  make_entry(mask);
}

double contrast(const Image& image, Part part) {
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (int y = static_cast<int>(part.y0 * image.size.height);
       y < static_cast<int>(part.y1 * image.size.height); ++y) {
    for (int x = static_cast<int>(part.x0 * image.size.width);
         x < static_cast<int>(part.x1 * image.size.width); ++x) {
      const auto at =
          static_cast<std::size_t>(y * image.size.width + x) * static_cast<std::size_t>(image.channels);
      const double grey = static_cast<double>(image.samples[at + 1]);
      sum += grey;
      squares += grey * grey;
      count += 1.0;
    }
  }
  return std::sqrt(std::max(0.0, squares / count - sum * sum / (count * count)));
}

}  // namespace bn::ui
