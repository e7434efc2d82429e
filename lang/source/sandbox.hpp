#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lang/source/source.hpp"

namespace sdlc::lang {

/// Restricts file access to the folder of a scene and its subfolders.
class Sandbox {
 public:
  /// `scene`: a file in the folder, as given by the user. `files` is borrowed.
  Sandbox(const FileSystem& files, const std::filesystem::path& scene);

  /// The path with all links resolved, whether the file exists or not; nullopt if it is outside.
  /// Reads only the text of the path and links inside, so that no query reaches files outside.
  std::optional<std::filesystem::path> resolve(const std::filesystem::path& path) const;

 private:
  const FileSystem& files_;
  std::deque<std::string> root_;  ///< names in the absolute path, links resolved
  /// All known absolute paths of the root: a path that begins with one of them is below it.
  std::vector<std::deque<std::string>> beginnings_;
};

}  // namespace sdlc::lang
