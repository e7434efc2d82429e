#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace sdlc::lang {

/// A run of bytes [begin, end) of one source text. Offsets are 32 bits: a text is at most 4 GiB.
struct Span {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  constexpr std::uint32_t size() const noexcept { return end - begin; }
  friend constexpr bool operator==(const Span&, const Span&) = default;
};

/// A place as people count it, both from 1; a column is a Unicode code point.
struct Position {
  std::uint32_t line = 1;
  std::uint32_t column = 1;

  friend constexpr bool operator==(const Position&, const Position&) = default;
};

/// The two formats that scenes are written in.
enum class SourceFormat : std::uint8_t { Scene, Json };

/// The format that the name's extension speaks of; without a known extension, Json if the text
/// begins with a brace, which no scene does.
SourceFormat source_format_of(const std::filesystem::path& path, std::string_view text);

/// The text of one file and where its lines begin. Its address is its identity: spans of it are
/// only meaningful together with it.
class SourceFile {
 public:
  /// `name` is the file as the user named it; it is what diagnostics print.
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
  // Line starts are found when the first position is asked for: a file without mistakes needs none.
  const std::vector<std::uint32_t>& line_begins() const;

  std::string name_;
  std::string text_;
  SourceFormat format_;
  mutable std::vector<std::uint32_t> line_begins_;
};

/// A span together with its text.
struct Location {
  const SourceFile* file = nullptr;
  Span span;
};

/// Where texts come from; tests give one that needs no disk.
class FileSystem {
 public:
  virtual ~FileSystem() = default;

  /// The bytes of the file, or nothing with `error` set. Of a file of more than `most` bytes no
  /// more than the first `most` + 1 are read: whoever asked sees that it is too long.
  virtual std::optional<std::string> read(const std::filesystem::path& path, std::uint64_t most,
                                          std::error_code& error) const = 0;
  /// Whether it is there and neither a file nor a folder, such as a pipe: reading it may not end.
  virtual bool is_special(const std::filesystem::path& /*path*/) const { return false; }
  /// Where a symbolic link points to, as it says itself; nothing for all else.
  virtual std::optional<std::filesystem::path> link_target(
      const std::filesystem::path& /*path*/) const {
    return std::nullopt;
  }
  /// A name that is the same for every way to write the path of one file.
  virtual std::filesystem::path identity(const std::filesystem::path& path) const {
    return path.lexically_normal();
  }
};

/// The files of this machine.
class DiskFileSystem final : public FileSystem {
 public:
  std::optional<std::string> read(const std::filesystem::path& path, std::uint64_t most,
                                  std::error_code& error) const override;
  bool is_special(const std::filesystem::path& path) const override;
  std::optional<std::filesystem::path> link_target(
      const std::filesystem::path& path) const override;
  /// Absolute, symbolic links followed.
  std::filesystem::path identity(const std::filesystem::path& path) const override;
};

}  // namespace sdlc::lang
