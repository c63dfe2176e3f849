#include "bake/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "bn/error.h"

namespace bn::baking {

FolderLock::FolderLock(const std::filesystem::path& folder)
    : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (folder_ < 0) {
    throw Error({.code = ErrorCode::io,
                 .what = std::string("cannot be opened: ") + std::strerror(errno),
                 .where = folder.string(),
                 .limit = "",
                 .remedy = ""});
  }
  if (::flock(folder_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) {
    return;  // or a file system without locks, where one cannot be asked for
  }
  ::close(folder_);
  throw Error({.code = ErrorCode::io,
               .what = "another bake is writing into this folder",
               .where = folder.string(),
               .limit = "",
               .remedy = "wait for it to end, or name another folder with --out"});
}

FolderLock::~FolderLock() { ::close(folder_); }

}  // namespace bn::baking
