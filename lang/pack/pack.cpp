#include "lang/pack/pack.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lang/text/display_width.hpp"

namespace sdlc::lang {
namespace {

namespace fs = std::filesystem;

constexpr int kFormat = 1;

std::string read_index(std::string_view text) {
  const auto fail = [](std::string_view reason) {
    throw ZipError(fmt::format("its {} {}", kPackIndex, reason));
  };
  if (text.size() > pack_limits::kIndex) fail("is too large");
  const auto index = nlohmann::json::parse(text, nullptr, false);
  if (!index.is_object() || !index.contains("format") || !index["format"].is_number_integer()) {
    fail("is not that of a pack");
  }
  if (index["format"] != kFormat) fail("is that of another version of sdlc");
  if (!index.contains("scene") || !index["scene"].is_string()) fail("names no scene");
  return index["scene"].get<std::string>();
}

class NotInPack final : public std::error_category {
 public:
  const char* name() const noexcept override { return "pack"; }
  std::string message(int) const override { return "it is not in the pack"; }
};

std::error_code not_in_pack() {
  static const NotInPack category;
  return {1, category};
}

}  // namespace

Pack read_pack(std::string_view archive, const Limits& limits) {
  if (!is_zip(archive)) throw ZipError("it is not a ZIP archive");
  Pack pack;
  for (ZipEntry& entry : read_zip(archive, limits)) {
    pack.files.emplace(std::move(entry.name), std::move(entry.content));
  }
  const auto index = pack.files.find(kPackIndex);
  if (index == pack.files.end()) {
    throw ZipError(fmt::format("it has no {}; `sdlc pack` makes packs", kPackIndex));
  }
  pack.scene = read_index(index->second);
  pack.files.erase(index);
  if (!pack.files.contains(pack.scene)) {
    throw ZipError(fmt::format("its scene `{}` is missing", printable(pack.scene)));
  }
  return pack;
}

std::string write_pack(const Pack& pack) {
  if (pack.files.contains(kPackIndex)) {
    throw ZipError(fmt::format("`{}` is the name of its index; rename the file", kPackIndex));
  }
  // Before the index, which throws for bytes that are not UTF-8.
  const std::string refusal = refusal_of_entry_name(pack.scene);
  if (!refusal.empty()) throw ZipError(fmt::format("`{}`: {}", pack.scene, refusal));
  const nlohmann::ordered_json index{{"format", kFormat}, {"scene", pack.scene}};
  std::vector<ZipEntry> entries{{.name = kPackIndex, .content = index.dump() + "\n"}};
  for (const auto& [name, text] : pack.files) entries.push_back({.name = name, .content = text});
  return write_zip(entries);
}

std::optional<std::string> PackFiles::name_of(const fs::path& path) const {
  const fs::path normal = path.lexically_normal();
  const auto [root_end, rest] = std::ranges::mismatch(root_, normal);
  if (root_end != root_.end()) return std::nullopt;
  fs::path name;
  for (auto part = rest; part != normal.end(); ++part) name /= *part;
  return name.generic_string();
}

std::optional<std::string> PackFiles::read(const fs::path& path, std::uint64_t max,
                                           std::error_code& error) const {
  error.clear();
  const std::optional<std::string> name = name_of(path);
  const auto found = name ? pack_.files.find(*name) : pack_.files.end();
  if (found == pack_.files.end()) {
    error = not_in_pack();
    return std::nullopt;
  }
  const std::string& text = found->second;
  return text.size() > max ? text.substr(0, static_cast<std::size_t>(max) + 1) : text;
}

std::vector<FolderEntry> PackFiles::list(const fs::path& folder) const {
  std::vector<FolderEntry> entries;
  const std::optional<std::string> name = name_of(folder / "");
  if (!name) return entries;
  for (auto file = pack_.files.lower_bound(*name);
       file != pack_.files.end() && file->first.starts_with(*name) && entries.size() < kMaxEntries;
       ++file) {
    const std::string rest = file->first.substr(name->size());
    const std::size_t end = rest.find('/');
    FolderEntry entry{.name = rest.substr(0, end), .is_folder = end != std::string::npos};
    if (entries.empty() || entries.back() != entry) entries.push_back(std::move(entry));
  }
  return entries;
}

}  // namespace sdlc::lang
