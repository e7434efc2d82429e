#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <sys/types.h>

#include "lang/source/source.hpp"

namespace sdlc::cli {

/// Notices when files are written, replaced, removed, or made where there were none, and have other
/// contents than before: changes on this machine at once, by inotify where it is there, all others
/// within a second. Several readers, such as scenes, may watch one file.
class FileWatch {
 public:
  using Reader = std::size_t;
  struct Change {
    std::filesystem::path path;
    Reader reader = 0;
  };

  FileWatch();
  ~FileWatch();
  FileWatch(const FileWatch&) = delete;
  FileWatch& operator=(const FileWatch&) = delete;

  // All functions but wait() may be called by any thread.

  /// Watches a file, which need not be there, from its present state on; to be called before it is
  /// read, also again.
  void add(const std::filesystem::path& path, Reader reader = 0);
  /// What has been read of a watched file after add(): the same contents are no change.
  void note_contents(const std::filesystem::path& path, std::string_view contents,
                     Reader reader = 0);
  /// The files of this reader are not watched any more.
  void forget(Reader reader);
  /// The number of files.
  std::size_t size() const;
  /// Waits for changes, for at most this long. Returns a file of each reader that is not as it was
  /// in add(), and forgets these readers.
  std::vector<Change> wait(std::chrono::milliseconds time);

 private:
  struct State {
    dev_t device = 0;
    ino_t inode = 0;
    std::int64_t size = 0, seconds = 0, nanoseconds = 0;  // of the last modification

    bool operator==(const State&) const = default;
  };
  struct Contents {
    std::size_t size = 0;
    std::uint64_t hash = 0;

    bool operator==(const Contents&) const = default;
  };
  struct File {
    std::optional<State> state;        // nullopt: it is not there
    std::optional<Contents> contents;  // nullopt: unknown
  };
  using Key = std::pair<Reader, std::filesystem::path>;

  static std::optional<State> state_of(const std::filesystem::path& path);
  static std::optional<Contents> contents_of(const std::filesystem::path& path, std::size_t size);
  static Contents summary_of(std::string_view contents);
  void watch_folder_of(const std::filesystem::path& path);
  std::vector<Change> find_changed(bool has_event);
  /// Whether the file has other contents than `before`.
  bool has_changed(const Key& key, const File& before, bool has_event);

  mutable std::mutex mutex_;
  std::map<Key, File> files_;
  int events_ = -1;  // of inotify; -1 if there is none
  std::chrono::steady_clock::time_point looked_ = std::chrono::steady_clock::now();
};

/// The files of this machine. All that are read are watched.
class WatchedFiles final : public lang::DiskFileSystem {
 public:
  explicit WatchedFiles(FileWatch& watch, FileWatch::Reader reader = 0)
      : watch_(watch), reader_(reader) {}

  std::optional<std::string> read(const std::filesystem::path& path, std::uint64_t max,
                                  std::error_code& error) const override {
    watch_.add(path, reader_);
    std::optional<std::string> text = DiskFileSystem::read(path, max, error);
    if (text && text->size() <= max) watch_.note_contents(path, *text, reader_);
    return text;
  }

 private:
  FileWatch& watch_;
  FileWatch::Reader reader_;
};

}  // namespace sdlc::cli
