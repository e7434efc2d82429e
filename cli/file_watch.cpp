#include "cli/file_watch.hpp"

#include <array>
#include <functional>
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

std::optional<FileWatch::Contents> FileWatch::contents_of(const fs::path& path, std::size_t size) {
  const lang::DiskFileSystem disk;
  std::error_code ignored;
  if (disk.is_special(path)) return std::nullopt;
  const std::optional<std::string> text = disk.read(path, size, ignored);
  return text ? std::optional(summary_of(*text)) : std::nullopt;
}

FileWatch::Contents FileWatch::summary_of(std::string_view contents) {
  return {.size = contents.size(), .hash = std::hash<std::string_view>()(contents)};
}

void FileWatch::add(const fs::path& path, Reader reader) {
  std::error_code ignored;
  const fs::path file = fs::absolute(path, ignored);
  const std::lock_guard lock(mutex_);
  // The folders first: then a change after state_of() raises an event.
  watch_folder_of(file);
  if (fs::path target = fs::weakly_canonical(file, ignored); target != file) {
    watch_folder_of(target);
  }
  files_[{reader, file}] = {.state = state_of(file), .contents = std::nullopt};
}

void FileWatch::note_contents(const fs::path& path, std::string_view contents, Reader reader) {
  std::error_code ignored;
  const fs::path file = fs::absolute(path, ignored);
  const std::lock_guard lock(mutex_);
  const auto found = files_.find({reader, file});
  if (found != files_.end()) found->second.contents = summary_of(contents);
}

void FileWatch::forget(Reader reader) {
  const std::lock_guard lock(mutex_);
  std::erase_if(files_, [&](const auto& file) { return file.first.first == reader; });
}

std::size_t FileWatch::size() const {
  const std::lock_guard lock(mutex_);
  std::set<fs::path> paths;
  for (const auto& [key, file] : files_) paths.insert(key.second);
  return paths.size();
}

void FileWatch::watch_folder_of(const fs::path& path) {
  if (events_ < 0) return;
  std::error_code ignored;
  fs::path folder = path.parent_path();
  while (!fs::is_directory(folder, ignored) && folder != folder.parent_path()) {
    folder = folder.parent_path();
  }
  // It may be watched already; or one that has been removed and made again. Not IN_CREATE and
  // IN_MODIFY: then the file is not whole.
  ::inotify_add_watch(events_, folder.c_str(), IN_CLOSE_WRITE | IN_MOVED_TO);
}

std::vector<FileWatch::Change> FileWatch::wait(std::chrono::milliseconds time) {
  constexpr auto kMaxTime = std::chrono::seconds(1);
  pollfd poll{.fd = events_, .events = POLLIN, .revents = 0};
  const bool has_event = ::poll(&poll, 1, static_cast<int>(time.count())) > 0;
  if (has_event) {
    std::array<char, 4096> ignored{};
    while (::read(events_, ignored.data(), ignored.size()) > 0) {
    }
  } else if (std::chrono::steady_clock::now() - looked_ < kMaxTime) {
    return {};
  }
  looked_ = std::chrono::steady_clock::now();
  std::vector<Change> changes = find_changed(has_event);
  for (const Change& change : changes) forget(change.reader);
  return changes;
}

std::vector<FileWatch::Change> FileWatch::find_changed(bool has_event) {
  std::map<Key, File> files;
  {
    const std::lock_guard lock(mutex_);
    files = files_;
  }
  std::vector<Change> changes;
  for (const auto& [key, before] : files) {  // by reader
    const auto& [reader, path] = key;
    if (!changes.empty() && changes.back().reader == reader) continue;
    if (has_changed(key, before, has_event)) changes.push_back({.path = path, .reader = reader});
  }
  return changes;
}

bool FileWatch::has_changed(const Key& key, const File& before, bool has_event) {
  // Some editors move the old file away before they make the new one; and a file that no
  // event has reported may be half written.
  constexpr auto kReplacing = std::chrono::milliseconds(100);
  const fs::path& path = key.second;
  std::optional<State> now = state_of(path);
  if (now == before.state) return false;
  if (!now || !has_event) {
    std::this_thread::sleep_for(kReplacing);
    const std::optional<State> later = state_of(path);
    if (later && later != now && !has_event) return false;  // it is being written
    now = later;
  }
  if (now == before.state) return false;
  if (!now || !before.contents) return true;
  if (contents_of(path, before.contents->size) != before.contents) return true;
  const std::lock_guard lock(mutex_);
  const auto found = files_.find(key);
  if (found != files_.end() && found->second.state == before.state) found->second.state = now;
  return false;
}

}  // namespace sdlc::cli
