#include "render/image/atomic_file.hpp"

#include <cerrno>
#include <cstdio>
#include <optional>
#include <random>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "render/image/io_error.hpp"

namespace sdlc::render {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxLinks = 40;            // as the kernel counts them
constexpr int kMaxTemporaryNames = 100;  // each collides with a chance of 2^-32

[[noreturn]] void throw_write_error(const fs::path& path, int error) {
  throw IoError("write", path, std::generic_category().message(error));
}

/// An open file, closed with its scope.
class FileDescriptor {
 public:
  explicit FileDescriptor(int fd) noexcept : fd_(fd) {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  bool is_open() const noexcept { return fd_ >= 0; }
  int get() const noexcept { return fd_; }

  /// Closes and returns 0 or the error: network file systems report a full disk only now.
  int close() noexcept {
    const int result = ::close(std::exchange(fd_, -1));
    // After EINTR Linux has closed the descriptor all the same.
    return result == 0 || errno == EINTR ? 0 : errno;
  }

 private:
  int fd_;
};

/// A temporary file that is removed with its scope, unless it has taken its final name.
class TemporaryName {
 public:
  explicit TemporaryName(fs::path path) : path_(std::move(path)) {}
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;
  ~TemporaryName() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  const fs::path& path() const noexcept { return path_; }
  void release() noexcept { path_.clear(); }

 private:
  fs::path path_;
};

std::optional<struct stat> status_of(const fs::path& path) noexcept {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return status;
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// The file that a chain of symbolic links ends at, whether it exists or not. Unlike
/// std::filesystem::canonical this follows a link to a file that is yet to be made.
fs::path follow_links(const fs::path& path) {
  fs::path target = path;
  std::error_code error;
  for (int links = 0; fs::is_symlink(fs::symlink_status(target, error)); ++links) {
    if (links == kMaxLinks) throw_write_error(path, ELOOP);
    const fs::path next = fs::read_symlink(target, error);
    if (error) throw_write_error(path, error.value());
    target = folder_of(target) / next;  // an absolute `next` replaces the folder
  }
  return target;
}

/// Writes everything; returns 0 or the error.
int write_all(int fd, std::span<const std::byte> bytes) noexcept {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    if (written == 0) return ENOSPC;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return 0;
}

void write_directly(const fs::path& path, std::span<const std::byte> bytes) {
  FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
  if (!file.is_open()) throw_write_error(path, errno);
  if (const int error = write_all(file.get(), bytes)) throw_write_error(path, error);
  if (const int error = file.close()) throw_write_error(path, error);
}

/// A new file in `folder` under a name nobody has. The name does not contain the target's, which
/// may already be as long as the file system allows.
std::pair<FileDescriptor, TemporaryName> create_temporary(const fs::path& folder,
                                                          const fs::path& shown) {
  std::random_device random;
  for (int attempt = 0; attempt < kMaxTemporaryNames; ++attempt) {
    fs::path path = folder / fmt::format(".sdlc-{}-{:08x}.tmp", ::getpid(), random());
    const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd >= 0) {
      return {std::piecewise_construct, std::forward_as_tuple(fd),
              std::forward_as_tuple(std::move(path))};
    }
    if (errno != EEXIST) throw_write_error(shown, errno);
  }
  throw_write_error(shown, EEXIST);
}

/// Gives `fd` the permissions and, where that is allowed, the owner of the file it will replace.
int copy_ownership(int fd, const struct stat& old) noexcept {
  // Only root may give files away; for anyone else the new file is their own, which is what they
  // want.
  if (::fchown(fd, old.st_uid, old.st_gid) != 0 && errno != EPERM && errno != EINVAL) return errno;
  // After fchown, which clears the set-user-ID bits.
  return ::fchmod(fd, old.st_mode & 07777) == 0 ? 0 : errno;
}

/// Makes the new name survive a power cut. Best effort: some file systems cannot, and the file
/// itself is whole either way.
void sync_folder(const fs::path& folder) noexcept {
  const FileDescriptor file(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (file.is_open()) ::fsync(file.get());
}

/// May the process, with the rights it acts with, use the file this way? Returns 0 or the error.
int access_error(const fs::path& path, int mode) noexcept {
  return ::faccessat(AT_FDCWD, path.c_str(), mode, AT_EACCESS) == 0 ? 0 : errno;
}

void check_folder(const fs::path& folder, const fs::path& shown) {
  const std::optional<struct stat> status = status_of(folder);
  if (!status) {
    if (errno == ENOENT) {
      throw IoError("write", shown, fmt::format("the folder `{}` does not exist", folder.string()));
    }
    if (errno == ENOTDIR) {
      throw IoError("write", shown, fmt::format("a part of `{}` is not a folder", folder.string()));
    }
    throw_write_error(shown, errno);
  }
  if (!S_ISDIR(status->st_mode)) {
    throw IoError("write", shown, fmt::format("`{}` is not a folder", folder.string()));
  }
  if (const int error = access_error(folder, W_OK | X_OK)) {
    throw IoError("write", shown,
                  fmt::format("the folder `{}` cannot be written: {}", folder.string(),
                              std::generic_category().message(error)));
  }
}

}  // namespace

void check_writable(const fs::path& path) {
  if (path.empty()) throw IoError("write", path, "the name is empty");
  const std::optional<struct stat> old = status_of(path);
  if (old && S_ISDIR(old->st_mode)) {
    throw IoError("write", path, "it is a folder; name a file in it");
  }
  if (!path.has_filename()) throw IoError("write", path, "it names a folder; name a file in it");
  if (old) {
    // A rename could replace a write-protected file, but whoever protected it did not mean that.
    if (const int error = access_error(path, W_OK)) throw_write_error(path, error);
    if (!S_ISREG(old->st_mode)) return;
  } else if (errno == ENAMETOOLONG || errno == ELOOP) {
    throw_write_error(path, errno);
  }
  check_folder(folder_of(follow_links(path)), path);
}

void write_file_atomically(const fs::path& path, std::span<const std::byte> bytes) {
  check_writable(path);
  const std::optional<struct stat> old = status_of(path);
  if (old && !S_ISREG(old->st_mode)) return write_directly(path, bytes);

  const fs::path target = follow_links(path);
  const fs::path folder = folder_of(target);
  auto [file, temporary] = create_temporary(folder, path);
  if (old) {
    if (const int error = copy_ownership(file.get(), *old)) throw_write_error(path, error);
  }
  if (const int error = write_all(file.get(), bytes)) throw_write_error(path, error);
  // Before the rename: otherwise a power cut could leave the name on a file without its bytes.
  if (::fsync(file.get()) != 0) throw_write_error(path, errno);
  if (const int error = file.close()) throw_write_error(path, error);
  if (::rename(temporary.path().c_str(), target.c_str()) != 0) throw_write_error(path, errno);
  temporary.release();
  sync_folder(folder);
}

void check_creatable(const fs::path& path) {
  const fs::path folder = folder_of(path);
  fs::path existing = folder;
  while (!status_of(existing) && errno == ENOENT && existing != folder_of(existing)) {
    existing = folder_of(existing);
  }
  if (existing == folder) return check_writable(path);
  if (!path.has_filename()) throw IoError("write", path, "it names a folder; name a file in it");
  check_folder(existing, path);
}

// Delegating: once the other constructor is done, the destructor runs even if this one throws.
ParentFolders::ParentFolders(const fs::path& path) : ParentFolders() {
  std::vector<fs::path> missing;
  for (fs::path folder = folder_of(path); !status_of(folder) && errno == ENOENT;
       folder = folder_of(folder)) {
    missing.push_back(folder);
  }
  for (auto folder = missing.rbegin(); folder != missing.rend(); ++folder) {
    std::error_code error;
    const bool is_new = fs::create_directory(*folder, error);
    if (error) throw IoError("make the folder", *folder, error.message());
    if (is_new) made_.push_back(*folder);
  }
  check_folder(folder_of(path), path);
}

ParentFolders::~ParentFolders() {
  // rmdir refuses a folder that is not empty.
  for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) ::rmdir(folder->c_str());
}

}  // namespace sdlc::render
