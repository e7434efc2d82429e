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
#include <system_error>

#include <sys/types.h>

#include "lang/source/source.hpp"

namespace sdlc::cli {

/// Notices when files are written, replaced, removed, or made where there were none. Changes on
/// this machine are noticed at once where the system tells (inotify), all others within a second.
class FileWatch {
 public:
  FileWatch();
  ~FileWatch();
  FileWatch(const FileWatch&) = delete;
  FileWatch& operator=(const FileWatch&) = delete;

  /// Watches a file, which need not be there, from its present state on. May be called by any
  /// thread.
  void add(const std::filesystem::path& path);
  std::size_t size() const;
  /// Waits for a change, for at most this long. Returns a file that is not as it was in add().
  std::optional<std::filesystem::path> wait(std::chrono::milliseconds time);

 private:
  struct State {
    dev_t device = 0;
    ino_t inode = 0;
    std::int64_t size = 0, seconds = 0, nanoseconds = 0;  // of the last modification

    bool operator==(const State&) const = default;
  };
  using Files = std::map<std::filesystem::path, std::optional<State>>;

  static std::optional<State> state_of(const std::filesystem::path& path);
  void watch_folder_of(const std::filesystem::path& path);
  std::optional<std::filesystem::path> find_changed();

  mutable std::mutex mutex_;
  Files files_;
  std::set<std::filesystem::path> folders_;
  int events_ = -1;  // of inotify; -1 if there is none
  std::chrono::steady_clock::time_point looked_ = std::chrono::steady_clock::now();
};

/// The files of this machine. All that are read are watched.
class WatchedFiles final : public lang::DiskFileSystem {
 public:
  explicit WatchedFiles(FileWatch& watch) : watch_(watch) {}

  std::optional<std::string> read(const std::filesystem::path& path, std::uint64_t max,
                                  std::error_code& error) const override {
    watch_.add(path);
    return DiskFileSystem::read(path, max, error);
  }

 private:
  FileWatch& watch_;
};

}  // namespace sdlc::cli
