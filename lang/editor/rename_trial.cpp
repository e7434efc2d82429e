#include "lang/editor/rename_trial.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace sdlc::lang {

namespace fs = std::filesystem;

namespace {

/// The replaced places of one file, and where they are in the new text.
class ReplacedPlaces {
 public:
  /// `places`: sorted; they must outlive this.
  ReplacedPlaces(std::string_view text, std::span<const Span> places, std::string_view new_name)
      : places_(places), new_size_(static_cast<std::uint32_t>(new_name.size())) {
    std::uint32_t end = 0;
    for (const Span place : places_) {
      new_text_ += text.substr(end, place.begin - end);
      new_text_ += new_name;
      end = place.end;
    }
    new_text_ += text.substr(end);
  }

  const std::string& new_text() const noexcept { return new_text_; }

  /// The offset in the new text. Offsets must not decrease from call to call.
  std::uint32_t moved(std::uint32_t offset) noexcept {
    while (next_ < places_.size() && places_[next_].end <= offset) {
      growth_ += static_cast<std::int64_t>(new_size_) - places_[next_].size();
      ++next_;
    }
    return static_cast<std::uint32_t>(offset + growth_);
  }

 private:
  std::span<const Span> places_;
  std::uint32_t new_size_;
  std::string new_text_;
  std::size_t next_ = 0;
  std::int64_t growth_ = 0;
};

bool is_same_shape(const SyntaxTree& a, const SyntaxTree& b) {
  return std::ranges::equal(a.nodes(), b.nodes(), [](const SyntaxNode& x, const SyntaxNode& y) {
    return x.kind == y.kind && x.extent == y.extent && x.op == y.op;
  });
}

/// The first name of the old table that has another place or meaning in the new one.
std::optional<Span> first_change_of_file(const SymbolTable& before, const SymbolTable& after,
                                         ReplacedPlaces& replaced) {
  const auto old_names = before.occurrences();
  const auto new_names = after.occurrences();
  for (std::size_t i = 0; i < old_names.size(); ++i) {
    const std::uint32_t begin = replaced.moved(old_names[i].where.begin);
    const std::uint32_t end = replaced.moved(old_names[i].where.end);
    const bool is_same = i < new_names.size() && new_names[i].where == Span{begin, end} &&
                         new_names[i].symbol == old_names[i].symbol;
    if (!is_same) return old_names[i].where;
  }
  const bool is_complete =
      old_names.size() == new_names.size() && is_same_shape(before.tree(), after.tree());
  return is_complete ? std::nullopt : std::optional(Span{});
}

}  // namespace

std::optional<Place> first_change(const SceneView& view, const PlaceSet& places,
                                  std::string_view new_name) {
  const Workspace& workspace = *view.options().workspace;
  Workspace trial_workspace(static_cast<const FileSystem&>(workspace));
  std::vector<ReplacedPlaces> replaced;
  for (std::uint32_t file = 0; file < view.file_count(); ++file) {
    const fs::path& path = view.module(file).path;
    // Also unchanged texts: the files of the disk may be newer.
    replaced.emplace_back(view.file(file).text(), places.in(workspace.identity(path)), new_name);
    trial_workspace.open(path, replaced.back().new_text());
  }
  ProgramOptions options = view.options();
  options.workspace = &trial_workspace;
  std::error_code error;
  auto root = trial_workspace.load(view.root().name(), options.limits.any_file(), error);
  if (!root) return Place{.path = view.root().name(), .where = {}};
  const SceneView trial(std::move(root), options);

  for (std::uint32_t file = 0; file < view.file_count(); ++file) {
    const fs::path& path = view.module(file).path;
    if (file >= trial.file_count()) return Place{.path = path, .where = {}};
    const auto change = first_change_of_file(view.table(file), trial.table(file), replaced[file]);
    if (change) return Place{.path = path, .where = *change};
  }
  return std::nullopt;
}

}  // namespace sdlc::lang
