#include "lsp/folder_index.hpp"

#include <algorithm>
#include <exception>
#include <system_error>
#include <utility>

namespace sdlc::lsp {

namespace fs = std::filesystem;

namespace {

using std::chrono::milliseconds;

/// Typing goes on if the next character comes within this time.
constexpr milliseconds kQuietTime{300};
/// A shorter walk is not worth a progress bar.
constexpr milliseconds kSilentTime{500};
constexpr milliseconds kReportInterval{200};

}  // namespace

FolderIndex::FolderIndex(const lang::FileSystem& files, Events events, std::size_t max_scenes,
                         bool has_thread)
    : files_(files), events_(std::move(events)), max_scenes_(max_scenes), has_thread_(has_thread) {
  if (has_thread_) thread_ = std::thread([this] { run(); });
}

FolderIndex::~FolderIndex() {
  {
    const std::scoped_lock lock(mutex_);
    stop_.make();
  }
  wake_.notify_one();
  if (has_thread_) thread_.join();
}

// Changes

void FolderIndex::set_encoding(lang::PositionEncoding encoding) {
  const std::scoped_lock lock(mutex_);
  encoding_ = encoding;
}

void FolderIndex::set_folders(const std::vector<fs::path>& folders) {
  std::vector<fs::path> identities;
  for (const fs::path& folder : folders) identities.push_back(files_.identity(folder));
  const std::scoped_lock lock(mutex_);
  folders_ = std::move(identities);
  has_new_folders_ = true;
  wake_.notify_one();
}

void FolderIndex::update(const fs::path& path) {
  fs::path identity = files_.identity(path);
  const std::scoped_lock lock(mutex_);
  updates_[std::move(identity)] = Clock::now();
  wake_.notify_one();
}

void FolderIndex::open(const fs::path& path, std::shared_ptr<const std::string> text) {
  fs::path identity = files_.identity(path);
  if (identity.extension() != ".scene") return;
  const std::scoped_lock lock(mutex_);
  const bool is_new = !open_.contains(identity);
  open_[identity] = std::move(text);
  const bool waits = has_thread_ && !is_new;
  updates_[std::move(identity)] = Clock::now() + (waits ? kQuietTime : milliseconds(0));
  wake_.notify_one();
}

void FolderIndex::close(const fs::path& path) {
  fs::path identity = files_.identity(path);
  const std::scoped_lock lock(mutex_);
  if (open_.erase(identity) == 0) return;
  updates_[std::move(identity)] = Clock::now();
  wake_.notify_one();
}

// Answers

std::vector<fs::path> FolderIndex::files() const {
  const std::scoped_lock lock(mutex_);
  std::vector<fs::path> all;
  for (const auto& [path, facts] : facts_) all.push_back(path);
  return all;
}

std::vector<std::shared_ptr<const FileFacts>> FolderIndex::facts() const {
  const std::scoped_lock lock(mutex_);
  std::vector<std::shared_ptr<const FileFacts>> all;
  for (const auto& [path, facts] : facts_) all.push_back(facts);
  return all;
}

bool FolderIndex::is_complete() const {
  const std::scoped_lock lock(mutex_);
  return !is_busy_ && !has_work();
}

void FolderIndex::wait() const {
  std::unique_lock lock(mutex_);
  idle_.wait(lock, [this] { return !has_work() && updates_.empty() && !is_busy_; });
}

FolderIndex::Paths FolderIndex::dependents_of(const fs::path& path) const {
  Paths all;
  std::vector<fs::path> pending{path};
  while (!pending.empty()) {
    const auto found = dependents_.find(pending.back());
    pending.pop_back();
    if (found == dependents_.end()) continue;
    for (const fs::path& dependent : found->second) {
      if (dependent.native() != path.native() && all.insert(dependent).second) {
        pending.push_back(dependent);
      }
    }
  }
  return all;
}

std::vector<fs::path> FolderIndex::roots_of(const fs::path& path) const {
  const fs::path identity = files_.identity(path);
  const std::scoped_lock lock(mutex_);
  if (const auto known = roots_.find(identity); known != roots_.end()) return known->second;
  const Paths readers = dependents_of(identity);
  std::vector<fs::path> all(readers.begin(), readers.end());
  // A file of a cycle is a root if only files of the cycle read it.
  const auto is_root = [&](const fs::path& file) {
    if (!dependents_.contains(file)) return true;
    return std::ranges::all_of(dependents_of(file), [&](const fs::path& reader) {
      return dependents_of(reader).contains(file);
    });
  };
  std::ranges::stable_partition(all, is_root);
  constexpr std::size_t kMaxRoots = 64;  // an answer can have thousands of paths
  if (roots_.size() == kMaxRoots) roots_.clear();
  roots_[identity] = all;
  return all;
}

// The thread

void FolderIndex::run() {
  std::unique_lock lock(mutex_);
  while (!stop_.is_made()) {
    if (has_work()) {
      is_busy_ = true;
      try {
        step(lock);
      } catch (const lang::StopRequested&) {
        if (!lock.owns_lock()) lock.lock();
        break;
      } catch (const std::exception&) {  // out of memory: without that file
        if (!lock.owns_lock()) lock.lock();
      }
      is_busy_ = false;
      continue;
    }
    if (updates_.empty()) {
      idle_.notify_all();
      wake_.wait(lock);
    } else {
      const auto due =
          std::ranges::min_element(updates_, {}, [](const auto& update) { return update.second; });
      wake_.wait_until(lock, Clock::time_point(due->second));
    }
  }
  if (has_begun_)
    call(lock, [&] {
      if (events_.end) events_.end(progress_);
    });
}

void FolderIndex::run_due() {
  std::unique_lock lock(mutex_);
  while (has_work()) {
    try {
      step(lock);
    } catch (const std::exception&) {  // out of memory: without that file
      if (!lock.owns_lock()) lock.lock();
    }
  }
}

bool FolderIndex::has_work() const {
  const auto is_due = [now = Clock::now()](const auto& update) { return update.second <= now; };
  return has_new_folders_ || walk_ || !found_.empty() || std::ranges::any_of(updates_, is_due);
}

void FolderIndex::step(std::unique_lock<std::mutex>& lock) {
  if (has_new_folders_) return begin_walk();
  const auto now = Clock::now();
  const auto due =
      std::ranges::find_if(updates_, [&](const auto& update) { return update.second <= now; });
  if (due != updates_.end()) {
    const fs::path path = due->first;
    updates_.erase(due);
    return read_updated(lock, path);
  }
  walk(lock);
}

void FolderIndex::begin_walk() {
  has_new_folders_ = false;
  found_.clear();
  walked_.clear();
  progress_ = {};
  walk_begin_ = last_report_ = Clock::now();
  walk_.emplace(folders_, max_scenes_);
}

void FolderIndex::walk(std::unique_lock<std::mutex>& lock) {
  if (!found_.empty()) {
    const fs::path path = std::move(found_.back());
    found_.pop_back();
    read(lock, path);
    walked_.insert(path);
    ++progress_.read;
  } else {
    lock.unlock();
    std::optional<std::vector<fs::path>> scenes = walk_->next();
    if (scenes) {  // of which some may be links
      std::ranges::transform(*scenes, scenes->begin(),
                             [&](const fs::path& scene) { return files_.identity(scene); });
    }
    lock.lock();
    if (has_new_folders_) return;  // the new walk includes these
    progress_.is_limited = walk_->is_limited();
    if (!scenes) return end_walk(lock);
    found_.assign(scenes->rbegin(), scenes->rend());
  }
  report_walk(lock);
}

void FolderIndex::report_walk(std::unique_lock<std::mutex>& lock) {
  const auto now = Clock::now();
  if (now - walk_begin_ < kSilentTime || now - last_report_ < kReportInterval) return;
  last_report_ = now;
  const bool is_first = !std::exchange(has_begun_, true);
  call(lock, [&, progress = progress_] {
    if (is_first && events_.begin) events_.begin();
    if (events_.report) events_.report(progress);
  });
}

/// Forgets the files that the walk has not found.
void FolderIndex::end_walk(std::unique_lock<std::mutex>& lock) {
  walk_.reset();
  std::vector<fs::path> gone;
  for (const auto& [path, facts] : facts_) {
    if (!walked_.contains(path) && !open_.contains(path)) gone.push_back(path);
  }
  for (const fs::path& path : gone) replace(path, nullptr);
  const bool has_begun = std::exchange(has_begun_, false);
  call(lock, [&, progress = progress_] {
    if (has_begun && events_.end) events_.end(progress);
    if (events_.changed) events_.changed();
  });
}

void FolderIndex::read_updated(std::unique_lock<std::mutex>& lock, const fs::path& path) {
  bool is_changed = false;
  lock.unlock();
  std::error_code error;
  const bool is_folder = fs::is_directory(path, error);
  lock.lock();
  if (is_folder) {
    has_new_folders_ = true;  // with everything in it
  } else if (const bool is_inside = is_in_folders(path);
             is_inside || walked_.contains(path) || open_.contains(path)) {
    is_changed = read(lock, path);
    // The walk may have listed the folder before the file existed.
    if (is_inside) walked_.insert(path);
  } else {
    is_changed = replace(path, nullptr);
    is_changed |= remove_below(path);
  }
  if (is_changed && !walk_ && events_.changed) call(lock, events_.changed);
}

bool FolderIndex::is_in_folders(const fs::path& path) const {
  return std::ranges::any_of(folders_,
                             [&](const fs::path& folder) { return is_walked(folder, path); });
}

std::optional<std::string> FolderIndex::text_of(std::unique_lock<std::mutex>& lock,
                                                const fs::path& path) {
  if (const auto found = open_.find(path); found != open_.end()) {
    const std::shared_ptr<const std::string> text = found->second;
    lock.unlock();
    return *text;
  }
  lock.unlock();
  if (files_.is_special(path)) return std::nullopt;
  std::error_code error;
  std::optional<std::string> text = files_.read(path, lang::Limits().file, error);
  if (text && text->size() > lang::Limits().file) return std::nullopt;  // no command reads it
  return text;
}

bool FolderIndex::read(std::unique_lock<std::mutex>& lock, const fs::path& path) {
  const lang::PositionEncoding encoding = encoding_;
  std::optional<std::string> text = text_of(lock, path);
  std::shared_ptr<const FileFacts> facts;
  if (text) {
    facts = std::make_shared<const FileFacts>(
        read_facts(path, *std::move(text), files_, encoding, &stop_));
  }
  lock.lock();
  return replace(path, std::move(facts));
}

/// Replaces the facts of a file; null: it is gone. Returns whether its dependencies have changed.
bool FolderIndex::replace(const fs::path& path, std::shared_ptr<const FileFacts> facts) {
  const auto known = facts_.find(path);
  std::vector<fs::path> before, after;
  if (known != facts_.end()) before = known->second->dependencies;
  if (facts) after = facts->dependencies;
  for (const fs::path& dependency : before) {
    const auto found = dependents_.find(dependency);
    found->second.erase(path);
    if (found->second.empty()) dependents_.erase(found);
  }
  for (const fs::path& dependency : after) dependents_[dependency].insert(path);
  if (before != after) roots_.clear();
  const bool is_new = (known == facts_.end()) != (facts == nullptr);
  if (facts) {
    facts_[path] = std::move(facts);
  } else if (known != facts_.end()) {
    facts_.erase(known);
  }
  return is_new || before != after;
}

bool FolderIndex::remove_below(const fs::path& folder) {
  const std::string prefix = folder.native() + '/';
  std::vector<fs::path> gone;
  for (auto file = facts_.lower_bound(prefix);
       file != facts_.end() && file->first.native().starts_with(prefix); ++file) {
    if (!open_.contains(file->first)) gone.push_back(file->first);
  }
  for (const fs::path& path : gone) replace(path, nullptr);
  return !gone.empty();
}

/// Calls an event without the lock: it may ask the index.
void FolderIndex::call(std::unique_lock<std::mutex>& lock, const std::function<void()>& event) {
  lock.unlock();
  event();
  lock.lock();
}

}  // namespace sdlc::lsp
