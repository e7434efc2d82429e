#include "lang/editor/symbols.hpp"

#include <algorithm>
#include <utility>

#include "lang/resolve/outline.hpp"
#include "lang/resolve/symbol.hpp"
#include "lang/text/utf8.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

constexpr std::size_t kMaxExcerpt = 60;  // bytes

/// The path of an import.
std::string_view path_of_import(std::string_view statement) {
  TokenReader tokens(statement);
  for (Token token = tokens.next(); token.kind != TokenKind::End; token = tokens.next()) {
    if (is_string(token.kind)) return tokens.text(token);
  }
  return "";
}

/// The end of the parameters of a fn or def: of its first parenthesis.
std::uint32_t end_of_parameters(std::string_view text, std::uint32_t at, std::uint32_t end) {
  TokenReader tokens(text, at);
  for (Token token = tokens.next(); token.kind != TokenKind::End && token.span.end <= end;
       token = tokens.next()) {
    if (tokens.text(token) == ")") return token.span.end;
    if (tokens.text(token) == "{") break;
  }
  return at;
}

/// Whether it is no object, or one with a name.
bool has_own_name(const OutlineItem& item) {
  return !item.name.empty() && item.name.data() != item.object_kind.data();
}

std::string name_of(const OutlineItem& item) {
  return excerpt_of(has_own_name(item) ? item.name : item.object_kind);
}

std::string detail_of(const SyntaxTree& tree, const OutlineItem& item) {
  const std::string_view text = tree.file().text();
  const Span rest{item.where.end, item.whole.end};
  switch (item.kind) {
    case SymbolKind::Object:
      return has_own_name(item) ? excerpt_of(item.object_kind) : std::string();
    case SymbolKind::Import: return excerpt_of(path_of_import(tree.text(item.whole)));
    case SymbolKind::Fn:
    case SymbolKind::Def:
      return excerpt_of(tree.text({rest.begin, end_of_parameters(text, rest.begin, rest.end)}));
    default: return excerpt_of(tree.text(rest));
  }
}

/// Marks the items to keep: those with a name, and those around them.
std::vector<bool> named_items(const std::vector<OutlineItem>& items) {
  std::vector<bool> is_kept(items.size());
  std::uint32_t depth = 0;  // of a kept item that follows
  for (std::size_t i = items.size(); i-- > 0;) {
    const bool contains_kept = items[i].depth < depth;
    is_kept[i] = contains_kept || has_own_name(items[i]);
    if (is_kept[i]) depth = items[i].depth;
  }
  return is_kept;
}

}  // namespace

SymbolIcon icon_of(SymbolKind kind) noexcept {
  switch (kind) {
    case SymbolKind::Param: return SymbolIcon::Param;
    case SymbolKind::Import: return SymbolIcon::Import;
    case SymbolKind::Fn: return SymbolIcon::Function;
    case SymbolKind::Def: return SymbolIcon::Kind;
    case SymbolKind::Object: return SymbolIcon::Object;
    default: return SymbolIcon::Let;
  }
}

std::string excerpt_of(std::string_view text) {
  std::string excerpt;
  bool has_space = false;
  for (const char c : text) {
    if (c == ' ' || c == '\t' || c == '\r' || c == '\n') {
      has_space = !excerpt.empty();
      continue;
    }
    if (excerpt.size() >= kMaxExcerpt && !is_continuation(c)) return excerpt + "…";
    if (has_space) excerpt += ' ';
    has_space = false;
    excerpt += c;
  }
  return excerpt;
}

std::vector<DocumentSymbol> document_symbols(const SyntaxTree& tree, std::size_t max_count) {
  std::vector<OutlineItem> items = outline_of(tree);
  std::erase_if(items, [](const OutlineItem& item) { return name_of(item).empty(); });
  const bool has_too_many = items.size() > max_count;
  const std::vector<bool> is_named = has_too_many ? named_items(items) : std::vector<bool>();
  std::vector<DocumentSymbol> symbols;
  for (std::size_t i = 0; i < items.size() && symbols.size() < max_count; ++i) {
    if (has_too_many && !is_named[i]) continue;
    const OutlineItem& item = items[i];
    symbols.push_back({.name = name_of(item),
                       .detail = detail_of(tree, item),
                       .icon = icon_of(item.kind),
                       .has_own_name = has_own_name(item),
                       .depth = item.depth,
                       .whole = item.whole,
                       .where = item.where});
  }
  return symbols;
}

}  // namespace sdlc::lang
