// Protects: whatever fails while a file is written, the old file stays as it was and no litter is
// left; a killed writer leaves nothing, or something that the next writer removes; writers at the
// same time all write whole files.
#include "texture/write_file.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cerrno>
#include <functional>
#include <thread>

#include "bn/error.h"
#include "texture/fixtures.h"

namespace bn::texture {
namespace {

constexpr std::string_view kOld = "the old content";
const std::string kNew(100000, 'n');

std::span<const std::byte> view(std::string_view text) { return std::as_bytes(std::span(text)); }

// FileCalls holds plain functions, so what they do in a test stands here.
struct Script {
  int fail_at = -1;          ///< the number of the call that fails, counted from 0
  int error = EIO;           ///< with this
  bool unnamed = true;       ///< the file system knows O_TMPFILE
  std::size_t most = ~0ull;  ///< bytes that one write() takes
  int calls = 0;
  std::string log;                        ///< one letter a call
  std::function<void(char)> before = {};  ///< called before each call, with its letter
};
Script script;

/// True if this call is to fail.
bool step(char letter) {
  if (script.before) script.before(letter);
  script.log += letter;
  const bool fails = script.calls++ == script.fail_at;
  if (fails) errno = script.error;
  return fails;
}

const FileCalls kScripted{
    .open =
        [](int folder, const char* name, int flags, mode_t mode) {
          if (!script.unnamed && (flags & O_TMPFILE) == O_TMPFILE) {
            errno = EOPNOTSUPP;
            return -1;
          }
          return step('o') ? -1 : FileCalls::system().open(folder, name, flags, mode);
        },
    .write = [](int file, const void* bytes, std::size_t count) -> ssize_t {
      return step('w') ? -1 : FileCalls::system().write(file, bytes, std::min(count, script.most));
    },
    .fsync = [](int file) { return step('s') ? -1 : FileCalls::system().fsync(file); },
    .chmod = [](int file, mode_t mode) { return step('p') ? -1 : FileCalls::system().chmod(file, mode); },
    .link = [](int file, int folder,
               const char* name) { return step('l') ? -1 : FileCalls::system().link(file, folder, name); },
    .rename = [](int folder, const char* from,
                 const char* to) { return step('r') ? -1 : FileCalls::system().rename(folder, from, to); },
    .unlink = [](int folder, const char* name) { return FileCalls::system().unlink(folder, name); },
};

/// Runs `body` in a process of its own, which ends with 0 unless something kills it.
int status_of_child(const std::function<void()>& body) {
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      body();
    } catch (...) {
      ::_exit(1);
    }
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

class WriteFile : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    script = {};
    script.unnamed = GetParam();
    put_bytes(target, kOld);
  }
  TemporaryFolder folder;
  const std::filesystem::path target = folder / "target.bin";
};
INSTANTIATE_TEST_SUITE_P(Temporary, WriteFile, testing::Bool(),
                         [](const auto& test) { return test.param ? "Unnamed" : "Named"; });

TEST_P(WriteFile, StepsComeInTheOrderThatSurvivesAPowerCut) {
  write_file(target, view(kNew), kScripted);
  // Folder, its listing, the temporary; the bytes; flush; (a name;) rename; flush the folder.
  EXPECT_EQ(script.log, GetParam() ? "ooowslrs" : "ooowsrs");
  EXPECT_EQ(bytes_of(target), kNew);
  EXPECT_EQ(folder.names().size(), 1u);
}

TEST_P(WriteFile, AnyFailingStepLeavesTheOldFileAndNoLitter) {
  script.most = 40000;
  write_file(target, view(kNew), kScripted);
  const std::string steps = script.log;
  ASSERT_EQ(steps, GetParam() ? "ooowwwslrs" : "ooowwwsrs");
  for (int failing = 0; failing < static_cast<int>(steps.size()); ++failing) {
    for (const int error : {EIO, ENOSPC, EDQUOT, EROFS, EACCES}) {
      SetUp();
      script.most = 40000;
      script.fail_at = failing;
      script.error = error;
      const auto info = error_of([&] { write_file(target, view(kNew), kScripted); });
      const bool listing = failing == 1, folder_flush = failing + 1 == static_cast<int>(steps.size());
      if (listing) {
        // Nothing depends on finding the litter of others.
        EXPECT_FALSE(info.has_value());
        continue;
      }
      ASSERT_TRUE(info.has_value()) << steps << " at " << failing;
      EXPECT_EQ(info->code, ErrorCode::io);
      EXPECT_EQ(info->where, target.string());
      EXPECT_EQ(bytes_of(target), folder_flush ? kNew : kOld) << steps << " at " << failing;
      EXPECT_EQ(folder.names(), std::vector<std::string>{"target.bin"}) << steps << " at " << failing;
    }
  }
}

TEST_P(WriteFile, AWriteThatTakesNothingIsAnErrorAndNotALoop) {
  script.most = 0;
  expect_error(ErrorCode::io, [&] { write_file(target, view(kNew), kScripted); });
  EXPECT_EQ(bytes_of(target), kOld);
}

TEST_P(WriteFile, ShortAndInterruptedWritesAreContinued) {
  script.most = 777;
  script.fail_at = 5;
  script.error = EINTR;
  write_file(target, view(kNew), kScripted);
  EXPECT_EQ(bytes_of(target), kNew);
}

TEST_P(WriteFile, AFailedFirstWriteLeavesNothing) {
  std::filesystem::remove(target);
  for (int failing = 2; failing < 6; ++failing) {
    script = {};
    script.unnamed = GetParam();
    script.fail_at = failing;
    expect_error(ErrorCode::io, [&] { write_file(target, view(kNew), kScripted); });
    EXPECT_TRUE(folder.names().empty());
  }
}

TEST_P(WriteFile, AKillAtAnyStepLeavesTheOldFileAndTheNextWriteCleansUp) {
  write_file(target, view(kNew), kScripted);
  const std::string steps = script.log;
  for (std::size_t killed = 0; killed < steps.size(); ++killed) {
    SetUp();
    const int status = status_of_child([&] {
      script.before = [&](char) {
        if (script.log.size() == killed) ::kill(::getpid(), SIGKILL);
      };
      write_file(target, view(kNew), kScripted);
    });
    ASSERT_TRUE(WIFSIGNALED(status));
    const bool renamed = killed + 1 == steps.size();
    EXPECT_EQ(bytes_of(target), renamed ? kNew : kOld) << steps << " at " << killed;
    // An unnamed temporary has a name only between the link and the rename.
    const bool litter = !renamed && (GetParam() ? steps[killed] == 'r' : killed > 2);
    EXPECT_EQ(folder.names().size(), litter ? 2u : 1u) << steps << " at " << killed;
    if (litter) {
      EXPECT_TRUE(folder.names()[0].starts_with(".target.bin.")) << folder.names()[0];
      EXPECT_TRUE(folder.names()[0].ends_with(".bn-tmp")) << folder.names()[0];
    }
    write_file(target, view("again"));
    EXPECT_EQ(bytes_of(target), "again");
    EXPECT_EQ(folder.names().size(), 1u);
  }
}

TEST_P(WriteFile, CleaningUpSparesLiveWritersAndOtherFiles) {
  const std::vector<std::string> others = {".other.bin.0123456789abcdef.bn-tmp", ".target.bin.bn-tmp",
                                           ".target.bin.0123456789abcde.bn-tmp",
                                           "target.bin.0123456789abcdef.bn-tmp"};
  for (const std::string& name : others) put_bytes(folder / name, "x");
  // A second writer comes and goes just before the first one's rename.
  bool nested = false;
  script.before = [&](char letter) {
    if (letter != 'r' || nested) return;
    nested = true;
    write_file(target, view("the second writer's"));
    EXPECT_EQ(bytes_of(target), "the second writer's");
  };
  write_file(target, view(kNew), kScripted);
  EXPECT_TRUE(nested);
  EXPECT_EQ(bytes_of(target), kNew) << "the last rename wins";
  EXPECT_EQ(folder.names().size(), others.size() + 1);
}

TEST_P(WriteFile, WritersAtTheSameTimeAllWriteWholeFiles) {
  std::vector<std::thread> threads;
  for (char letter = 'a'; letter < 'e'; ++letter) {
    threads.emplace_back([&, letter] {
      const FileCalls calls = [] {
        FileCalls plain = FileCalls::system();
        if (!GetParam()) {
          plain.open = [](int at, const char* name, int flags, mode_t mode) {
            if ((flags & O_TMPFILE) == O_TMPFILE) return errno = EOPNOTSUPP, -1;
            return FileCalls::system().open(at, name, flags, mode);
          };
        }
        plain.fsync = [](int) { return 0; };
        return plain;
      }();
      for (int i = 0; i < 100; ++i) write_file(target, view(std::string(5000, letter)), calls);
    });
  }
  for (int i = 0; i < 300; ++i) {
    const std::string seen = bytes_of(target);
    EXPECT_TRUE(seen == kOld || (seen.size() == 5000 && seen == std::string(5000, seen[0])));
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(folder.names().size(), 1u);
}

TEST(WriteFileForReal, AFileSizeLimitLeavesTheOldFile) {
  const TemporaryFolder folder;
  put_bytes(folder / "a", kOld);
  const int status = status_of_child([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{.rlim_cur = 1000, .rlim_max = 1000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const auto info = error_of([&] { write_text_file(folder / "a", kNew); });
    if (!info.has_value() || info->code != ErrorCode::io) ::_exit(2);
  });
  EXPECT_EQ(status, 0);
  EXPECT_EQ(bytes_of(folder / "a"), kOld);
  EXPECT_EQ(folder.names().size(), 1u);
}

mode_t mode_of(const std::filesystem::path& path) {
  struct stat status = {};
  EXPECT_EQ(::stat(path.c_str(), &status), 0);
  return status.st_mode & 07777;
}

TEST_P(WriteFile, AFileThatIsReplacedKeepsItsPermissions) {
  for (const mode_t mode : {0600u, 0640u, 0444u, 0755u}) {
    ASSERT_EQ(::chmod(target.c_str(), mode), 0);
    write_file(target, view(kNew), kScripted);
    EXPECT_EQ(mode_of(target), mode);
  }
  // Before its first byte is written.
  EXPECT_NE(script.log.find("pw"), std::string::npos) << script.log;
}

TEST_P(WriteFile, PermissionsThatCannotBeKeptLeaveTheOldFile) {
  ASSERT_EQ(::chmod(target.c_str(), 0600), 0);
  write_file(target, view(kOld), kScripted);
  script.fail_at = static_cast<int>(script.log.find('p'));
  script.error = EPERM;
  script.calls = 0;
  expect_error(ErrorCode::io, [&] { write_file(target, view(kNew), kScripted); });
  EXPECT_EQ(bytes_of(target), kOld);
  EXPECT_EQ(mode_of(target), 0600u);
  EXPECT_EQ(folder.names().size(), 1u);
}

TEST_P(WriteFile, ANewFileHasThePermissionsThatTheUmaskLeaves) {
  for (const auto& [mask, mode] : {std::pair{022u, 0644u}, {077u, 0600u}, {0u, 0666u}}) {
    std::filesystem::remove(target);
    const mode_t before = ::umask(mask);
    write_file(target, view(kNew), kScripted);
    ::umask(before);
    EXPECT_EQ(mode_of(target), mode);
  }
}

TEST(WriteFileForReal, PipesAndDevicesAreRefusedWithAReason) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/null", folder / "null");
  std::filesystem::create_symlink(folder / "pipe", folder / "link");
  for (const std::filesystem::path& path : {folder / "pipe", folder / "null", folder / "link"}) {
    const auto error = error_of([&] { write_text_file(path, kNew); });
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->code, ErrorCode::io);
    EXPECT_NE(error->what.find("pipes and devices"), std::string::npos) << error->what;
    EXPECT_NE(error->remedy.find("file"), std::string::npos);
    expect_error(ErrorCode::io, [&] { read_image(path); });
  }
}

TEST(WriteFileForReal, StandardOutputThatIsAPipeIsNoLinkToNothing) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/stdout", folder / "link");
  const int status = status_of_child([&] {
    int ends[2];
    if (::pipe(ends) != 0 || ::dup2(ends[1], 1) < 0) ::_exit(3);
    const auto error = error_of([&] { write_text_file(folder / "link", kNew); });
    if (!error || error->what.find("pipes") == std::string::npos) ::_exit(2);
  });
  EXPECT_EQ(status, 0);
}

TEST(WriteFileForReal, EmptyTextAndLongNames) {
  const TemporaryFolder folder;
  const std::string longest(255, 'x');
  write_text_file(folder / longest, "");
  write_text_file(folder / longest, "1");
  EXPECT_EQ(bytes_of(folder / longest), "1");
  expect_error(ErrorCode::io, [&] { write_text_file(folder / (longest + "x"), "1"); });
  EXPECT_EQ(folder.names().size(), 1u);
}

TEST(WriteFileForReal, ARelativeNameGoesToTheWorkingFolder) {
  const TemporaryFolder folder;
  EXPECT_EQ(status_of_child([&] {
              std::filesystem::current_path(folder.path());
              write_text_file("plain.txt", "here");
            }),
            0);
  EXPECT_EQ(bytes_of(folder / "plain.txt"), "here");
}

TEST(WriteFileForReal, SymbolicLinksAreFollowed) {
  const TemporaryFolder folder, elsewhere;
  write_text_file(elsewhere / "real", kOld);
  std::filesystem::create_symlink(elsewhere / "real", folder / "link");
  write_text_file(folder / "link", kNew);
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(bytes_of(elsewhere / "real"), kNew);
  std::filesystem::create_symlink(elsewhere / "nothing", folder / "dangling");
  expect_error(ErrorCode::io, [&] { write_text_file(folder / "dangling", kNew); });
}

TEST(CheckWritable, SaysBeforehandWhatWritingWouldSay) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "folder.png");
  ASSERT_EQ(::mkfifo((folder / "pipe.png").c_str(), 0600), 0);
  put_bytes(folder / "file", "x");
  struct Case {
    std::filesystem::path path;
    SampleType type;
    int channels;
    ErrorCode code;
  };
  using enum SampleType;
  for (const Case& c : {Case{folder / "a.gif", u8, 3, ErrorCode::invalid_input},
                        Case{folder / "a", u8, 3, ErrorCode::invalid_input},
                        Case{folder / "", u8, 3, ErrorCode::invalid_input},
                        Case{"", u8, 3, ErrorCode::invalid_input},
                        Case{folder / ".png", u8, 3, ErrorCode::invalid_input},
                        Case{folder / "a.png", f32, 3, ErrorCode::invalid_input},
                        Case{folder / "a.png", f16, 3, ErrorCode::invalid_input},
                        Case{folder / "a.h", f16, 3, ErrorCode::invalid_input},
                        Case{folder / "a.tif", f16, 3, ErrorCode::invalid_input},
                        Case{folder / "a.ktx2", u8, 5, ErrorCode::invalid_input},
                        Case{folder / "a.dds", u8, 3, ErrorCode::invalid_input},
                        Case{folder / "a.dds", u8, 5, ErrorCode::invalid_input},
                        Case{folder / "a.png", u8, 5, ErrorCode::invalid_input},
                        Case{folder / "a.exr", u8, 1, ErrorCode::invalid_input},
                        Case{folder / "a.exr", u16, 1, ErrorCode::invalid_input},
                        Case{folder / "a.tif", u8, 0, ErrorCode::invalid_input},
                        Case{folder / "a.bin", u8, 65, ErrorCode::invalid_input},
                        Case{folder / "missing" / "a.png", u8, 3, ErrorCode::io},
                        Case{folder / "file" / "a.png", u8, 3, ErrorCode::io},
                        Case{folder / "folder.png", u8, 3, ErrorCode::io},
                        Case{folder / "pipe.png", u8, 3, ErrorCode::io}}) {
    SCOPED_TRACE(c.path.string());
    expect_error(c.code, [&] { check_writable(c.path, c.type, c.channels); });
    if (c.channels == 0) continue;
    expect_error(c.code, [&] { write_image(c.path, random_image({2, 2}, c.channels, c.type), {}); });
  }
  EXPECT_NO_THROW(check_writable(folder / "new.png", u8, 3));
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"file", "folder.png", "pipe.png"}));
}

TEST(CheckWritable, AFolderWithoutPermissionIsSaidBeforehand) {
  const TemporaryFolder folder;
  std::filesystem::permissions(folder.path(),
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  if (::geteuid() != 0) {
    expect_error(ErrorCode::io, [&] { check_writable(folder / "a.png", SampleType::u8, 3); });
  } else {
    // root may write anywhere; another user in a process of its own may not.
    EXPECT_EQ(status_of_child([&] {
                if (::setuid(65534) != 0) ::_exit(3);
                if (!error_of([&] { check_writable(folder / "a.png", SampleType::u8, 3); })) ::_exit(2);
              }),
              0);
  }
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

TEST(WriteImage, AnImageThatContradictsItselfIsRefused) {
  const TemporaryFolder folder;
  Image image = random_image({3, 3}, 3, SampleType::u8);
  image.samples.pop_back();
  expect_error(ErrorCode::invalid_input, [&] { write_image(folder / "a.png", image, {}); });
  expect_error(ErrorCode::invalid_input, [&] {
    write_image(folder / "a.bin", {.size = {0, 3}, .channels = 1, .type = SampleType::u8, .samples = {}}, {});
  });
  expect_error(ErrorCode::invalid_input, [&] {
    write_image(folder / "a.bin", {.size = {-1, -1}, .channels = 1, .type = SampleType::u8, .samples = {}},
                {});
  });
  expect_error(ErrorCode::invalid_input, [&] {
    write_image(folder / "a.bin", {.size = {65537, 1}, .channels = 1, .type = SampleType::u8, .samples = {}},
                {});
  });
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace bn::texture
