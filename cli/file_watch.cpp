#include "cli/file_watch.hpp"

#include <array>
#include <thread>

#include <poll.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

namespace sdlc::cli {

namespace fs = std::filesystem;

FileWatch::FileWatch() : events_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {}

FileWatch::~FileWatch() {
  if (events_ >= 0) ::close(events_);
}

std::optional<FileWatch::State> FileWatch::state_of(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return State{.device = status.st_dev,
               .inode = status.st_ino,
               .size = status.st_size,
               .seconds = status.st_mtim.tv_sec,
               .nanoseconds = status.st_mtim.tv_nsec};
}

void FileWatch::add(const fs::path& path) {
  std::error_code ignored;
  const fs::path file = fs::absolute(path, ignored);
  const std::lock_guard lock(mutex_);
  if (files_.contains(file)) return;
  // The folders first: then a change after state_of() raises an event.
  watch_folder_of(file);
  if (fs::path target = fs::weakly_canonical(file, ignored); target != file) {
    watch_folder_of(target);
  }
  files_.emplace(file, state_of(file));
}

std::size_t FileWatch::size() const {
  const std::lock_guard lock(mutex_);
  return files_.size();
}

void FileWatch::watch_folder_of(const fs::path& path) {
  if (events_ < 0) return;
  std::error_code ignored;
  fs::path folder = path.parent_path();
  while (!fs::is_directory(folder, ignored) && folder != folder.parent_path()) {
    folder = folder.parent_path();
  }
  if (!folders_.insert(folder).second) return;
  // Not IN_CREATE and IN_MODIFY: then the file is not whole.
  ::inotify_add_watch(events_, folder.c_str(), IN_CLOSE_WRITE | IN_MOVED_TO);
}

std::optional<fs::path> FileWatch::wait(std::chrono::milliseconds time) {
  constexpr auto kMaxTime = std::chrono::seconds(1);
  pollfd poll{.fd = events_, .events = POLLIN, .revents = 0};
  if (::poll(&poll, 1, static_cast<int>(time.count())) > 0) {
    std::array<char, 4096> ignored{};
    while (::read(events_, ignored.data(), ignored.size()) > 0) {
    }
  } else if (std::chrono::steady_clock::now() - looked_ < kMaxTime) {
    return std::nullopt;
  }
  looked_ = std::chrono::steady_clock::now();
  return find_changed();
}

std::optional<fs::path> FileWatch::find_changed() {
  // Some editors move the old file away before they make the new one.
  constexpr auto kReplacing = std::chrono::milliseconds(100);
  Files files;
  {
    const std::lock_guard lock(mutex_);
    files = files_;
  }
  for (const auto& [path, before] : files) {
    std::optional<State> now = state_of(path);
    if (!now && before) {
      std::this_thread::sleep_for(kReplacing);
      now = state_of(path);
    }
    if (now != before) return path;
  }
  return std::nullopt;
}

}  // namespace sdlc::cli
