#pragma once

#include <string_view>
#include <vector>

namespace sdlc::lang {

/// The names of a path such as `mat.brushed`, which may have spaces and comments between them.
std::vector<std::string_view> split_path(std::string_view path);

}  // namespace sdlc::lang
