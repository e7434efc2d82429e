#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace sdlc::render {

/// Replaces the contents of `path` with `bytes`, or throws IoError and leaves the file unchanged:
/// the bytes are written to a hidden temporary file in the same folder, synced to disk, and then
/// renamed. A symbolic link stays a link and its target is replaced. A replaced file keeps its
/// permissions, extended attributes and access control lists, as far as the process may set them; a
/// new file follows the umask. Other hard links keep the old contents. Files that are not regular
/// (a pipe, /dev/null) are written to directly. The folder must exist.
///
/// The first file that a process writes to a folder also removes temporary files there of the same
/// user and machine whose processes are dead.
///
/// A file size limit (RLIMIT_FSIZE) is an error here only if the process ignores SIGXFSZ.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// The same for bytes that come piece by piece: `content` passes each to its argument.
using WritePiece = std::function<void(std::span<const std::byte>)>;
void write_file_atomically(const std::filesystem::path& path,
                           const std::function<void(const WritePiece&)>& content);

/// The temporary file of write_file_atomically, which is renamed by commit() and otherwise removed.
/// Other programs may write to it.
class AtomicFile {
 public:
  /// Creates the temporary file. `path` is not there, or regular. Throws IoError.
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& temporary() const noexcept;
  void write(std::span<const std::byte> piece);
  void commit();

 private:
  struct State;

  std::unique_ptr<State> state_;
};

/// The file that write_file_atomically would replace or create: absolute, with all links resolved.
/// Two paths name the same file if this is equal for both, or if both exist and are hard links to
/// one file. Throws IoError for a cycle of links.
std::filesystem::path written_path(const std::filesystem::path& path);

/// Removes the temporary files that are being written and the folders that ParentFolders made for
/// them. Safe to call from a signal handler before it ends the process.
void remove_unfinished_files() noexcept;

struct UnfinishedPath;

/// Registers a path for remove_unfinished_files() during its lifetime, if there is a free slot.
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

/// Throws the IoError that write_file_atomically would meet for reasons known in advance: a folder
/// that is missing, not a folder or not writable; a target that is a folder or write-protected. A
/// quick check before a long render; it creates nothing.
void check_writable(const std::filesystem::path& path);

/// The same if the parent folders of `path` may not exist yet.
void check_creatable(const std::filesystem::path& path);

/// Creates the missing parent folders of `path`. The destructor removes those that are still empty,
/// so a file that could not be written leaves no folders behind. Throws IoError.
class ParentFolders {
 public:
  explicit ParentFolders(const std::filesystem::path& path);
  ~ParentFolders();
  ParentFolders(const ParentFolders&) = delete;
  ParentFolders& operator=(const ParentFolders&) = delete;

 private:
  ParentFolders() = default;

  std::vector<std::filesystem::path> made_;  // outermost first
  std::vector<RemovedBySignals> by_signals_;
};

}  // namespace sdlc::render
