#include "lsp/uri.hpp"

#include <cctype>
#include <cstdint>

#include <fmt/format.h>

#include "lang/text/ascii.hpp"

namespace sdlc::lsp {
namespace {

constexpr std::string_view kScheme = "file://";
/// The unreserved characters of RFC 3986, and the slash.
constexpr std::string_view kPlain =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";

/// The value of a hexadecimal digit; -1 for other characters.
int digit_of(char c) {
  const std::size_t value = std::string_view("0123456789abcdef").find(lang::to_lower(c));
  return value == std::string_view::npos ? -1 : static_cast<int>(value);
}

std::string unescaped(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_escape = text[i] == '%' && i + 2 < text.size() && digit_of(text[i + 1]) >= 0 &&
                           digit_of(text[i + 2]) >= 0;
    if (!is_escape) {
      result += text[i];
      continue;
    }
    result += static_cast<char>(digit_of(text[i + 1]) * 16 + digit_of(text[i + 2]));
    i += 2;
  }
  return result;
}

}  // namespace

std::string uri_of_path(const std::filesystem::path& path) {
  std::string uri(kScheme);
  for (const char c : path.generic_string()) {
    if (kPlain.find(c) != std::string_view::npos) {
      uri += c;
    } else {
      uri += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return uri;
}

std::filesystem::path path_of_uri(std::string_view uri) {
  if (lang::lower_case(uri.substr(0, kScheme.size())) == kScheme) {
    const std::string_view rest = uri.substr(kScheme.size());
    const std::size_t slash = rest.find('/');
    // Without a path, or with a byte that no path has, it is no file.
    const std::string path = unescaped(slash == std::string_view::npos ? "" : rest.substr(slash));
    if (!path.empty() && path.find('\0') == std::string::npos) return path;
  }
  // A folder that cannot exist: a file is not a folder.
  std::string name;
  for (const char c : uri) name += c == '/' || c == '\0' ? '_' : c;
  return std::filesystem::path("/dev/null") / name;
}

}  // namespace sdlc::lsp
