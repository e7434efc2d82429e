#include "lsp/folder_walk.hpp"

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>

namespace sdlc::lsp {

namespace fs = std::filesystem;

namespace {

bool is_hidden(const fs::path& name) { return name.native().starts_with('.'); }

bool is_scene(const fs::path& name) { return !is_hidden(name) && name.extension() == ".scene"; }

/// Whether programs made what is in the folder.
bool is_generated(const fs::path& folder) {
  if (folder.filename() == "node_modules") return true;
  std::error_code error;
  return fs::exists(folder / "CACHEDIR.TAG", error) || fs::exists(folder / "CMakeCache.txt", error);
}

}  // namespace

FolderWalk::FolderWalk(const std::vector<fs::path>& folders, std::size_t max_scenes)
    : pending_(folders.begin(), folders.end()), max_scenes_(max_scenes) {}

std::optional<std::vector<fs::path>> FolderWalk::next() {
  if (pending_.empty()) return std::nullopt;
  const fs::path folder = std::move(pending_.front());
  pending_.pop_front();
  std::vector<fs::path> scenes, folders;
  std::error_code error;
  fs::directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const fs::path name = entry->path().filename();
    if (++entries_ > kMaxEntries || scenes_ == max_scenes_) {
      is_limited_ = true;
      pending_.clear();
      folders.clear();
      break;
    }
    if (is_hidden(name)) continue;
    std::error_code unreadable;
    if (is_scene(name)) {
      if (!entry->is_regular_file(unreadable)) continue;
      scenes.push_back(entry->path());
      ++scenes_;
    } else if (!entry->is_symlink(unreadable) && entry->is_directory(unreadable) &&
               !is_generated(entry->path())) {
      folders.push_back(entry->path());
    }
  }
  std::ranges::sort(scenes);
  std::ranges::sort(folders);
  pending_.insert(pending_.end(), folders.begin(), folders.end());
  return scenes;
}

bool is_walked(const fs::path& folder, const fs::path& file) {
  const fs::path below = file.lexically_relative(folder);
  if (below.empty() || *below.begin() == ".." || !is_scene(file.filename())) return false;
  fs::path at = folder;
  for (const fs::path& name : below.parent_path()) {
    at /= name;
    if (is_hidden(name) || is_generated(at)) return false;
  }
  return true;
}

}  // namespace sdlc::lsp
