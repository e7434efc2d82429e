#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lang/source/source.hpp"

namespace sdlc::lang {

/// The folder of a scene and all below it, which nothing leads out of.
class Sandbox {
 public:
  /// `scene`: the file whose folder it is, as the user named it. `files` is borrowed.
  Sandbox(const FileSystem& files, const std::filesystem::path& scene);

  /// The file that `path` leads to, whether it is there or not, with all links followed; nothing
  /// where that is outside. Decided by the text of the path and of the links inside, so that the
  /// file system is asked about nothing outside.
  std::optional<std::filesystem::path> resolve(const std::filesystem::path& path) const;

 private:
  const FileSystem& files_;
  std::deque<std::string> root_;  ///< the names in its absolute path, links followed
  /// All absolute paths of it that are known: what begins with one of them is below the root.
  std::vector<std::deque<std::string>> beginnings_;
};

}  // namespace sdlc::lang
