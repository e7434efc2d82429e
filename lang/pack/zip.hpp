#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "lang/source/limits.hpp"

/// ZIP archives in memory. zlib compresses; the container is read and written here, because a
/// reader of all that ZIP allows accepts what two programs understand differently: overlapping
/// entries, headers that disagree, sizes after the data. Described in PKWARE's APPNOTE.TXT, whose
/// section numbers are in the sources.
namespace sdlc::lang {

/// A file in an archive.
struct ZipEntry {
  std::string name;  ///< relative, with `/` between folders
  std::string content;

  friend bool operator==(const ZipEntry&, const ZipEntry&) = default;
};

/// An archive that is not read, or cannot be written; the message says why.
class ZipError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Whether a file with this beginning (4 bytes) is an archive.
bool is_zip(std::string_view beginning);

/// Why an archive must not have a file of this name; empty if it may.
std::string refusal_of_entry_name(std::string_view name);

/// All files, in the order of the archive, with their checksums verified. Reads what write_zip()
/// writes, and what common programs write for regular files: entries one after the other, stored or
/// deflated, with their sizes before their data. Refuses everything else, and archives beyond the
/// limits, before anything of that size is in memory. Throws ZipError.
std::vector<ZipEntry> read_zip(std::string_view bytes, const Limits& limits);

/// The archive of these files, in this order. It depends on nothing else, except on the version of
/// zlib. Throws ZipError.
std::string write_zip(const std::vector<ZipEntry>& entries);

}  // namespace sdlc::lang
