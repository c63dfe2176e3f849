// Crash-safe writing of one file.

#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <span>

namespace bn::texture {

/// The system calls that write_file() makes, with POSIX results and errno; folders are descriptors.
/// Tests put failing ones in their place.
struct FileCalls {
  int (*open)(int folder, const char* name, int flags, mode_t mode);
  ssize_t (*write)(int file, const void* bytes, std::size_t count);
  int (*fsync)(int file);
  int (*chmod)(int file, mode_t mode);
  int (*link)(int file, int folder, const char* name);  ///< gives a file opened with O_TMPFILE a name
  int (*rename)(int folder, const char* from, const char* to);
  int (*unlink)(int folder, const char* name);

  static const FileCalls& system();
};

/// Throws io unless `path` can be replaced: its folder exists and is writable, and it is itself absent
/// or a regular file. Returns the path with a symbolic link resolved.
std::filesystem::path check_replaceable(const std::filesystem::path& path);

/// Puts `bytes` at `path`, in place of what was there, whose permissions they keep; a new file has those that
/// the umask leaves. On an error the old file is as it was and
/// nothing new is in the folder; the one exception is a failing flush of the folder, after which the
/// new file is there but may not survive a power cut. Thread safe. Throws io.
void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes,
                const FileCalls& calls = FileCalls::system());

}  // namespace bn::texture
