#include "core/module.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include <filesystem>
#include <map>
#include <mutex>

#include "bn/error.h"

namespace bn {
namespace {

namespace fs = std::filesystem;

/// The folder of the program or shared library that this function was linked into.
fs::path own_folder() {
  Dl_info info{};
  link_map* map = nullptr;
  const bool known = ::dladdr1(reinterpret_cast<const void*>(&own_folder), &info,
                               reinterpret_cast<void**>(&map), RTLD_DL_LINKMAP) != 0;
  std::error_code failed;
  // The program itself has no name in the list of libraries.
  const bool is_program = !known || map == nullptr || map->l_name == nullptr || map->l_name[0] == '\0';
  const fs::path file = is_program ? fs::read_symlink("/proc/self/exe", failed) : fs::path(map->l_name);
  return fs::canonical(file, failed).parent_path();
}

void* loaded(const std::string& name, const std::string& purpose, const std::string& remedy) {
  const std::string file = "lib" + name + ".so";
  const fs::path folder = own_folder();
  std::string reason = fmt::format("{} is not in {}", file, folder.string());
  for (const char* const place : {".", "..", "../..", "../lib/bn"}) {
    const fs::path candidate = (folder / place / file).lexically_normal();
    std::error_code failed;
    if (!fs::is_regular_file(candidate, failed)) continue;
    if (void* const handle = ::dlopen(candidate.c_str(), RTLD_NOW | RTLD_LOCAL)) return handle;
    reason = ::dlerror();
    break;
  }
  throw Error({.code = ErrorCode::io,
               .what = fmt::format("{} needs a module that cannot be loaded: {}", purpose, reason),
               .where = file,
               .limit = "",
               .remedy = remedy});
}

}  // namespace

void* module_symbol(const std::string& name, const std::string& symbol, const std::string& purpose,
                    const std::string& remedy) {
  static std::mutex mutex;
  static std::map<std::string, void*>
      handles;  // never closed: exceptions and types of a module may outlive a call
  const std::lock_guard lock(mutex);
  void*& handle = handles[name];
  if (handle == nullptr) handle = loaded(name, purpose, remedy);
  if (void* const address = ::dlsym(handle, symbol.c_str())) return address;
  throw Error({.code = ErrorCode::io,
               .what = fmt::format("{}: the module is of another version", purpose),
               .where = "lib" + name + ".so",
               .limit = "",
               .remedy = remedy});
}

}  // namespace bn
