#include "lang/editor/rename.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/editor/rename_trial.hpp"
#include "lang/repair/vocabulary.hpp"
#include "lang/resolve/symbol.hpp"
#include "lang/token/token_reader.hpp"
#include "lang/workspace/document.hpp"

namespace sdlc::lang {

namespace fs = std::filesystem;

namespace {

/// "lib.scene:3:5"
std::string describe_place(const SceneView& view, const FileSpan& place) {
  const Position position = view.file(place.file).position(place.span.begin);
  return fmt::format("{}:{}:{}", view.module(place.file).path.filename().string(), position.line,
                     position.column);
}

/// A refusal because of what is at the place.
RenamePlan refused_at(const SceneView& view, const FileSpan& place, std::string refusal) {
  return {.refusal = std::move(refusal),
          .conflict = Place{.path = view.module(place.file).path, .where = place.span},
          .places = {}};
}

RenamePlan refused(std::string refusal) {
  return {.refusal = std::move(refusal), .conflict = {}, .places = {}};
}

std::string invalid_name(std::string_view name) {
  if (is_one_of(name, kReservedWords)) {
    return fmt::format("`{}` is a word of the language and cannot be a name.", name);
  }
  return fmt::format(
      "`{}` is not a name: a name has letters, digits and `_`, and does not begin with a digit.",
      name);
}

/// The sentence about a name that would refer to another symbol.
RenamePlan refused_for_conflict(const SceneView& view, const Symbol& symbol,
                                std::string_view new_name, const FileSpan& place) {
  const Occurrence* other = view.table(place.file).at(place.span.begin);
  const Symbol* declared = other == nullptr ? nullptr : view.index().find(other->symbol);
  const std::string where = describe_place(view, place);
  const std::string_view kind = describe(symbol.kind);
  if (declared != nullptr) {
    return refused_at(view, place,
                      fmt::format("`{}` is already the name of a {} at {}.", new_name,
                                  describe(declared->kind), where));
  }
  const bool is_builtin = other != nullptr && other->symbol.is_builtin();
  return refused_at(view, place,
                    is_builtin ? fmt::format("The built-in `{}` at {} would then be this {}.",
                                             new_name, where, kind)
                               : fmt::format("The unknown name `{}` at {} would then be this {}.",
                                             new_name, where, kind));
}

/// Whether the name is a member of the file with this index: it follows an import of that file.
bool is_member_of(const SceneView& view, std::uint32_t file, Span name, std::uint32_t member_of) {
  const auto names = view.table(file).occurrences();
  const auto found = std::ranges::lower_bound(
      names, name.begin, {}, [](const Occurrence& occurrence) { return occurrence.where.begin; });
  if (found == names.begin()) return false;
  const auto& imports = view.module(file).imports;
  const auto import = imports.find(view.file(file).text(std::prev(found)->where));
  return import != imports.end() && import->second.module == member_of;
}

/// An unknown label of this name, or an unknown member of this name in another file, which would
/// then refer to the symbol.
std::optional<FileSpan> captured_elsewhere(const SceneView& view, SymbolId id, const Symbol& symbol,
                                           std::string_view new_name) {
  const bool is_parameter = symbol.kind == SymbolKind::Parameter;
  for (std::uint32_t file = 0; file < view.file_count(); ++file) {
    const SymbolTable& table = view.table(file);
    for (const UnknownName& unknown : table.unknown()) {
      if (table.tree().text(unknown.where) != new_name) continue;
      const bool is_captured = is_parameter ? unknown.owner == SymbolId{id.file, symbol.owner}
                                            : unknown.space == NameSpace::Members &&
                                                  is_member_of(view, file, unknown.where, id.file);
      if (is_captured) return FileSpan{file, unknown.where};
    }
  }
  return std::nullopt;
}

bool has_syntax_errors(const SceneView& view, std::uint32_t file) {
  const auto* document = dynamic_cast<const Document*>(view.module(file).file);
  if (document == nullptr) return false;
  DiagnosticSink errors;
  document->tree(errors);
  return errors.has_errors();
}

/// In a file with syntax errors: a name whose meaning is not certain, although it is spelled like
/// the symbol or its new name.
std::optional<FileSpan> find_uncertain_name(const SceneView& view, std::uint32_t file,
                                            std::string_view old_name, std::string_view new_name) {
  const SymbolTable& table = view.table(file);
  const auto& imports = view.module(file).imports;
  TokenReader tokens(view.file(file).text());
  std::string_view before, before_dot;  // the token before, and that before a dot
  for (Token token = tokens.next_solid(); token.kind != TokenKind::End;
       token = tokens.next_solid()) {
    const std::string_view text = tokens.text(token);
    if (is_name(token.kind) && (text == old_name || text == new_name)) {
      const Occurrence* found = table.at(token.span.begin);
      const bool is_recorded = found != nullptr && found->where == token.span;
      const bool is_component = before == "." && !is_recorded && !imports.contains(before_dot);
      const bool is_certain = is_component || (is_recorded && found->symbol.is_known());
      if (!is_certain) return FileSpan{file, token.span};
    }
    if (text == ".") before_dot = before;
    before = text;
  }
  return std::nullopt;
}

/// In a file with syntax errors, where a scope ends may be uncertain: another symbol of the same
/// name whose scope touches that of this one.
std::optional<FileSpan> find_overlapping_namesake(const SymbolTable& table, const Symbol& symbol) {
  for (const Symbol& other : table.symbols()) {
    const bool is_namesake = other.node != symbol.node && other.name == symbol.name &&
                             name_space_of(other.kind) == name_space_of(symbol.kind);
    const bool touches =
        other.scope.begin <= symbol.scope.end && symbol.scope.begin <= other.scope.end;
    if (is_namesake && touches) return FileSpan{table.file(), other.where};
  }
  return std::nullopt;
}

RenamePlan check_broken_files(const SceneView& view, SymbolId id, const Symbol& symbol,
                              bool is_local_to_file, std::string_view new_name) {
  for (std::uint32_t file = 0; file < view.file_count(); ++file) {
    if (is_local_to_file && file != id.file) continue;
    if (!has_syntax_errors(view, file)) continue;
    auto uncertain = find_uncertain_name(view, file, symbol.name, new_name);
    if (!uncertain && file == id.file) {
      uncertain = find_overlapping_namesake(view.table(file), symbol);
    }
    if (!uncertain) continue;
    return refused_at(
        view, *uncertain,
        fmt::format("The file has syntax errors, and the meaning of `{}` at {} is not certain.",
                    view.file(file).text(uncertain->span), describe_place(view, *uncertain)));
  }
  return {};
}

RenamePlan check_scene(const SceneView& view, const SharedSymbol& shared,
                       std::string_view new_name) {
  const SymbolId id = symbol_in(view, shared);
  const Symbol* symbol = view.index().find(id);
  if (symbol == nullptr) return {};
  const Rename rename = view.index().rename(id, new_name);
  switch (rename.refusal) {
    case Rename::Refusal::InvalidName: return refused(invalid_name(new_name));
    case Rename::Refusal::NotDeclared: return refused("No file declares this name.");
    case Rename::Refusal::Conflict:
      if (rename.conflict) return refused_for_conflict(view, *symbol, new_name, *rename.conflict);
      return refused(fmt::format("`{}` is a property of every instance.", new_name));
    case Rename::Refusal::None: break;
  }
  if (const auto captured = captured_elsewhere(view, id, *symbol, new_name)) {
    return refused_for_conflict(view, *symbol, new_name, *captured);
  }
  return check_broken_files(view, id, *symbol, shared.is_local_to_file, new_name);
}

bool is_within(const fs::path& file, const fs::path& folder) {
  const auto [in_folder, in_file] =
      std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  // A folder may be written with a slash at its end.
  return in_folder == folder.end() || (in_folder->empty() && std::next(in_folder) == folder.end());
}

/// Whether the text at the path is still the one that the scene was resolved with.
bool is_current(const SceneView& view, std::uint32_t file) {
  std::error_code error;
  const std::string_view text = view.file(file).text();
  const auto now = view.options().workspace->read(view.module(file).path, text.size(), error);
  return now && *now == text;
}

bool may_change(const SceneView& view, const fs::path& path, const RenameOptions& options) {
  const Workspace& workspace = *view.options().workspace;
  if (options.folders.empty() || workspace.is_open(path)) return true;
  const fs::path file = workspace.identity(path);
  return std::ranges::any_of(options.folders, [&](const fs::path& folder) {
    return is_within(file, workspace.identity(folder));
  });
}

/// Whether the files of the places may be changed, and still have the texts of the scene.
RenamePlan check_files(const SceneView& view, const std::vector<FileSpan>& places,
                       const RenameOptions& options) {
  std::set<std::uint32_t> files;
  for (const FileSpan& place : places) files.insert(place.file);
  for (const std::uint32_t file : files) {
    const fs::path& path = view.module(file).path;
    if (!may_change(view, path, options)) {
      return refused(
          fmt::format("The name is used in `{}`, which is outside the folder.", path.string()));
    }
    if (!is_current(view, file)) {
      return refused(fmt::format("`{}` has just been changed: try again.", path.string()));
    }
  }
  return {};
}

RenamePlan try_rename(const SceneView& view, const SharedSymbol& symbol, const PlaceSet& places,
                      std::string_view new_name) {
  if (!symbol_in(view, symbol).is_known()) return {};
  const auto change = first_change(view, places, new_name);
  if (!change) return {};
  const FileSpan where{view.find(change->path).value_or(0), change->where};
  return refused_at(
      view, where,
      fmt::format("The meaning of the scene would change at {}.", describe_place(view, where)));
}

}  // namespace

RenameTarget prepare_rename(const SceneView& view, std::uint32_t file, std::uint32_t offset) {
  const Occurrence* name = view.table(file).at(offset);
  if (name == nullptr) return {.where = {}, .refusal = "There is no name here."};
  const std::string_view text = view.file(file).text(name->where);
  std::string refusal;
  if (name->symbol.is_builtin()) {
    refusal = fmt::format("`{}` is a name of the language and cannot be renamed.", text);
  } else if (!name->symbol.is_known()) {
    refusal = fmt::format("`{}` is not declared.", text);
  }
  return {.where = name->where, .refusal = std::move(refusal)};
}

RenamePlan plan_rename(SceneSet& scenes, const SharedSymbol& symbol, std::string_view new_name,
                       const RenameOptions& options) {
  if (symbol.path.empty()) return refused("A name of the language cannot be renamed.");
  PlaceSet places;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const SceneView* view = scenes.scene(i);
    if (view == nullptr) continue;
    RenamePlan plan = check_scene(*view, symbol, new_name);
    if (!plan.refusal.empty()) return plan;
    const auto found = view->index().references(symbol_in(*view, symbol));
    plan = check_files(*view, found, options);
    if (!plan.refusal.empty()) return plan;
    places.add(*view, found);
  }
  RenamePlan plan{.refusal = {}, .conflict = {}, .places = places.all()};
  if (plan.places.empty()) return refused("No scene declares this name any more.");
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const SceneView* view = scenes.scene(i);
    if (view == nullptr) continue;
    RenamePlan trial = try_rename(*view, symbol, places, new_name);
    if (!trial.refusal.empty()) return trial;
  }
  return plan;
}

}  // namespace sdlc::lang
