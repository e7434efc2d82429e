#include "lang/editor/navigation.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "lang/ast/ast.hpp"
#include "lang/editor/cursor.hpp"
#include "lang/editor/links.hpp"

namespace sdlc::lang {

namespace fs = std::filesystem;

namespace {

enum class ImportTarget : std::uint8_t { File, Statement };

/// The import or include whose path is at the offset.
std::optional<ast::Node> linking_statement_at(const SyntaxTree& tree, std::uint32_t offset) {
  const auto nodes = tree.nodes();
  // The last node that begins at or before the offset: a String is a leaf.
  const auto after = std::ranges::upper_bound(nodes, offset, {}, &SyntaxNode::begin);
  if (after == nodes.begin()) return std::nullopt;
  const auto index = static_cast<NodeIndex>(after - nodes.begin() - 1);
  const SyntaxNode& node = nodes[index];
  if (node.kind != SyntaxKind::String || offset > node.end || index == 0) return std::nullopt;
  const ast::Node parent(tree, index - 1);
  const bool is_link = parent.is(SyntaxKind::Import) || parent.is(SyntaxKind::Include);
  return is_link ? std::optional(parent) : std::nullopt;
}

/// The file of an import: the one that was loaded, or else the one that it names.
std::optional<fs::path> file_of_import(const SceneView& view, std::uint32_t file,
                                       const Symbol& import) {
  const Module& module = view.module(file);
  const auto known = module.imports.find(import.name);
  const bool is_loaded = known != module.imports.end() && known->second.node == import.node &&
                         known->second.module < view.file_count();
  if (is_loaded) return view.module(known->second.module).path;
  return link_target(module.tree, import.node, module.path);
}

std::optional<JumpTarget> target_of_path(const SceneView& view, std::uint32_t file,
                                         std::uint32_t offset) {
  const auto statement = linking_statement_at(view.tree(file), offset);
  if (!statement) return std::nullopt;
  auto target = link_target(view.tree(file), statement->index(), view.module(file).path);
  if (!target) return std::nullopt;
  return JumpTarget{.origin = statement->first(SyntaxKind::String)->span(),
                    .path = *std::move(target),
                    .whole = {},
                    .where = {}};
}

std::optional<JumpTarget> find_target(const SceneView& view, std::uint32_t file,
                                      std::uint32_t offset, ImportTarget target) {
  if (auto found = target_of_path(view, file, offset)) return found;
  const Occurrence* name = view.table(file).at(offset);
  const Symbol* symbol = name == nullptr ? nullptr : view.index().find(name->symbol);
  if (symbol == nullptr) return std::nullopt;
  const std::uint32_t owner = name->symbol.file;
  if (symbol->kind == SymbolKind::Import && target == ImportTarget::File) {
    auto path = file_of_import(view, owner, *symbol);
    if (!path) return std::nullopt;
    return JumpTarget{.origin = name->where, .path = *std::move(path), .whole = {}, .where = {}};
  }
  return JumpTarget{.origin = name->where,
                    .path = view.module(owner).path,
                    .whole = view.tree(owner)[symbol->node].span(),
                    .where = symbol->where};
}

bool is_used_only_in_its_file(const Symbol& symbol) {
  return symbol.is_local || symbol.is_duplicate || symbol.kind == SymbolKind::LoopVariable ||
         symbol.kind == SymbolKind::Import || symbol.kind == SymbolKind::Object;
}

}  // namespace

std::optional<JumpTarget> definition(const SceneView& view, std::uint32_t file,
                                     std::uint32_t offset) {
  return find_target(view, file, offset, ImportTarget::File);
}

std::optional<JumpTarget> declaration(const SceneView& view, std::uint32_t file,
                                      std::uint32_t offset) {
  return find_target(view, file, offset, ImportTarget::Statement);
}

std::optional<SharedSymbol> shared_symbol(const SceneView& view, std::uint32_t file,
                                          std::uint32_t offset) {
  const SymbolId id = view.index().at(file, offset);
  if (!id.is_known()) return std::nullopt;
  if (id.is_builtin()) return SharedSymbol{.path = {}, .index = id.index};
  const Symbol* symbol = view.index().find(id);
  if (symbol == nullptr) return std::nullopt;
  return SharedSymbol{.path = view.module(id.file).path,
                      .index = id.index,
                      .where = symbol->where,
                      .is_local_to_file = is_used_only_in_its_file(*symbol)};
}

SymbolId symbol_in(const SceneView& view, const SharedSymbol& symbol) {
  if (symbol.path.empty()) return {SymbolId::kBuiltinFile, symbol.index};
  const auto file = view.find(symbol.path);
  if (!file) return {};
  const Symbol* found = view.table(*file).find(symbol.index);
  const bool is_same = found != nullptr && found->where == symbol.where;
  return is_same ? SymbolId{*file, symbol.index} : SymbolId();
}

std::vector<FileSpan> PlaceSet::add(const SceneView& view, std::span<const FileSpan> places) {
  std::vector<FileSpan> added;
  for (auto first = places.begin(); first != places.end();) {
    const std::uint32_t file = first->file;
    const auto last = std::find_if(first, places.end(),
                                   [&](const FileSpan& place) { return place.file != file; });
    const fs::path& path = view.module(file).path;
    File& known = files_[view.options().workspace->identity(path)];
    if (known.path.empty()) known.path = path;
    const std::size_t old_size = known.places.size();
    for (; first != last; ++first) {
      const auto old_end = known.places.begin() + static_cast<std::ptrdiff_t>(old_size);
      const auto found = std::lower_bound(
          known.places.begin(), old_end, first->span.begin,
          [](const Span& place, std::uint32_t begin) { return place.begin < begin; });
      if (found != old_end && *found == first->span) continue;
      known.places.push_back(first->span);
      added.push_back(*first);
    }
    std::inplace_merge(
        known.places.begin(), known.places.begin() + static_cast<std::ptrdiff_t>(old_size),
        known.places.end(), [](const Span& a, const Span& b) { return a.begin < b.begin; });
  }
  return added;
}

std::span<const Span> PlaceSet::in(const fs::path& identity) const {
  const auto found = files_.find(identity);
  return found == files_.end() ? std::span<const Span>() : found->second.places;
}

std::vector<Place> PlaceSet::all() const {
  std::vector<Place> places;
  for (const auto& [identity, file] : files_) {
    for (const Span place : file.places) places.push_back({.path = file.path, .where = place});
  }
  return places;
}

std::vector<Place> references(SceneSet& scenes, const SharedSymbol& symbol,
                              bool includes_declaration) {
  PlaceSet places;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const SceneView* view = scenes.scene(i);
    if (view == nullptr) continue;
    const SymbolId id = symbol_in(*view, symbol);
    std::vector<FileSpan> found = view->index().references(id);
    if (!includes_declaration) std::erase(found, FileSpan{id.file, symbol.where});
    places.add(*view, found);
  }
  return places.all();
}

std::vector<Highlight> highlights(const SceneView& view, std::uint32_t file, std::uint32_t offset) {
  const SymbolTable& table = view.table(file);
  const Occurrence* name = table.at(offset);
  if (name == nullptr || !name->symbol.is_known()) return {};
  const Symbol* symbol = view.index().find(name->symbol);
  const bool is_own = symbol != nullptr && name->symbol.file == file;
  std::vector<Highlight> found;
  for (const Occurrence& occurrence : table.occurrences()) {
    if (occurrence.symbol != name->symbol) continue;
    const bool is_declaration = is_own && occurrence.where == symbol->where;
    const bool is_write =
        is_declaration || has_colon_after(view.file(file).text(), occurrence.where.end);
    found.push_back({.where = occurrence.where, .is_write = is_write});
  }
  return found;
}

}  // namespace sdlc::lang
