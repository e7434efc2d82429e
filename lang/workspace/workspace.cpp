#include "lang/workspace/workspace.hpp"

#include <algorithm>
#include <utility>

namespace sdlc::lang {

namespace fs = std::filesystem;

void Workspace::open(const fs::path& path, std::string text, int version) {
  open_[identity(path)] = {.text = std::move(text), .version = version};
}

void Workspace::close(const fs::path& path) {
  open_.erase(identity(path));
  drop_unused();
}

bool Workspace::is_open(const fs::path& path) const { return find_open(path) != nullptr; }

const Workspace::OpenText* Workspace::find_open(const fs::path& path) const {
  if (open_.empty()) return nullptr;
  const auto found = open_.find(identity(path));
  return found == open_.end() ? nullptr : &found->second;
}

std::shared_ptr<const Document> Workspace::load(const fs::path& path, const std::string& name,
                                                std::uint64_t max_bytes, std::error_code& error) {
  std::optional<std::string> text = read(path, max_bytes, error);
  if (!text) return nullptr;
  const OpenText* open = find_open(path);
  const int version = open == nullptr ? 0 : open->version;
  std::weak_ptr<const Document>& entry = in_use_[name];
  auto document = entry.lock();
  const bool is_same =
      document != nullptr && document->version() == version && document->text() == *text;
  if (!is_same) {
    document = std::make_shared<const Document>(name, std::move(*text), version);
    entry = document;
  }
  if (!open_.empty()) {
    kept_[name] = {.identity = identity(path), .document = document};
    if (!is_same) loaded_bytes_ += document->text().size();
    if (loaded_bytes_ > kMaxKeptBytes) drop_unused();
  }
  return document;
}

void Workspace::set_dependencies(const fs::path& file, const std::vector<fs::path>& dependencies) {
  const fs::path from = identity(file);
  for (const fs::path& to : std::exchange(dependencies_[from], {})) {
    const auto found = dependents_.find(to);
    found->second.erase(from);
    if (found->second.empty()) dependents_.erase(found);
  }
  for (const fs::path& dependency : dependencies) {
    fs::path to = identity(dependency);
    if (dependents_[to].insert(from).second) dependencies_[from].push_back(std::move(to));
  }
  if (dependencies.empty()) dependencies_.erase(from);
  drop_unused();
}

void Workspace::drop_unused() {
  std::set<fs::path> used;
  const auto use = [&](const fs::path& file) {
    used.insert(file);
    const auto found = dependencies_.find(file);
    if (found != dependencies_.end()) used.insert(found->second.begin(), found->second.end());
  };
  for (const auto& [file, text] : open_) {
    use(file);
    for (const fs::path& dependent : dependents_of(file)) use(dependent);
  }
  loaded_bytes_ = 0;
  std::erase_if(kept_, [&](const auto& kept) { return !used.contains(kept.second.identity); });
  if (kept_bytes() > kMaxKeptBytes) {
    used = read_by_open_texts();
    std::erase_if(kept_, [&](const auto& kept) { return !used.contains(kept.second.identity); });
  }
  std::erase_if(in_use_, [](const auto& known) { return known.second.expired(); });
}

std::size_t Workspace::kept_bytes() const {
  std::size_t bytes = 0;
  for (const auto& [name, kept] : kept_) bytes += kept.document->text().size();
  return bytes;
}

std::set<fs::path> Workspace::read_by_open_texts() const {
  std::set<fs::path> files;
  std::vector<fs::path> pending;
  for (const auto& [file, text] : open_) pending.push_back(file);
  while (!pending.empty()) {
    const fs::path file = std::move(pending.back());
    pending.pop_back();
    if (!files.insert(file).second) continue;
    const auto found = dependencies_.find(file);
    if (found == dependencies_.end()) continue;
    pending.insert(pending.end(), found->second.begin(), found->second.end());
  }
  return files;
}

std::vector<fs::path> Workspace::dependents(const fs::path& path) const {
  return dependents_of(identity(path));
}

std::vector<fs::path> Workspace::dependents_of(const fs::path& start) const {
  std::set<fs::path> seen{start};
  std::vector<fs::path> pending(seen.begin(), seen.end()), all;
  while (!pending.empty()) {
    const fs::path file = std::move(pending.back());
    pending.pop_back();
    const auto found = dependents_.find(file);
    if (found == dependents_.end()) continue;
    for (const fs::path& dependent : found->second) {
      if (!seen.insert(dependent).second) continue;
      all.push_back(dependent);
      pending.push_back(dependent);
    }
  }
  std::ranges::sort(all);
  return all;
}

std::vector<fs::path> Workspace::roots(const fs::path& path) const {
  std::vector<fs::path> files = dependents(path);
  std::erase_if(files, [&](const fs::path& file) {
    return std::ranges::any_of(dependents_of(file), [&](const fs::path& dependent) {
      return !std::ranges::binary_search(dependents_of(dependent), file);
    });
  });
  return files;
}

std::optional<std::string> Workspace::read(const fs::path& path, std::uint64_t most,
                                           std::error_code& error) const {
  const OpenText* open = find_open(path);
  if (open == nullptr) return disk_.read(path, most, error);
  error.clear();
  return open->text.size() > most ? open->text.substr(0, most + 1) : open->text;
}

std::vector<FolderEntry> Workspace::list(const fs::path& folder) const {
  std::vector<FolderEntry> entries = disk_.list(folder);
  if (open_.empty()) return entries;
  const fs::path wanted = identity(folder / "any").parent_path();
  const std::size_t size = entries.size();
  for (const auto& [path, text] : open_) {
    if (path.parent_path() != wanted) continue;
    FolderEntry entry{.name = path.filename().string(), .is_folder = false};
    const auto on_disk = entries.begin() + static_cast<std::ptrdiff_t>(size);
    if (std::find(entries.begin(), on_disk, entry) == on_disk) entries.push_back(std::move(entry));
  }
  std::ranges::sort(entries, {}, &FolderEntry::name);
  return entries;
}

bool Workspace::is_special(const fs::path& path) const {
  return !is_open(path) && disk_.is_special(path);
}

}  // namespace sdlc::lang
