#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>

#include "lang/pack/zip.hpp"
#include "lang/pack/zip_format.hpp"
#include "lang/text/ascii.hpp"
#include "lang/text/display_width.hpp"
#include "lang/text/utf8.hpp"

namespace sdlc::lang {
namespace {

/// What both headers of an entry say.
struct Facts {
  std::uint16_t flags, method;
  std::uint32_t checksum, packed, size;
  std::string_view name;

  friend bool operator==(const Facts&, const Facts&) = default;
};

/// An entry of the directory.
struct Listed {
  Facts facts;
  std::uint32_t begin;  ///< of its local header
};

class Reader {
 public:
  Reader(std::string_view bytes, const Limits& limits) : bytes_(bytes), limits_(limits) {}

  std::vector<ZipEntry> run() {
    const std::vector<Listed> directory = read_directory();
    check_sizes(directory);
    std::vector<ZipEntry> entries;
    std::size_t at = 0;
    for (const Listed& listed : directory) {
      const Facts& facts = listed.facts;
      // Neither overlapping entries, of which few bytes become many files, nor hidden bytes.
      if (listed.begin != at) refuse(facts, "it does not follow the entry before it");
      at = skip_local_header(listed);
      const std::string_view packed = part(at, facts.packed);
      at += packed.size();
      if (at > directory_begin_) refuse(facts, "it overlaps the directory of the archive");
      entries.push_back({.name = std::string(facts.name), .content = unpacked(facts, packed)});
    }
    if (at != directory_begin_) throw ZipError("it has bytes that belong to no entry");
    return entries;
  }

 private:
  [[noreturn]] static void refuse(const Facts& facts, std::string_view reason) {
    // A NUL would end the message.
    const std::string name = printable(facts.name.substr(0, pack_limits::kName));
    throw ZipError(fmt::format("`{}`: {}", name, reason));
  }

  std::string_view part(std::size_t at, std::size_t size) const {
    if (at > bytes_.size() || size > bytes_.size() - at) throw ZipError("it is cut off");
    return bytes_.substr(at, size);
  }
  std::uint16_t number16(std::size_t at) const {
    const std::string_view bytes = part(at, 2);
    return static_cast<std::uint16_t>(static_cast<unsigned char>(bytes[0]) |
                                      static_cast<unsigned char>(bytes[1]) << 8);
  }
  std::uint32_t number32(std::size_t at) const {
    return number16(at) | static_cast<std::uint32_t>(number16(at + 2)) << 16;
  }

  std::vector<Listed> read_directory() {
    if (bytes_.size() < zip::kEndSize) throw ZipError("it is cut off");
    const std::size_t end = bytes_.size() - zip::kEndSize;
    if (number32(end) != zip::kEnd || number16(end + 20) != 0) {
      throw ZipError("it is cut off, or bytes follow its end");
    }
    const std::uint16_t count = number16(end + 10);
    const std::uint32_t size = number32(end + 12);
    directory_begin_ = number32(end + 16);
    const bool has_locator = end >= zip::kZip64LocatorSize &&
                             number32(end - zip::kZip64LocatorSize) == zip::kZip64Locator;
    if (has_locator || count == 0xFFFF || size == 0xFFFFFFFF || directory_begin_ == 0xFFFFFFFF) {
      throw ZipError("it has the form ZIP64, which is not read");
    }
    if (number16(end + 4) != 0 || number16(end + 6) != 0 || number16(end + 8) != count) {
      throw ZipError("it is a part of several");
    }
    if (count > pack_limits::kFiles) {
      throw ZipError(
          fmt::format("it has {} files; at most {} are read", count, pack_limits::kFiles));
    }
    if (directory_begin_ > end || size != end - directory_begin_) {
      throw ZipError("its directory is not before its end");
    }
    std::vector<Listed> directory;
    std::size_t at = directory_begin_;
    for (std::uint16_t i = 0; i < count; ++i) directory.push_back(read_listed(at));
    if (at != end) throw ZipError("its directory has another size than its end says");
    return directory;
  }

  /// `at`: of the first number that both headers have (4.3.7 and 4.3.12). `name_at`: of the name.
  Facts read_facts(std::size_t at, std::size_t name_at) const {
    Facts facts{.flags = number16(at + 2),
                .method = number16(at + 4),
                .checksum = number32(at + 10),
                .packed = number32(at + 14),
                .size = number32(at + 18),
                .name = {}};
    facts.name = part(name_at, number16(at + 22));
    return facts;
  }

  Listed read_listed(std::size_t& at) {
    if (number32(at) != zip::kDirectoryHeader) throw ZipError("its directory is damaged");
    const Listed listed{.facts = read_facts(at + 6, at + zip::kDirectorySize),
                        .begin = number32(at + 42)};
    check(listed.facts, number16(at + 6), number16(at + 34), number32(at + 38));
    const std::size_t after_name = number16(at + 30) + std::size_t{number16(at + 32)};
    at += zip::kDirectorySize + listed.facts.name.size();
    at += part(at, after_name).size();  // the extra field and the comment
    return listed;
  }

  void check(const Facts& facts, std::uint16_t version, std::uint16_t disk,
             std::uint32_t attributes) {
    using namespace zip;
    const std::uint32_t type = attributes >> 16 & kFileTypeMask;
    if (type == kFolder || (attributes & kDosFolder) != 0 || facts.name.ends_with('/')) {
      refuse(facts, "it is a folder; a pack has only files (`zip -D` leaves folders out)");
    }
    if (type == kSymbolicLink) refuse(facts, "it is a symbolic link, and not a file");
    if (type != 0 && type != kRegularFile) refuse(facts, "it is not a regular file");
    const std::string refusal = refusal_of_entry_name(facts.name);
    if (!refusal.empty()) refuse(facts, refusal);
    if (!names_.insert(facts.name).second) refuse(facts, "it is there twice");
    if ((facts.flags & (kEncrypted | kStronglyEncrypted | kHiddenHeaders)) != 0) {
      refuse(facts, "it is encrypted");
    }
    if ((facts.flags & kSizesAfterData) != 0) {
      refuse(facts, "its size follows its data, which is not read; pack into a file, not a pipe");
    }
    if ((facts.flags & ~kHarmlessFlags) != 0) {
      refuse(facts, fmt::format("its flags {:#06x} are unknown", facts.flags));
    }
    if (facts.packed == 0xFFFFFFFF || facts.size == 0xFFFFFFFF) {
      refuse(facts, "it has the form ZIP64, which is not read");
    }
    if (facts.method != kStored && facts.method != kDeflated) {
      refuse(facts, fmt::format("its compression is method {}; only deflate (8) and none (0) are "
                                "read",
                                facts.method));
    }
    if ((version & 0xFF) > kVersion) {
      refuse(facts, fmt::format("it needs version {}.{} of ZIP; 2.0 is read", (version & 0xFF) / 10,
                                (version & 0xFF) % 10));
    }
    if (disk != 0) throw ZipError("it is a part of several");
  }

  void check_sizes(const std::vector<Listed>& directory) const {
    std::uint64_t total = 0;
    for (const Listed& listed : directory) {
      const Facts& facts = listed.facts;
      if (facts.size > limits_.any_file()) {
        refuse(facts, fmt::format("it has more than {} bytes; `--limit data=N` allows more",
                                  limits_.any_file()));
      }
      if (facts.size > facts.packed * pack_limits::kRatio) {
        refuse(facts, fmt::format("it is compressed to less than 1/{} of its size, which no "
                                  "scene is",
                                  pack_limits::kRatio));
      }
      total += facts.size;
    }
    if (total > limits_.memory) {
      throw ZipError(fmt::format(
          "its files have more than {} bytes; `--limit memory=N` allows more", limits_.memory));
    }
  }

  /// Returns the place of the data.
  std::size_t skip_local_header(const Listed& listed) const {
    const std::size_t at = listed.begin;
    const std::size_t name_at = at + zip::kLocalSize;
    if (number32(at) != zip::kLocalHeader || read_facts(at + 4, name_at) != listed.facts) {
      refuse(listed.facts, "its header and the directory of the archive disagree");
    }
    const std::size_t extra_at = name_at + listed.facts.name.size();
    return extra_at + part(extra_at, number16(at + 28)).size();
  }

  static std::string unpacked(const Facts& facts, std::string_view packed) {
    std::string text = facts.method == zip::kStored ? std::string(packed) : inflated(facts, packed);
    const auto* data = reinterpret_cast<const Bytef*>(text.data());
    if (text.size() != facts.size || crc32_z(0, data, text.size()) != facts.checksum) {
      refuse(facts, "it is damaged");
    }
    return text;
  }

  static std::string inflated(const Facts& facts, std::string_view packed) {
    // One byte more than declared, so that more is noticed. It is never unpacked.
    std::string text(std::size_t{facts.size} + 1, '\0');
    z_stream stream{};
    if (inflateInit2(&stream, -15) != Z_OK) throw std::bad_alloc();  // no header
    // zlib does not write through next_in.
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = static_cast<uInt>(packed.size());
    stream.next_out = reinterpret_cast<Bytef*>(text.data());
    stream.avail_out = static_cast<uInt>(text.size());
    const bool is_whole = inflate(&stream, Z_FINISH) == Z_STREAM_END && stream.avail_in == 0;
    text.resize(stream.total_out);
    inflateEnd(&stream);
    if (!is_whole) refuse(facts, "it is damaged");
    return text;
  }

  std::string_view bytes_;
  const Limits& limits_;
  std::size_t directory_begin_ = 0;
  std::set<std::string_view> names_;
};

/// Whether it is a name in a folder, and no way to another.
bool is_name_in_folder(std::string_view name) {
  return !name.empty() && name != "." && name != "..";
}

}  // namespace

bool is_zip(std::string_view beginning) {
  // The second is an archive without files.
  return beginning.starts_with("PK\x03\x04") || beginning.starts_with("PK\x05\x06");
}

std::string refusal_of_entry_name(std::string_view name) {
  if (name.size() > pack_limits::kName) {
    return fmt::format("its name has more than {} bytes", pack_limits::kName);
  }
  for (std::string_view rest = name; !rest.empty();) {
    const DecodedChar c = decode_utf8(rest);
    if (!c.is_valid) return "its name is not UTF-8";
    if (c.code_point < 0x20 || c.code_point == 0x7F) return "its name has control characters";
    rest.remove_prefix(c.size);
  }
  if (name.find('\\') != std::string_view::npos) return "its name has a backslash";
  if (name.size() >= 2 && is_ascii_letter(name[0]) && name[1] == ':') {
    return "its name begins with a drive";
  }
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('/', begin), name.size());
    if (!is_name_in_folder(name.substr(begin, end - begin))) {
      return "its name is not a path inside the pack";
    }
    begin = end + 1;
  }
  return "";
}

std::vector<ZipEntry> read_zip(std::string_view bytes, const Limits& limits) {
  return Reader(bytes, limits).run();
}

}  // namespace sdlc::lang
