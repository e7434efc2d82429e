#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

namespace sdlc::render {

/// Makes `path` hold exactly `bytes`, or throws IoError and leaves it as it was: the bytes go to a
/// hidden temporary file in the same folder, reach the disk, and only then take the name.
/// A symbolic link stays a link and its target is replaced. A file that is replaced keeps its
/// permissions, extended attributes and access control lists, as far as the process may set them;
/// a new one has those of the umask. Other hard links of it keep the old bytes. What is not a
/// regular file (a pipe, /dev/null) is written to directly. The folder must exist.
///
/// The first file that a process writes to a folder also removes temporary files there of the
/// same user and machine whose processes are dead.
///
/// A limit on the size of files (RLIMIT_FSIZE) is an error here only if the process ignores
/// SIGXFSZ.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// The file that write_file_atomically would replace or make, absolute and with all links
/// followed. Two names are of one file if this is the same, or if both are there and are hard links
/// of each other. Throws IoError where links go in a circle.
std::filesystem::path written_path(const std::filesystem::path& path);

/// A signal handler may call it before it ends the process: removes the temporary files that are
/// being written, and the folders that ParentFolders made for them.
void remove_unfinished_files() noexcept;

struct UnfinishedPath;

/// Has remove_unfinished_files() remove a path while it lives, if there is room for it.
class RemovedBySignals {
 public:
  explicit RemovedBySignals(const std::filesystem::path& path) noexcept;
  RemovedBySignals(RemovedBySignals&& other) noexcept
      : path_(std::exchange(other.path_, nullptr)) {}
  RemovedBySignals& operator=(RemovedBySignals&&) = delete;
  ~RemovedBySignals() { release(); }
  void release() noexcept;

 private:
  UnfinishedPath* path_ = nullptr;
};

/// Throws the IoError that write_file_atomically would meet for reasons known before there are any
/// bytes: a folder that is missing, is not a folder or may not be written, a target that is a
/// folder or is write-protected. A quick check before a long render; it creates nothing.
void check_writable(const std::filesystem::path& path);

/// The same where the folder of `path` and those above it need not exist yet.
void check_creatable(const std::filesystem::path& path);

/// Makes the missing ones among the folders above `path`, and removes those it made again if they
/// are still empty when it goes: a file that could not be written leaves no folders behind. Throws
/// IoError.
class ParentFolders {
 public:
  explicit ParentFolders(const std::filesystem::path& path);
  ~ParentFolders();
  ParentFolders(const ParentFolders&) = delete;
  ParentFolders& operator=(const ParentFolders&) = delete;

 private:
  ParentFolders() = default;

  std::vector<std::filesystem::path> made_;  // the outermost first
  std::vector<RemovedBySignals> by_signals_;
};

}  // namespace sdlc::render
