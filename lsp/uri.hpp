#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace sdlc::lsp {

/// The `file:` URI of an absolute path (RFC 8089), with the characters escaped that VS Code
/// escapes.
std::string uri_of_path(const std::filesystem::path& path);

/// The path of a `file:` URI. Another URI, such as `untitled:Untitled-1`, is no file: its path is a
/// name that no file has, the same for equal URIs.
std::filesystem::path path_of_uri(std::string_view uri);

}  // namespace sdlc::lsp
