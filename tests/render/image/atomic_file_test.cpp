#include "render/image/atomic_file.hpp"

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/file.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <sys/xattr.h>
#include <unistd.h>

#include "render/image/io_error.hpp"
#include "tests/render/image/io_errors.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::render {
namespace {

using test::content_of;
using test::error_of;
using test::names_in;
using test::TemporaryFolder;
using test::write_text;

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr uid_t kNobody = 65534;

void write(const fs::path& path, const std::string& text) {
  write_file_atomically(path, std::as_bytes(std::span(text)));
}

/// During its lifetime files cannot exceed `bytes`: gives the errors of a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit old_{};
  void (*handler_)(int);
};

/// Root may write anywhere; during its lifetime, root becomes nobody.
class Unprivileged {
 public:
  Unprivileged() {
    if (::geteuid() != 0) return;
    if (::seteuid(kNobody) != 0) throw std::runtime_error("root cannot become nobody");
    is_switched_ = true;
  }
  Unprivileged(const Unprivileged&) = delete;
  Unprivileged& operator=(const Unprivileged&) = delete;
  ~Unprivileged() {
    if (is_switched_ && ::seteuid(0) != 0) std::abort();
  }

 private:
  bool is_switched_ = false;
};

/// A small private file system mounted over `folder`, seen by this process only.
class MountedDisk {
 public:
  MountedDisk(const fs::path& folder, const char* options) : folder_(folder) {
    is_mounted_ = ::unshare(CLONE_NEWNS) == 0 &&
                  ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                  ::mount("tmpfs", folder.c_str(), "tmpfs", 0, options) == 0;
  }
  MountedDisk(const MountedDisk&) = delete;
  MountedDisk& operator=(const MountedDisk&) = delete;
  ~MountedDisk() {
    if (is_mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
  }
  bool is_mounted() const noexcept { return is_mounted_; }
  bool make_read_only() const {
    return ::mount("none", folder_.c_str(), nullptr, MS_REMOUNT | MS_RDONLY, nullptr) == 0;
  }

 private:
  fs::path folder_;
  bool is_mounted_ = false;
};

TEST(AtomicFile, WritesANewFile) {
  const TemporaryFolder folder;
  write(folder / "a.png", "picture");
  EXPECT_EQ(content_of(folder / "a.png"), "picture");
  EXPECT_THAT(names_in(folder.path()), ElementsAre("a.png"));
}

TEST(AtomicFile, WritesAnEmptyFile) {
  const TemporaryFolder folder;
  write(folder / "a.png", "");
  EXPECT_EQ(fs::file_size(folder / "a.png"), 0U);
}

TEST(AtomicFile, ReplacesALongerFileWhole) {
  const TemporaryFolder folder;
  write_text(folder / "a.png", "something longer than the new text");
  write(folder / "a.png", "new");
  EXPECT_EQ(content_of(folder / "a.png"), "new");
}

TEST(AtomicFile, IsWholeForAReaderThatOpenedItBefore) {
  const TemporaryFolder folder;
  write_text(folder / "a.png", "old");
  std::ifstream reader(folder / "a.png");
  write(folder / "a.png", "new");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(reader), {}), "old");
}

TEST(AtomicFile, TakesANameAsLongAsTheFileSystemAllows) {
  const TemporaryFolder folder;
  const std::string name(255, 'n');
  write(folder / name, "picture");
  EXPECT_EQ(content_of(folder / name), "picture");
}

TEST(AtomicFile, LeavesTheOldFileWhenTheSizeLimitIsReached) {
  const TemporaryFolder folder;
  write_text(folder / "a.png", "old");
  std::string error;
  {
    const FileSizeLimit limit(1000);
    error = error_of([&] { write(folder / "a.png", std::string(5000, 'x')); });
  }
  EXPECT_THAT(error, HasSubstr("a.png`: File too large"));
  EXPECT_EQ(content_of(folder / "a.png"), "old");
  EXPECT_THAT(names_in(folder.path()), ElementsAre("a.png"));
}

TEST(AtomicFile, LeavesTheOldFileWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  const MountedDisk disk(folder.path(), "size=16k");
  if (!disk.is_mounted()) GTEST_SKIP() << "only root may mount a small disk";
  write(folder / "a.png", "old");
  EXPECT_THAT(error_of([&] { write(folder / "a.png", std::string(100'000, 'x')); }),
              HasSubstr("a.png`: No space left on device"));
  EXPECT_EQ(content_of(folder / "a.png"), "old");
  EXPECT_THAT(names_in(folder.path()), ElementsAre("a.png"));
}

TEST(AtomicFile, ReportsADiskThatIsReadOnly) {
  const TemporaryFolder folder;
  const MountedDisk disk(folder.path(), "size=16k");
  if (!disk.is_mounted() || !disk.make_read_only()) GTEST_SKIP() << "only root may mount a disk";
  EXPECT_THAT(error_of([&] { check_writable(folder / "a.png"); }),
              HasSubstr("cannot be written: Read-only file system"));
  EXPECT_THAT(error_of([&] { write(folder / "a.png", "x"); }), HasSubstr("Read-only file system"));
}

// Device files are written as nobody: if the code under test ever replaced one as a file, root
// would replace /dev/null for everybody.

TEST(AtomicFile, ReportsAFullDevice) {
  const Unprivileged user;
  EXPECT_EQ(error_of([] { write("/dev/full", "x"); }),
            "cannot write `/dev/full`: No space left on device");
}

TEST(AtomicFile, WritesToADeviceWithoutReplacingIt) {
  const Unprivileged user;
  write("/dev/null", "x");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(AtomicFile, WritesToAPipe) {
  const TemporaryFolder folder;
  const fs::path pipe = folder / "pipe.png";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = content_of(pipe); });
  write(pipe, "picture");
  reader.join();
  EXPECT_EQ(received, "picture");
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST(AtomicFile, KeepsASymbolicLinkAndReplacesItsTarget) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "real");
  write_text(folder / "real/a.png", "old");
  fs::create_symlink("real/a.png", folder / "link.png");  // relative to the link's own folder
  write(folder / "link.png", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link.png"));
  EXPECT_EQ(content_of(folder / "real/a.png"), "new");
  EXPECT_THAT(names_in(folder / "real"), ElementsAre("a.png"));
}

TEST(AtomicFile, MakesTheMissingTargetOfASymbolicLink) {
  const TemporaryFolder folder;
  fs::create_symlink(folder / "a.png", folder / "link.png");
  write(folder / "link.png", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link.png"));
  EXPECT_EQ(content_of(folder / "a.png"), "new");
}

TEST(AtomicFile, RefusesALinkToItself) {
  const TemporaryFolder folder;
  fs::create_symlink("loop.png", folder / "loop.png");
  EXPECT_THAT(error_of([&] { write(folder / "loop.png", "x"); }),
              HasSubstr("Too many levels of symbolic links"));
}

TEST(AtomicFile, GivesANewFileThePermissionsOfTheUmask) {
  const TemporaryFolder folder;
  const mode_t old = ::umask(027);
  write(folder / "a.png", "x");
  ::umask(old);
  EXPECT_EQ(fs::status(folder / "a.png").permissions(), fs::perms{0640});
}

TEST(AtomicFile, KeepsThePermissionsOfTheFileItReplaces) {
  const TemporaryFolder folder;
  write_text(folder / "a.png", "old");
  fs::permissions(folder / "a.png", fs::perms{0604});
  write(folder / "a.png", "new");
  EXPECT_EQ(fs::status(folder / "a.png").permissions(), fs::perms{0604});
}

TEST(AtomicFile, KeepsTheOwnerWhenRootReplacesAFile) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root may give files away";
  const TemporaryFolder folder;
  write_text(folder / "a.png", "old");
  ASSERT_EQ(::chown((folder / "a.png").c_str(), kNobody, kNobody), 0);
  write(folder / "a.png", "new");
  struct stat status {};
  ASSERT_EQ(::stat((folder / "a.png").c_str(), &status), 0);
  EXPECT_EQ(status.st_uid, kNobody);
}

std::optional<std::string> attribute_of(const fs::path& path, const char* name) {
  std::string value(256, '\0');
  const ssize_t size = ::getxattr(path.c_str(), name, value.data(), value.size());
  if (size < 0) return std::nullopt;
  value.resize(static_cast<std::size_t>(size));
  return value;
}

TEST(AtomicFile, KeepsTheExtendedAttributesOfTheFileItReplaces) {
  const TemporaryFolder folder;
  write_text(folder / "a.scene", "old");
  const std::string value = "mine", empty;
  for (const auto& [name, bytes] :
       {std::pair("user.note", value), std::pair("user.empty", empty)}) {
    if (::setxattr((folder / "a.scene").c_str(), name, bytes.data(), bytes.size(), 0) != 0) {
      GTEST_SKIP() << "this file system has no extended attributes";
    }
  }
  write(folder / "a.scene", "new");
  EXPECT_EQ(attribute_of(folder / "a.scene", "user.note"), "mine");
  EXPECT_EQ(attribute_of(folder / "a.scene", "user.empty"), "");
}

TEST(AtomicFile, KeepsTheAccessControlListOfTheFileItReplaces) {
  // Owner rw, user 65534 r, group r, mask r, others none; as the kernel keeps it.
  const std::string list(
      "\2\0\0\0"
      "\1\0\6\0\xff\xff\xff\xff"
      "\2\0\4\0\xfe\xff\0\0"
      "\4\0\4\0\xff\xff\xff\xff"
      "\x10\0\4\0\xff\xff\xff\xff"
      "\x20\0\0\0\xff\xff\xff\xff",
      44);
  constexpr const char* kAccess = "system.posix_acl_access";
  const TemporaryFolder folder;
  write_text(folder / "a.scene", "old");
  if (::setxattr((folder / "a.scene").c_str(), kAccess, list.data(), list.size(), 0) != 0) {
    GTEST_SKIP() << "this file system has no access control lists";
  }
  write(folder / "a.scene", "new");
  EXPECT_EQ(attribute_of(folder / "a.scene", kAccess), list);
  // A file without one does not get the folder's default.
  write_text(folder / "b.scene", "old");
  ::setxattr(folder.path().c_str(), "system.posix_acl_default", list.data(), list.size(), 0);
  write(folder / "b.scene", "new");
  EXPECT_EQ(attribute_of(folder / "b.scene", kAccess), std::nullopt);
}

/// The file that a process leaves in `folder` if it is killed while writing there. There are no
/// others.
std::string abandoned_in(const fs::path& folder) {
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, [](int) { ::kill(::getpid(), SIGKILL); });
    const rlimit limit{4, 4};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    write(folder / "killed.png", "more than that");
    std::_Exit(1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  const auto names = names_in(folder);
  EXPECT_EQ(names.size(), 1U);
  return names.empty() ? "" : names.front();
}

TEST(AtomicFile, RemovesWhatADeadProcessLeft) {
  const TemporaryFolder folder;
  EXPECT_THAT(abandoned_in(folder.path()), testing::MatchesRegex("\\.sdlc-.*\\.tmp"));
  write(folder / "a.png", "new");
  EXPECT_THAT(names_in(folder.path()), ElementsAre("a.png"));
}

TEST(AtomicFile, LeavesWhatMayBeInUse) {
  const TemporaryFolder folder;
  const std::string name = abandoned_in(folder.path());
  const std::string dead = name.substr(0, name.rfind('-'));  // .sdlc-MACHINE-PROCESS
  const std::string machine = dead.substr(0, dead.rfind('-'));
  fs::remove(folder / name);
  const std::vector<std::string> kept{
      machine + "-" + std::to_string(::getpid()) + "-0000000a.tmp",               // is alive
      ".sdlc-0123456789abcdef" + dead.substr(dead.rfind('-')) + "-0000000b.tmp",  // elsewhere
      dead + "-0000000c.tmp.mine",
      dead + "-.tmp",
      dead + "-xyz.tmp",
      machine + "-0-0000000d.tmp",
      machine + "--1-0000000e.tmp",
      "x" + dead + "-0000000f.tmp"};
  for (const std::string& each : kept) write_text(folder / each, "");
  fs::create_directory(folder / (dead + "-00000001.tmp"));
  ASSERT_EQ(::mkfifo((folder / (dead + "-00000002.tmp")).c_str(), 0600), 0);
  write_text(folder / "precious", "mine");
  fs::create_symlink("precious", folder / (dead + "-00000003.tmp"));
  write_text(folder / (dead + "-00000004.tmp"), "");
  const int held = ::open((folder / (dead + "-00000004.tmp")).c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(::flock(held, LOCK_EX), 0);  // in another container, say
  const auto before = names_in(folder.path());
  write(folder / "a.png", "new");
  auto after = names_in(folder.path());
  std::erase(after, "a.png");
  EXPECT_EQ(after, before);
  EXPECT_EQ(content_of(folder / "precious"), "mine");
  ::close(held);
}

TEST(WrittenPath, IsTheSameForAllNamesOfAFile) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "sub");
  fs::create_directory_symlink("sub", folder / "link");
  fs::create_symlink("sub/a.png", folder / "a.png");
  fs::create_symlink("../a.png", folder / "sub/b.png");
  const fs::path expected = written_path(folder / "sub/a.png");
  for (const char* name : {"link/a.png", "a.png", "sub/b.png", "link/../a.png", "./sub//a.png"}) {
    EXPECT_EQ(written_path(folder / name), expected) << name;
  }
  EXPECT_NE(written_path(folder / "sub/c.png"), expected);
}

TEST(CheckWritable, IsSatisfiedByAFolderThatCanBeWritten) {
  const TemporaryFolder folder;
  write_text(folder / "old.png", "old");
  check_writable(folder / "new.png");
  check_writable(folder / "old.png");
  check_writable("/dev/null");
  check_writable("name_without_folder.png");
  EXPECT_THAT(names_in(folder.path()), ElementsAre("old.png"));
}

TEST(CheckWritable, NamesAMissingFolder) {
  const TemporaryFolder folder;
  EXPECT_THAT(
      error_of([&] { check_writable(folder / "none/a.png"); }),
      HasSubstr("none/a.png`: the folder `" + (folder / "none").string() + "` does not exist"));
}

TEST(CheckWritable, NamesAPartThatIsAFile) {
  const TemporaryFolder folder;
  write_text(folder / "file", "");
  EXPECT_THAT(error_of([&] { check_writable(folder / "file/a.png"); }),
              HasSubstr("file` is not a folder"));
  EXPECT_THAT(error_of([&] { check_writable(folder / "file/b/a.png"); }),
              HasSubstr("a part of `" + (folder / "file/b").string() + "` is not a folder"));
}

TEST(CheckWritable, RefusesFoldersAndEmptyNames) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_of([&] { check_writable(folder.path()); }), HasSubstr("it is a folder"));
  EXPECT_THAT(error_of([&] { check_writable(folder / "none/"); }), HasSubstr("it names a folder"));
  EXPECT_THAT(error_of([&] { check_writable(""); }), HasSubstr("the name is empty"));
}

TEST(CheckWritable, RefusesAFolderWithoutPermission) {
  const TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms{0555});
  const Unprivileged user;
  EXPECT_THAT(error_of([&] { check_writable(folder / "a.png"); }),
              HasSubstr("` cannot be written: Permission denied"));
}

TEST(CheckWritable, RefusesAWriteProtectedFile) {
  const TemporaryFolder folder;
  write_text(folder / "a.png", "old");
  fs::permissions(folder / "a.png", fs::perms{0444});
  fs::permissions(folder.path(), fs::perms{0777});
  const Unprivileged user;
  EXPECT_THAT(error_of([&] { write(folder / "a.png", "new"); }),
              HasSubstr("a.png`: Permission denied"));
  EXPECT_EQ(content_of(folder / "a.png"), "old");
}

TEST(ParentFolders, MakesEveryMissingOneAndKeepsThoseWithAFile) {
  const TemporaryFolder folder;
  {
    const ParentFolders made(folder / "a/b/c.png");
    EXPECT_TRUE(fs::is_directory(folder / "a/b"));
    write_text(folder / "a/b/c.png", "");
  }
  EXPECT_TRUE(fs::exists(folder / "a/b/c.png"));
  const ParentFolders again(folder / "a/b/c.png");
  const ParentFolders none("c.png");
}

TEST(ParentFolders, RemovesThoseThatStayedEmpty) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "a");
  { const ParentFolders made(folder / "a/b/c/d.png"); }
  EXPECT_THAT(names_in(folder.path()), ElementsAre("a"));
  EXPECT_TRUE(fs::is_empty(folder / "a"));
}

TEST(ParentFolders, NamesTheFolderThatCannotBeMade) {
  const TemporaryFolder folder;
  write_text(folder / "a", "a file");
  EXPECT_NE(error_of([&] { const ParentFolders made(folder / "a/b/c.png"); }), "");
  EXPECT_NE(error_of([&] { check_creatable(folder / "a/b/c.png"); }), "");
}

TEST(CheckCreatable, AllowsMissingFolders) {
  const TemporaryFolder folder;
  EXPECT_EQ(error_of([&] { check_creatable(folder / "a/b/c.png"); }), "");
  EXPECT_NE(error_of([&] { check_creatable(folder / "a/b/"); }), "");
  EXPECT_THAT(names_in(folder.path()), ElementsAre());
}

}  // namespace
}  // namespace sdlc::render
