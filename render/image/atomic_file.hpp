#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace sdlc::render {

/// Makes `path` hold exactly `bytes`, or throws IoError and leaves it as it was: the bytes go to a
/// hidden temporary file in the same folder, reach the disk, and only then take the name.
/// A symbolic link stays a link and its target is replaced. A file that is replaced keeps its
/// permissions; a new one has those of the umask. What is not a regular file (a pipe, /dev/null) is
/// written to directly. The folder must exist.
///
/// A limit on the size of files (RLIMIT_FSIZE) is an error here only if the process ignores
/// SIGXFSZ.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

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
};

}  // namespace sdlc::render
