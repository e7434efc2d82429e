#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

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

/// Makes the folder of `path` and those above it as far as they are missing; throws IoError.
void make_parent_folders(const std::filesystem::path& path);

}  // namespace sdlc::render
