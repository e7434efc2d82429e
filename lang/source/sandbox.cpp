#include "lang/source/sandbox.hpp"

#include <algorithm>
#include <deque>
#include <string>

namespace sdlc::lang {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxLinks = 40;  // the limit of Linux

using Names = std::deque<std::string>;

/// The names in a path, without the root, `.` and the empty name after a trailing `/`.
Names names_in(const fs::path& path) {
  Names names;
  for (const fs::path& name : path.relative_path()) {
    if (!name.empty() && name != ".") names.push_back(name.string());
  }
  return names;
}

fs::path folder_of(const fs::path& scene) {
  return scene.has_parent_path() ? scene.parent_path() : fs::path(".");
}

Names absolute_names(const fs::path& path) {
  return names_in(fs::absolute(path).lexically_normal());
}

bool starts_with(const Names& names, const Names& beginning) {
  return names.size() >= beginning.size() &&
         std::equal(beginning.begin(), beginning.end(), names.begin());
}

fs::path path_of(const Names& names) {
  fs::path path = "/";
  for (const std::string& name : names) path /= name;
  return path;
}

}  // namespace

Sandbox::Sandbox(const FileSystem& files, const fs::path& scene)
    : files_(files),
      root_(absolute_names(files.identity(folder_of(scene)))),
      beginnings_{names_in(fs::absolute(folder_of(scene)))} {
  // Paths of imports are normalized before or after they are made absolute. If the user's path has
  // a `..` after a link, normalization may name another folder, which is excluded.
  const fs::path folder = folder_of(scene);
  for (const fs::path& normal :
       {fs::absolute(folder.lexically_normal()), fs::absolute(folder).lexically_normal()}) {
    const Names names = names_in(normal);
    const bool is_known =
        std::find(beginnings_.begin(), beginnings_.end(), names) != beginnings_.end();
    if (is_known || absolute_names(files.identity(path_of(names))) != root_) continue;
    beginnings_.push_back(names);
  }
  beginnings_.push_back(root_);
}

std::optional<fs::path> Sandbox::resolve(const fs::path& path) const {
  // Not normalized: `link/..` is the parent of the link's target, not the folder of the link.
  Names rest = names_in(fs::absolute(path));
  const auto beginning = std::find_if(beginnings_.begin(), beginnings_.end(),
                                      [&](const Names& names) { return starts_with(rest, names); });
  if (beginning == beginnings_.end()) return std::nullopt;
  rest.erase(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(beginning->size()));

  // A part of the root, or below it. It contains no links, so `..` removes the last name.
  Names resolved = root_;
  for (int links = 0; !rest.empty();) {
    const std::string name = rest.front();
    rest.pop_front();
    if (name == "..") {
      if (!resolved.empty()) resolved.pop_back();
      continue;
    }
    resolved.push_back(name);
    if (resolved.size() <= root_.size()) {
      if (!starts_with(root_, resolved)) return std::nullopt;
      continue;
    }
    const std::optional<fs::path> target = files_.link_target(path_of(resolved));
    if (!target) continue;
    if (++links > kMaxLinks) return std::nullopt;
    resolved.pop_back();
    if (target->is_absolute()) resolved.clear();
    const Names further = names_in(*target);
    rest.insert(rest.begin(), further.begin(), further.end());
  }
  if (!starts_with(resolved, root_)) return std::nullopt;
  return path_of(resolved);
}

}  // namespace sdlc::lang
