#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "lang/source/source.hpp"

/// Names of files and lines in reports for other programs.
namespace sdlc::lang {

/// The path relative to `root` if the file is in that folder, otherwise its full path, with
/// slashes. An empty root keeps all names.
std::string report_path(std::string_view name, const std::filesystem::path& root);

/// The path as a URI (RFC 3986): relative, or `file:///…` for an absolute one; all but unreserved
/// characters and slashes are percent-encoded.
std::string report_uri(std::string_view path);

/// Fingerprints of lines, which stay the same when other lines are added, so that findings can be
/// recognized in later reports.
///
/// This is the `primaryLocationLineHash` of GitHub's code scanning: a polynomial hash with base 37,
/// modulo 2^64, of the 100 UTF-16 code units from the beginning of the line, without spaces and
/// tabs, with line ends as line feeds, 0xFFFF for the end of the file and zeros after it. It is
/// written in hexadecimal, followed by `:n` for the n-th line with that value. GitHub's upload
/// action computes the same value and warns about differences.
class LineFingerprints {
 public:
  /// Caches the last file, by name.
  std::string of(const SourceFile& file, std::uint32_t line);

 private:
  std::string name_;
  std::vector<std::string> fingerprints_;  // by line
};

}  // namespace sdlc::lang
