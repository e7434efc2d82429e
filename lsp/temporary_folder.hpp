#pragma once

#include <filesystem>

#include "lsp/child_process.hpp"

namespace sdlc::lsp {

/// A folder of our own in the system's folder for temporary files, made on first use and removed at
/// the end. A server that is killed cannot remove its folder: the next one that makes a folder
/// does.
class TemporaryFolder {
 public:
  TemporaryFolder() = default;
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  /// Throws std::system_error if it cannot be made.
  const std::filesystem::path& path();

 private:
  std::filesystem::path path_;
  Descriptor lock_;  // locked as long as the folder is in use
};

}  // namespace sdlc::lsp
