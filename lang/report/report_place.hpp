#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "lang/source/source.hpp"

/// What reports for other programs call files and lines, so that those programs find them.
namespace sdlc::lang {

/// The file's path from `root` where it lies in that folder, else its whole path, with slashes. An
/// empty root keeps all names.
std::string report_path(std::string_view name, const std::filesystem::path& root);

/// The path as a URI (RFC 3986): relative, or `file:///…` for an absolute one; all but unreserved
/// characters and slashes are percent-encoded.
std::string report_uri(std::string_view path);

/// Names lines so that a report of another day finds them again though lines were added above.
///
/// A name is what GitHub's code scanning calls `primaryLocationLineHash`: the polynomial in 37 of
/// the 100 UTF-16 code units from the line's first on, without spaces and tabs, line ends as line
/// feeds, 0xFFFF for the end and zeros behind it, modulo 2^64, in hexadecimal; then `:n` for the
/// n-th line of the file with that value. Its upload action computes the same and warns of others.
class LineFingerprints {
 public:
  /// Remembers the last file: those with one name are taken as one.
  std::string of(const SourceFile& file, std::uint32_t line);

 private:
  std::string name_;
  std::vector<std::string> fingerprints_;  // by line
};

}  // namespace sdlc::lang
