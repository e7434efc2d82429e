#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace sdlc::lang {

/// The bytes [begin, end) of a source text. Offsets have 32 bits: a text has at most 4 GiB.
struct Span {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  constexpr std::uint32_t size() const noexcept { return end - begin; }
  friend constexpr bool operator==(const Span&, const Span&) = default;
};

/// Line and column count from 1; a column is a Unicode code point.
struct Position {
  std::uint32_t line = 1;
  std::uint32_t column = 1;

  friend constexpr bool operator==(const Position&, const Position&) = default;
};

/// The formats of scenes.
enum class SourceFormat : std::uint8_t { Scene, Json };

/// The format by the extension of the name; for an unknown extension, Json if the text begins with
/// a brace, as no scene does.
SourceFormat source_format_of(const std::filesystem::path& path, std::string_view text);

/// The text of a file and its line starts. Its address is its identity: spans are meaningful only
/// together with it.
class SourceFile {
 public:
  /// `name`: the path as given by the user; diagnostics print it.
  SourceFile(std::string name, std::string text);
  virtual ~SourceFile() = default;

  const std::string& name() const noexcept { return name_; }
  SourceFormat format() const noexcept { return format_; }
  std::string_view text() const noexcept { return text_; }
  std::string_view text(Span span) const noexcept {
    return std::string_view(text_).substr(span.begin, span.size());
  }

  Position position(std::uint32_t offset) const noexcept;

  /// The line (from 1) without its line end. Precondition: the line exists.
  std::string_view line(std::uint32_t number) const noexcept;
  std::uint32_t line_begin(std::uint32_t number) const noexcept;
  std::uint32_t line_count() const noexcept;

 private:
  // Computed on the first request for a position: a file without mistakes needs none.
  const std::vector<std::uint32_t>& line_begins() const;

  std::string name_;
  std::string text_;
  SourceFormat format_;
  mutable std::vector<std::uint32_t> line_begins_;
};

/// A span and its file.
struct Location {
  const SourceFile* file = nullptr;
  Span span;
};

struct FolderEntry {
  std::string name;
  bool is_folder = false;

  friend bool operator==(const FolderEntry&, const FolderEntry&) = default;
};
/// The contents of a folder; none if it must not or cannot be read.
using PathLister = std::function<std::vector<FolderEntry>(const std::filesystem::path& folder)>;

/// The source of texts; tests have one without a disk.
class FileSystem {
 public:
  virtual ~FileSystem() = default;

  /// The bytes of the file, or nullopt with `error` set. Reads at most `max` + 1 bytes, so that the
  /// caller can recognize a file that is too large.
  virtual std::optional<std::string> read(const std::filesystem::path& path, std::uint64_t max,
                                          std::error_code& error) const = 0;
  /// The files and folders in a folder, by name; none if it cannot be read. Of a folder with more
  /// than kMaxEntries any of them are left out.
  virtual std::vector<FolderEntry> list(const std::filesystem::path& /*folder*/) const {
    return {};
  }
  static constexpr std::size_t kMaxEntries = 2000;
  /// Whether the path is a pipe or a device: reading it may not end.
  virtual bool is_special(const std::filesystem::path& /*path*/) const { return false; }
  /// The target of a symbolic link, as written in the link; nullopt for other files.
  virtual std::optional<std::filesystem::path> link_target(
      const std::filesystem::path& /*path*/) const {
    return std::nullopt;
  }
  /// A name that is the same for all paths of one file.
  virtual std::filesystem::path identity(const std::filesystem::path& path) const {
    return path.lexically_normal();
  }
};

/// The files of this machine.
class DiskFileSystem : public FileSystem {
 public:
  std::optional<std::string> read(const std::filesystem::path& path, std::uint64_t max,
                                  std::error_code& error) const override;
  std::vector<FolderEntry> list(const std::filesystem::path& folder) const override;
  bool is_special(const std::filesystem::path& path) const override;
  std::optional<std::filesystem::path> link_target(
      const std::filesystem::path& path) const override;
  /// The absolute path with symbolic links resolved, whether the file exists or not.
  std::filesystem::path identity(const std::filesystem::path& path) const override;
};

}  // namespace sdlc::lang
