#include "lang/source/source.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <functional>
#include <limits>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "lang/text/utf8.hpp"

namespace sdlc::lang {

SourceFormat source_format_of(const std::filesystem::path& path, std::string_view text) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension == ".json") return SourceFormat::Json;
  if (extension == ".scene") return SourceFormat::Scene;
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const bool has_brace = first != std::string_view::npos && text[first] == '{';
  return has_brace ? SourceFormat::Json : SourceFormat::Scene;
}

SourceFile::SourceFile(std::string name, std::string text)
    : name_(std::move(name)), text_(std::move(text)), format_(source_format_of(name_, text_)) {}

const std::vector<std::uint32_t>& SourceFile::line_begins() const {
  if (line_begins_.empty()) {
    line_begins_.push_back(0);
    for (std::size_t i = text_.find('\n'); i != std::string::npos; i = text_.find('\n', i + 1)) {
      line_begins_.push_back(static_cast<std::uint32_t>(i + 1));
    }
  }
  return line_begins_;
}

Position SourceFile::position(std::uint32_t offset) const noexcept {
  const auto& begins = line_begins();
  const auto after = std::upper_bound(begins.begin(), begins.end(), offset);
  const auto line = static_cast<std::uint32_t>(after - begins.begin());
  const std::uint32_t begin = begins[line - 1];
  const auto before = std::string_view(text_).substr(begin, offset - begin);
  const auto column = std::ranges::count_if(before, std::not_fn(is_continuation)) + 1;
  return {.line = line, .column = static_cast<std::uint32_t>(column)};
}

std::string_view SourceFile::line(std::uint32_t number) const noexcept {
  const auto& begins = line_begins();
  const std::size_t begin = begins[number - 1];
  const std::size_t end = number < begins.size() ? begins[number] : text_.size();
  std::string_view line = std::string_view(text_).substr(begin, end - begin);
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.remove_suffix(1);
  return line;
}

std::uint32_t SourceFile::line_begin(std::uint32_t number) const noexcept {
  return line_begins()[number - 1];
}

std::uint32_t SourceFile::line_count() const noexcept {
  return static_cast<std::uint32_t>(line_begins().size());
}

namespace {

/// Owns a file descriptor: closes it on destruction, unless it is a standard stream.
class Descriptor {
 public:
  explicit Descriptor(int fd) noexcept : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ > STDERR_FILENO) close(fd_);
  }
  int get() const noexcept { return fd_; }

 private:
  int fd_;
};

std::error_code last_error() { return {errno, std::generic_category()}; }

}  // namespace

std::optional<std::string> DiskFileSystem::read(const std::filesystem::path& path,
                                                std::uint64_t max, std::error_code& error) const {
  error.clear();
  const Descriptor file(path == "-" ? STDIN_FILENO : open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) {
    error = last_error();
    return std::nullopt;
  }
  struct stat info {};
  if (fstat(file.get(), &info) != 0) {
    error = last_error();
    return std::nullopt;
  }

  // Offsets into the text have 32 bits, so a longer text is an error.
  constexpr std::uint64_t kMaxText = std::numeric_limits<std::uint32_t>::max();
  const std::uint64_t end = std::min(max, kMaxText) + 1;
  // One byte more than a regular file has, so that its end is found without growing the buffer.
  // Pipes and devices have no size.
  const std::uint64_t expected =
      S_ISREG(info.st_mode) ? static_cast<std::uint64_t>(info.st_size) + 1 : 1 << 16;
  std::string text(std::min(expected, end), '\0');
  std::size_t used = 0;
  while (used < end) {
    if (used == text.size()) text.resize(std::min<std::uint64_t>(text.size() * 2, end));
    const ssize_t got = ::read(file.get(), text.data() + used, text.size() - used);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      error = last_error();
      return std::nullopt;
    }
    if (got == 0) break;
    used += static_cast<std::size_t>(got);
  }
  if (used > kMaxText) {
    error = std::make_error_code(std::errc::file_too_large);
    return std::nullopt;
  }
  text.resize(used);
  return text;
}

std::vector<FolderEntry> DiskFileSystem::list(const std::filesystem::path& folder) const {
  std::vector<FolderEntry> entries;
  std::error_code error;
  std::filesystem::directory_iterator at(folder.empty() ? "." : folder, error), end;
  for (; !error && at != end && entries.size() < kMaxEntries; at.increment(error)) {
    std::error_code ignored;
    entries.push_back({at->path().filename().string(), at->is_directory(ignored)});
  }
  std::ranges::sort(entries, {}, &FolderEntry::name);
  return entries;
}

bool DiskFileSystem::is_special(const std::filesystem::path& path) const {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  return std::filesystem::exists(status) && std::filesystem::is_other(status);
}

std::optional<std::filesystem::path> DiskFileSystem::link_target(
    const std::filesystem::path& path) const {
  std::error_code error;
  std::filesystem::path target = std::filesystem::read_symlink(path, error);
  return error ? std::nullopt : std::optional(std::move(target));
}

std::filesystem::path DiskFileSystem::identity(const std::filesystem::path& path) const {
  std::error_code error;
  // weakly_canonical() alone keeps a relative path of which nothing exists.
  const std::filesystem::path absolute = std::filesystem::absolute(path, error);
  if (error) return path.lexically_normal();
  const std::filesystem::path canonical = std::filesystem::weakly_canonical(absolute, error);
  return error ? absolute.lexically_normal() : canonical;
}

}  // namespace sdlc::lang
