#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sdlc::lang {

/// A pattern for paths, relative to some folder, with slashes: `*` matches any text and `?` any
/// character except a slash, `[a-z]` and `[!a-z]` a character in or not in a set, `**` as a
/// complete part any number of folders. A pattern without a slash matches names, at any depth; one
/// that ends in a slash matches everything in the folder.
class Glob {
 public:
  /// Throws std::invalid_argument with a description of the mistake.
  explicit Glob(std::string_view pattern);

  bool matches(std::string_view path) const;

 private:
  std::vector<std::string> parts_;
};

}  // namespace sdlc::lang
