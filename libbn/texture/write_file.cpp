// Crash-safe writing: a reader, or a power cut, finds the old file or the new one, never a mixture,
// and a writer that is killed leaves no litter.
//
// The bytes go to a temporary in the same folder (a rename is atomic only within one file system),
// are flushed to disk, and then the temporary is renamed onto the target. Where the file system can
// (O_TMPFILE) the temporary has no name while it is written, so whatever kills the writer, the kernel
// takes the bytes away; it gets a name only for the moment before the rename. Elsewhere (NFS and some
// others) it has a name from the start.
//
// So a killed writer may leave a named temporary, rarely or elsewhere, and the next write to the same
// target removes it. Telling a dead temporary from a live one: a writer holds a lock (flock) on its
// temporary as long as that has a name, and the kernel drops the lock with the writer. Process ids would
// not do: they mean nothing across the machines or containers that share a folder.
//
// A file that is replaced keeps its permissions: they are set before the first byte is written, so that a
// private file is at no moment readable by others.
//
// fsync() reports every error of the writes before it, so the result of close(), which must come after
// the rename for the lock's sake, has nothing to add.

#include "texture/write_file.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "texture/error.h"

namespace bn::texture {
namespace {

constexpr std::string_view kSuffix = ".bn-tmp";

[[noreturn]] void fail(const std::string& where, std::string_view what, int error) {
  const char* remedy = "";
  if (error == ENOSPC || error == EDQUOT)
    remedy = "free some space or write elsewhere; the old file, if any, is intact";
  if (error == EFBIG) remedy = "raise the limit on file sizes (ulimit -f)";
  if (error == EACCES || error == EPERM || error == EROFS) remedy = "choose a folder you may write to";
  if (error == ENOENT || error == ENOTDIR) remedy = "create the folder first";
  fail_io(where, fmt::format("{}: {}", what, std::generic_category().message(error)), remedy);
}

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  int get() const { return fd_; }

 private:
  int fd_;
};

/// Repeats a call that a signal interrupted.
template <class Call>
auto uninterrupted(Call call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

/// What every temporary of `target` begins with. Cut so that the whole name stays below 255 bytes.
std::string temporary_prefix(const std::filesystem::path& target) {
  return fmt::format(".{}.", target.filename().string().substr(0, 200));
}

std::string temporary_name(const std::filesystem::path& target) {
  std::uint64_t random = 0;
  if (::getrandom(&random, sizeof random, 0) != sizeof random)
    fail(target.string(), "no random number", errno);
  return fmt::format("{}{:016x}{}", temporary_prefix(target), random, kSuffix);
}

/// Removes temporaries whose writer is gone. Nothing depends on it, so failures are no errors.
void sweep(int folder, const std::filesystem::path& target, const FileCalls& calls) {
  const int copy =
      uninterrupted([&] { return calls.open(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC, 0); });
  if (copy < 0) return;
  const std::unique_ptr<DIR, int (*)(DIR*)> listing(::fdopendir(copy), ::closedir);
  if (!listing) {
    ::close(copy);
    return;
  }
  const std::string prefix = temporary_prefix(target);
  while (const dirent* entry = ::readdir(listing.get())) {
    const std::string_view name = entry->d_name;
    if (name.size() != prefix.size() + 16 + kSuffix.size() || !name.starts_with(prefix) ||
        !name.ends_with(kSuffix)) {
      continue;
    }
    const Descriptor found(
        calls.open(folder, entry->d_name, O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0));
    if (found.get() >= 0 && ::flock(found.get(), LOCK_EX | LOCK_NB) == 0) calls.unlink(folder, entry->d_name);
  }
}

/// A new, locked, empty file in `folder`. Its name, if it has one, goes when this object goes.
class Temporary {
 public:
  Temporary(int folder, const std::filesystem::path& target, const FileCalls& calls)
      : folder_(folder), target_(target), calls_(calls) {
    if (open_unnamed()) return;
    while (!open_named()) {
    }
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() {
    if (!name_.empty()) calls_.unlink(folder_, name_.c_str());
  }

  int get() const { return file_.get(); }

  void take_permissions_of_target() {
    struct stat old = {}, own = {};
    if (::stat(target_.c_str(), &old) != 0 || ::fstat(get(), &own) != 0) return;
    constexpr mode_t kPermissions = 0777;
    if ((old.st_mode & kPermissions) == (own.st_mode & kPermissions)) return;
    if (uninterrupted([&] { return calls_.chmod(get(), old.st_mode & kPermissions); }) != 0)
      fail(target_.string(), "its permissions cannot be kept", errno);
  }

  void rename_to_target() {
    if (name_.empty()) {
      const std::string name = temporary_name(target_);
      if (calls_.link(get(), folder_, name.c_str()) != 0) fail(target_.string(), "cannot be written", errno);
      name_ = name;
    }
    if (calls_.rename(folder_, name_.c_str(), target_.filename().c_str()) != 0) {
      fail(target_.string(), "cannot be replaced", errno);
    }
    name_.clear();
  }

 private:
  bool open_unnamed() {
    // An unnamed file gets its name through /proc; some sandboxes have none.
    if (::access("/proc/self/fd", X_OK) != 0) return false;
    file_ = Descriptor(
        uninterrupted([&] { return calls_.open(folder_, ".", O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666); }));
    if (get() < 0) {
      // What file systems and old kernels without O_TMPFILE answer.
      if (errno == EOPNOTSUPP || errno == EISDIR || errno == EINVAL || errno == ENOENT) return false;
      fail(target_.string(), "cannot be written", errno);
    }
    lock();
    return true;
  }

  /// False if another writer's sweep was quicker than our lock.
  bool open_named() {
    const std::string name = temporary_name(target_);
    constexpr int kFlags = O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC;
    file_ = Descriptor(uninterrupted([&] { return calls_.open(folder_, name.c_str(), kFlags, 0666); }));
    if (get() < 0) fail(target_.string(), "cannot be written", errno);
    lock();
    struct stat status = {};
    if (::fstat(get(), &status) == 0 && status.st_nlink == 0) return false;
    name_ = name;
    return true;
  }

  /// File systems that cannot lock do not sweep either (the same call fails), so this may fail.
  void lock() {
    uninterrupted([&] { return ::flock(get(), LOCK_EX); });
  }

  int folder_;
  const std::filesystem::path& target_;
  const FileCalls& calls_;
  Descriptor file_{-1};
  std::string name_;
};

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

}  // namespace

const FileCalls& FileCalls::system() {
  static const FileCalls calls{
      .open = [](int folder, const char* name, int flags,
                 mode_t mode) { return ::openat(folder, name, flags, mode); },
      .write = ::write,
      .fsync = ::fsync,
      .chmod = ::fchmod,
      .link =
          [](int file, int folder, const char* name) {
            const std::string unnamed = fmt::format("/proc/self/fd/{}", file);
            return ::linkat(AT_FDCWD, unnamed.c_str(), folder, name, AT_SYMLINK_FOLLOW);
          },
      .rename = [](int folder, const char* from,
                   const char* to) { return ::renameat(folder, from, folder, to); },
      .unlink = [](int folder, const char* name) { return ::unlinkat(folder, name, 0); },
  };
  return calls;
}

std::filesystem::path check_replaceable(const std::filesystem::path& path) {
  if (!path.has_filename()) fail_io(path.string(), "not the name of a file");
  std::filesystem::path target = path;
  std::error_code error;
  struct stat status = {};
  // Before a link is followed: what /dev/stdout leads to may have no name.
  if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
    if (S_ISDIR(status.st_mode)) fail_io(path.string(), "is a folder", "choose another name");
    fail_io(path.string(), "exists and is not a regular file, and pipes and devices are not written to",
            "write to a file; it appears when it is whole");
  }
  if (std::filesystem::is_symlink(path, error)) {
    target = std::filesystem::canonical(path, error);
    if (error) fail_io(path.string(), "a symbolic link to nothing", "remove the link");
  }
  const std::filesystem::path folder = folder_of(target);
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    fail(path.string(), fmt::format("folder '{}' cannot be written to", folder.string()), errno);
  }
  if (::stat(target.c_str(), &status) != 0 && errno != ENOENT)
    fail(path.string(), "cannot be written", errno);
  return target;
}

void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes, const FileCalls& calls) {
  const std::filesystem::path target = check_replaceable(path);
  const std::string where = path.string();
  const Descriptor folder(uninterrupted([&] {
    return calls.open(AT_FDCWD, folder_of(target).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC, 0);
  }));
  if (folder.get() < 0) fail(where, "its folder cannot be opened", errno);
  sweep(folder.get(), target, calls);

  Temporary temporary(folder.get(), target, calls);
  temporary.take_permissions_of_target();
  while (!bytes.empty()) {
    const ssize_t written =
        uninterrupted([&] { return calls.write(temporary.get(), bytes.data(), bytes.size()); });
    if (written <= 0) fail(where, "cannot be written", written < 0 ? errno : ENOSPC);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  if (uninterrupted([&] { return calls.fsync(temporary.get()); }) != 0)
    fail(where, "cannot be flushed to disk", errno);
  temporary.rename_to_target();

  // EINVAL: a file system that does not flush folders.
  if (uninterrupted([&] { return calls.fsync(folder.get()); }) != 0 && errno != EINVAL) {
    fail(where, "is written, but its folder cannot be flushed to disk", errno);
  }
}

}  // namespace bn::texture
