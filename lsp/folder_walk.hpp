#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <optional>
#include <vector>

namespace sdlc::lsp {

/// Finds the scenes below some folders, those near the top first, a folder at a time. It skips
/// hidden files and folders and links to folders, as `sdlc lint` does, and also `node_modules`,
/// CMake's build folders, and folders marked as caches (CACHEDIR.TAG, https://bford.info/cachedir):
/// what is in them is made by programs. Folders that cannot be read are skipped.
class FolderWalk {
 public:
  /// Max files and folders looked at: someone may open their home or `/` as a folder.
  static constexpr std::size_t kMaxEntries = 500'000;

  explicit FolderWalk(const std::vector<std::filesystem::path>& folders, std::size_t max_scenes);

  /// Reads one folder; returns the scenes in it, sorted. nullopt at the end.
  std::optional<std::vector<std::filesystem::path>> next();
  /// Whether there was more than the limits allow.
  bool is_limited() const noexcept { return is_limited_; }

 private:
  std::deque<std::filesystem::path> pending_;
  std::size_t max_scenes_;
  std::size_t scenes_ = 0, entries_ = 0;
  bool is_limited_ = false;
};

/// Whether the walk of `folder` would find the file, if it existed.
bool is_walked(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace sdlc::lsp
