#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sdlc::cli {

/// A pattern of paths, relative to some folder, with slashes: `*` is any text and `?` any character
/// but a slash, `[a-z]` and `[!a-z]` one of or none of these, `**` by itself between slashes any
/// number of folders. One without a slash is about names, at any depth; one that ends in a slash is
/// about all that is in the folder.
class Glob {
 public:
  /// Throws std::invalid_argument with what is wrong with it.
  explicit Glob(std::string_view pattern);

  bool matches(std::string_view path) const;

 private:
  std::vector<std::string> parts_;
};

}  // namespace sdlc::cli
