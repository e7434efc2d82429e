#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>

#include "lang/pack/zip.hpp"
#include "lang/pack/zip_format.hpp"

namespace sdlc::lang {
namespace {

constexpr std::uint16_t kMidnight = 0, kFirstOf1980 = 0x21;  // the zero of MS-DOS times
constexpr std::uint16_t kMadeOnUnix = 3 << 8;
constexpr std::uint32_t kMode = zip::kRegularFile | 0644;

/// The text by deflate without a header; empty if it would not be smaller, or if a reader would
/// take it for a bomb.
std::string deflated(const std::string& text) {
  z_stream stream{};
  // 15: the largest window; negative: without a header. 8: the default memory.
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();
  }
  std::string packed(text.size(), '\0');
  // zlib does not write through next_in.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const bool is_smaller = deflate(&stream, Z_FINISH) == Z_STREAM_END;
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  const bool is_suspicious = packed.size() * pack_limits::kRatio < text.size();
  return is_smaller && !is_suspicious ? packed : std::string();
}

class Writer {
 public:
  std::string run(const std::vector<ZipEntry>& entries) {
    if (entries.size() > pack_limits::kFiles) {
      throw ZipError(fmt::format("it would have more than {} files", pack_limits::kFiles));
    }
    for (const ZipEntry& entry : entries) add(entry);
    const std::size_t files = archive_.size();
    archive_ += directory_;
    if (archive_.size() > std::numeric_limits<std::uint32_t>::max()) {
      throw ZipError("it would have more than 4 GiB");
    }
    const auto count = static_cast<std::uint16_t>(entries.size());
    put32(archive_, zip::kEnd);
    put16(archive_, 0);  // the disk, and that of the directory
    put16(archive_, 0);
    put16(archive_, count);  // on this disk, and on all
    put16(archive_, count);
    put32(archive_, static_cast<std::uint32_t>(directory_.size()));
    put32(archive_, static_cast<std::uint32_t>(files));
    put16(archive_, 0);  // no comment
    return std::move(archive_);
  }

 private:
  static void put16(std::string& out, std::uint32_t number) {
    out += static_cast<char>(number & 0xFF);
    out += static_cast<char>(number >> 8 & 0xFF);
  }
  static void put32(std::string& out, std::uint32_t number) {
    put16(out, number);
    put16(out, number >> 16);
  }

  void add(const ZipEntry& entry) {
    const std::string refusal = refusal_of_entry_name(entry.name);
    if (!refusal.empty()) throw ZipError(fmt::format("`{}`: {}", entry.name, refusal));
    if (entry.content.size() >= std::numeric_limits<std::uint32_t>::max() ||
        archive_.size() >= std::numeric_limits<std::uint32_t>::max()) {
      throw ZipError("it would have more than 4 GiB");
    }
    const std::string packed = deflated(entry.content);
    const std::string& data = packed.empty() ? entry.content : packed;
    std::string common;  // the part that both headers have (4.3.7 and 4.3.12)
    put16(common, zip::kVersion);
    put16(common, zip::kUtf8);
    put16(common, packed.empty() ? zip::kStored : zip::kDeflated);
    put16(common, kMidnight);
    put16(common, kFirstOf1980);
    put32(common,
          static_cast<std::uint32_t>(crc32_z(
              0, reinterpret_cast<const Bytef*>(entry.content.data()), entry.content.size())));
    put32(common, static_cast<std::uint32_t>(data.size()));
    put32(common, static_cast<std::uint32_t>(entry.content.size()));
    put16(common, static_cast<std::uint32_t>(entry.name.size()));
    put16(common, 0);  // no extra field

    put32(directory_, zip::kDirectoryHeader);
    put16(directory_, kMadeOnUnix | zip::kVersion);
    directory_ += common;
    put16(directory_, 0);  // no comment
    put16(directory_, 0);  // the disk
    put16(directory_, 0);  // no claim that it is a text
    put32(directory_, kMode << 16);
    put32(directory_, static_cast<std::uint32_t>(archive_.size()));
    directory_ += entry.name;

    put32(archive_, zip::kLocalHeader);
    archive_ += common;
    archive_ += entry.name;
    archive_ += data;
  }

  std::string archive_, directory_;
};

}  // namespace

std::string write_zip(const std::vector<ZipEntry>& entries) { return Writer().run(entries); }

}  // namespace sdlc::lang
