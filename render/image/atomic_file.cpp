#include "render/image/atomic_file.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include "render/image/io_error.hpp"
#include "render/math/fnv.hpp"

namespace sdlc::render {

/// At a fixed address: a signal handler may not take a lock, or read a string that another thread
/// is about to free.
struct UnfinishedPath {
  std::atomic<bool> is_taken{false};
  std::atomic<bool> is_there{false};
  std::array<char, PATH_MAX> name{};
};

namespace {

namespace fs = std::filesystem;

constexpr int kMaxLinks = 40;            // the same limit as in the kernel
constexpr int kMaxTemporaryNames = 100;  // each collides with probability 2^-32

std::array<UnfinishedPath, 32> unfinished_paths;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler reads it");

[[noreturn]] void throw_write_error(const fs::path& path, int error) {
  throw IoError("write", path, std::error_code(error, std::generic_category()));
}

/// Owns a file descriptor.
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
    // After EINTR Linux has closed the descriptor anyway.
    return result == 0 || errno == EINTR ? 0 : errno;
  }

 private:
  int fd_;
};

/// A temporary file that is removed at the end of its scope, unless it was renamed to its final
/// name.
class TemporaryName {
 public:
  explicit TemporaryName(fs::path path) : path_(std::move(path)), by_signals_(path_) {}
  TemporaryName(TemporaryName&& other) noexcept
      : path_(std::exchange(other.path_, {})), by_signals_(std::move(other.by_signals_)) {}
  TemporaryName& operator=(TemporaryName&&) = delete;
  ~TemporaryName() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  const fs::path& path() const noexcept { return path_; }
  void release() noexcept {
    by_signals_.release();
    path_.clear();
  }

 private:
  fs::path path_;
  RemovedBySignals by_signals_;
};

std::optional<struct stat> status_of(const fs::path& path) noexcept {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return status;
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// The file at the end of a chain of symbolic links, whether it exists or not. Unlike
/// std::filesystem::canonical this follows a link to a file that does not exist yet.
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

using Content = std::function<void(const WritePiece&)>;

void write_content(int fd, const fs::path& path, const Content& content) {
  content([&](std::span<const std::byte> piece) {
    if (const int error = write_all(fd, piece)) throw_write_error(path, error);
  });
}

void write_directly(const fs::path& path, const Content& content) {
  FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
  if (!file.is_open()) throw_write_error(path, errno);
  write_content(file.get(), path, content);
  if (const int error = file.close()) throw_write_error(path, error);
}

/// The prefix of the names of this machine's temporary files. Machines may share the folder, and
/// process numbers are only valid on their own machine.
const std::string& temporary_prefix() {
  static const std::string prefix = [] {
    std::array<char, HOST_NAME_MAX + 1> host{};
    ::gethostname(host.data(), host.size() - 1);
    Fnv1a hash;
    hash.add(host.data());
    return fmt::format(".sdlc-{:016x}-", hash.value());
  }();
  return prefix;
}

/// The process number in the name of a temporary file of this machine; 0 for any other name.
pid_t process_of(std::string_view name) {
  constexpr std::string_view kEnding = ".tmp";
  const std::string& prefix = temporary_prefix();
  if (!name.starts_with(prefix) || !name.ends_with(kEnding)) return 0;
  name.remove_prefix(prefix.size());
  name.remove_suffix(std::min(kEnding.size(), name.size()));
  const char* const end = name.data() + name.size();
  pid_t process = 0;
  std::uint32_t number = 0;
  const auto [dash, error] = std::from_chars(name.data(), end, process);
  if (error != std::errc() || process <= 0 || dash == end || *dash != '-') return 0;
  const auto [stop, no_number] = std::from_chars(dash + 1, end, number, 16);
  return no_number == std::errc() && stop == end ? process : 0;
}

bool is_dead(pid_t process) noexcept { return ::kill(process, 0) != 0 && errno == ESRCH; }

/// Removes the temporary files of processes that were killed while writing to the folder. A file is
/// removed only if it belongs to the user, its process does not exist, and nobody holds its lock: a
/// process in another container may have the same machine name and a number that is not visible
/// here.
void remove_abandoned_files(const fs::path& folder) {
  static std::mutex mutex;
  static std::set<fs::path> known;  // once per process is enough
  {
    const std::lock_guard lock(mutex);
    if (!known.insert(fs::absolute(folder).lexically_normal()).second) return;
  }
  const std::unique_ptr<DIR, int (*)(DIR*)> stream(::opendir(folder.c_str()), ::closedir);
  if (!stream) return;
  const int place = ::dirfd(stream.get());
  while (const dirent* entry = ::readdir(stream.get())) {
    const pid_t process = process_of(entry->d_name);
    if (process == 0 || !is_dead(process)) continue;
    // Opened for writing: NFS only locks writable files.
    const FileDescriptor file(
        ::openat(place, entry->d_name, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct stat status {};
    if (!file.is_open() || ::fstat(file.get(), &status) != 0) continue;
    if (!S_ISREG(status.st_mode) || status.st_uid != ::geteuid()) continue;
    if (::flock(file.get(), LOCK_EX | LOCK_NB) == 0) ::unlinkat(place, entry->d_name, 0);
  }
}

/// Creates a new file in `folder` under an unused name. The name does not contain the target's,
/// which may already be as long as the file system allows.
std::pair<FileDescriptor, TemporaryName> create_temporary(const fs::path& folder,
                                                          const fs::path& shown) {
  remove_abandoned_files(folder);
  std::random_device random;
  for (int attempt = 0; attempt < kMaxTemporaryNames; ++attempt) {
    // Register before creating: a signal in between would leave the file there.
    TemporaryName name(folder /
                       fmt::format("{}{}-{:08x}.tmp", temporary_prefix(), ::getpid(), random()));
    const int fd = ::open(name.path().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    const int error = errno;
    if (fd >= 0) {
      ::flock(fd, LOCK_EX | LOCK_NB);  // best effort: some file systems have no locks
      return {std::piecewise_construct, std::forward_as_tuple(fd),
              std::forward_as_tuple(std::move(name))};
    }
    name.release();  // it is another process's file, or was not created
    if (error != EEXIST) throw_write_error(shown, error);
  }
  throw_write_error(shown, EEXIST);
}

/// The names of a file's extended attributes, including access control lists.
std::vector<std::string> attributes_of(const fs::path& path) {
  std::string names(XATTR_LIST_MAX, '\0');
  const ssize_t size = ::listxattr(path.c_str(), names.data(), names.size());
  std::vector<std::string> each;
  for (std::size_t at = 0; size > 0 && at < static_cast<std::size_t>(size);) {
    each.emplace_back(names.c_str() + at);
    at += each.back().size() + 1;
  }
  return each;
}

/// Copies to `fd` the extended attributes of the file it will replace, except those that only the
/// system may set and those that describe the old bytes. Best effort: no attribute is worth losing
/// the contents.
void copy_attributes(int fd, const fs::path& path) {
  constexpr const char* kAccess = "system.posix_acl_access";
  const auto is_of_system = [](const std::string& name) {
    return name.starts_with("security.") && name != "security.selinux";
  };
  ::fremovexattr(fd, kAccess);  // inherited from the folder's default
  std::string value(XATTR_SIZE_MAX, '\0');
  for (const std::string& name : attributes_of(path)) {
    if (is_of_system(name)) continue;
    const ssize_t size = ::getxattr(path.c_str(), name.c_str(), value.data(), value.size());
    if (size < 0) continue;  // gone by now, or not readable for us
    ::fsetxattr(fd, name.c_str(), value.data(), static_cast<std::size_t>(size), 0);
  }
}

/// Copies to `fd` the attributes, the permissions and, if permitted, the owner of the file it will
/// replace.
int copy_ownership(int fd, const fs::path& path, const struct stat& old) {
  // Only root may give files away; for anyone else the new file belongs to its writer, as intended.
  if (::fchown(fd, old.st_uid, old.st_gid) != 0 && errno != EPERM && errno != EINVAL) return errno;
  copy_attributes(fd, path);
  // After fchown, which clears the set-user-ID bits.
  return ::fchmod(fd, old.st_mode & 07777) == 0 ? 0 : errno;
}

/// Makes the rename survive a power cut. Best effort: some file systems cannot sync folders, and
/// the file is complete in either case.
void sync_folder(const fs::path& folder) noexcept {
  const FileDescriptor file(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (file.is_open()) ::fsync(file.get());
}

/// Checks access with the effective rights of the process. Returns 0 or the error.
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

RemovedBySignals::RemovedBySignals(const fs::path& path) noexcept {
  if (path.native().size() >= PATH_MAX) return;
  for (UnfinishedPath& each : unfinished_paths) {
    if (each.is_taken.exchange(true)) continue;
    std::strcpy(each.name.data(), path.c_str());
    each.is_there = true;
    path_ = &each;
    return;
  }
}

void RemovedBySignals::release() noexcept {
  if (path_ == nullptr) return;
  path_->is_there = false;
  path_->is_taken = false;
  path_ = nullptr;
}

void remove_unfinished_files() noexcept {
  // In reverse order of creation: a file before the folder that was made for it.
  for (auto each = unfinished_paths.rbegin(); each != unfinished_paths.rend(); ++each) {
    if (!each->is_there) continue;
    ::unlink(each->name.data());
    ::rmdir(each->name.data());
  }
}

fs::path written_path(const fs::path& path) {
  const fs::path target = follow_links(path);
  std::error_code error;
  const fs::path folder = fs::weakly_canonical(fs::absolute(folder_of(target)), error);
  return (error ? fs::absolute(folder_of(target)).lexically_normal() : folder) / target.filename();
}

void check_writable(const fs::path& path) {
  if (path.empty()) throw IoError("write", path, "the name is empty");
  const std::optional<struct stat> old = status_of(path);
  if (old && S_ISDIR(old->st_mode)) {
    throw IoError("write", path, "it is a folder; name a file in it");
  }
  if (!path.has_filename()) throw IoError("write", path, "it names a folder; name a file in it");
  if (old) {
    // A rename could replace a write-protected file, which its owner does not expect.
    if (const int error = access_error(path, W_OK)) throw_write_error(path, error);
    if (!S_ISREG(old->st_mode)) return;
  } else if (errno == ENAMETOOLONG || errno == ELOOP) {
    throw_write_error(path, errno);
  }
  check_folder(folder_of(follow_links(path)), path);
}

void write_file_atomically(const fs::path& path, std::span<const std::byte> bytes) {
  write_file_atomically(path, [bytes](const WritePiece& write) { write(bytes); });
}

void write_file_atomically(const fs::path& path, const Content& content) {
  check_writable(path);
  const std::optional<struct stat> old = status_of(path);
  if (old && !S_ISREG(old->st_mode)) return write_directly(path, content);
  AtomicFile file(path);
  content([&](std::span<const std::byte> piece) { file.write(piece); });
  file.commit();
}

struct AtomicFile::State {
  fs::path path, target;
  std::pair<FileDescriptor, TemporaryName> file;
};

AtomicFile::AtomicFile(const fs::path& path) {
  const fs::path target = follow_links(path);
  state_.reset(  // not make_unique, because a State cannot be moved
      new State{.path = path, .target = target, .file = create_temporary(folder_of(target), path)});
  if (const std::optional<struct stat> old = status_of(path)) {
    const int error = copy_ownership(state_->file.first.get(), path, *old);
    if (error != 0) throw_write_error(path, error);
  }
}

AtomicFile::~AtomicFile() = default;

const fs::path& AtomicFile::temporary() const noexcept { return state_->file.second.path(); }

void AtomicFile::write(std::span<const std::byte> piece) {
  if (const int error = write_all(state_->file.first.get(), piece)) {
    throw_write_error(state_->path, error);
  }
}

void AtomicFile::commit() {
  auto& [path, target, place] = *state_;
  auto& [file, temporary] = place;
  // Sync before the rename: otherwise a power cut could leave the new name on an incomplete file.
  if (::fsync(file.get()) != 0) throw_write_error(path, errno);
  if (const int error = file.close()) throw_write_error(path, error);
  if (::rename(temporary.path().c_str(), target.c_str()) != 0) throw_write_error(path, errno);
  temporary.release();
  sync_folder(folder_of(target));
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

// Delegating: after the other constructor has returned, the destructor runs even if this one
// throws.
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
    if (is_new) by_signals_.emplace_back(*folder);
  }
  check_folder(folder_of(path), path);
}

ParentFolders::~ParentFolders() {
  // rmdir refuses a folder that is not empty.
  for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) ::rmdir(folder->c_str());
}

}  // namespace sdlc::render
