#include "lsp/temporary_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace sdlc::lsp {

namespace fs = std::filesystem;

namespace {

constexpr const char* kPrefix = "sdlc-lsp-";

/// Locks a folder of this user; not open if it is in use, or no folder.
Descriptor lock(const fs::path& folder) {
  Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  struct stat status {};
  if (!descriptor.is_open() || ::fstat(descriptor.number(), &status) != 0) return {};
  if (status.st_uid != ::geteuid()) return {};
  // The kernel removes the lock at the end of a process, however it ends.
  return ::flock(descriptor.number(), LOCK_EX | LOCK_NB) == 0 ? std::move(descriptor)
                                                              : Descriptor();
}

void remove_abandoned(const fs::path& parent) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(parent, ignored)) {
    if (!entry.path().filename().string().starts_with(kPrefix)) continue;
    if (const Descriptor owned = lock(entry.path()); owned.is_open()) {
      fs::remove_all(entry.path(), ignored);
    }
  }
}

}  // namespace

const fs::path& TemporaryFolder::path() {
  if (!path_.empty()) return path_;
  const fs::path parent = fs::temp_directory_path();
  remove_abandoned(parent);
  // Another server may take the new folder for an abandoned one until it is locked.
  while (!lock_.is_open()) {
    std::string name = (parent / kPrefix).string() + "XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) {
      throw std::system_error(errno, std::generic_category(), "cannot make " + name);
    }
    path_ = name;
    lock_ = lock(path_);
  }
  return path_;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

}  // namespace sdlc::lsp
