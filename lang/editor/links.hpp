#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::lang {

/// The path in an import or include.
struct FileLink {
  Span where;                    ///< the string with its quotes
  std::filesystem::path target;  ///< relative paths are resolved from the folder of the file
  bool exists = false;
};

/// The file that an import or include names, whether it exists or not; nullopt if the statement has
/// no readable path. `path`: of the file of the tree.
std::optional<std::filesystem::path> link_target(const SyntaxTree& tree, NodeIndex statement,
                                                 const std::filesystem::path& path);

/// The links of a scene file at `path`, in the order of the text.
std::vector<FileLink> file_links(const SyntaxTree& tree, const std::filesystem::path& path,
                                 const FileSystem& files);

}  // namespace sdlc::lang
