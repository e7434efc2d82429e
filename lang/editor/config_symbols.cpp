#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "lang/editor/symbols.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

constexpr std::uint32_t kMaxLevels = 3;
/// Elements of a list that are shown.
constexpr std::size_t kMaxElements = 1000;

/// Walks over a config. Of a broken one, what can be recognized.
class ConfigOutline {
 public:
  ConfigOutline(std::string_view text, std::size_t max_count)
      : text_(text), tokens_(text, 0, SourceFormat::Json), max_count_(max_count) {}

  std::vector<DocumentSymbol> read() {
    const Token first = tokens_.next_solid();
    if (tokens_.text(first) == "{") members(0);
    if (tokens_.text(first) == "[") elements(0);
    return std::move(symbols_);
  }

 private:
  /// Reads up to the closing brace.
  void members(std::uint32_t depth) {
    Token token = tokens_.next_solid();
    while (token.kind != TokenKind::End && token.kind != TokenKind::Close) {
      const Token name = token;
      token = tokens_.next_solid();
      const bool is_label =
          (is_string(name.kind) || is_name(name.kind)) && tokens_.text(token) == ":";
      if (!is_label) {
        if (name.kind == TokenKind::Open) skip_nested();
        continue;
      }
      token = tokens_.next_solid();
      if (token.kind == TokenKind::End || token.kind == TokenKind::Close) return;
      value(token, name.span, unquoted(name), depth);
      token = tokens_.next_solid();
    }
  }

  /// Reads up to the closing bracket.
  void elements(std::uint32_t depth) {
    std::size_t count = 0;
    for (Token token = tokens_.next_solid();
         token.kind != TokenKind::End && token.kind != TokenKind::Close;
         token = tokens_.next_solid()) {
      if (token.kind == TokenKind::Mark) continue;
      if (count == kMaxElements) {
        tokens_.seek(token.span.begin);
        skip_nested();
        return;
      }
      // Numbers of a list need no entries: they are its detail.
      if (token.kind != TokenKind::Open) continue;
      value(token, token.span, fmt::format("[{}]", count++), depth);
    }
  }

  /// The value that begins with `first`, called `name` at `where`.
  void value(const Token& first, Span where, std::string name, std::uint32_t depth) {
    const bool is_shown = symbols_.size() < max_count_ && !name.empty();
    const std::size_t index = symbols_.size();
    if (is_shown) {
      symbols_.push_back({.name = std::move(name),
                          .detail = {},
                          .icon = icon_of(first),
                          .depth = depth,
                          .whole = {where.begin, first.span.end},
                          .where = where});
    }
    if (first.kind == TokenKind::Open) {
      const bool is_object = tokens_.text(first) == "{";
      if (!is_shown || depth + 1 == kMaxLevels) {
        skip_nested();
      } else if (is_object) {
        members(depth + 1);
      } else {
        elements(depth + 1);
      }
    }
    if (!is_shown) return;
    DocumentSymbol& symbol = symbols_[index];
    symbol.whole.end = tokens_.at();
    const Span all{first.span.begin, symbol.whole.end};
    const bool has_entries = symbols_.size() > index + 1;
    if (!has_entries) symbol.detail = excerpt_of(text_.substr(all.begin, all.size()));
  }

  /// Moves after the bracket that closes the innermost open one, by bytes: most of a large config
  /// is skipped.
  void skip_nested() {
    int open = 1;
    std::uint32_t at = tokens_.at();
    for (; at < text_.size() && open > 0; ++at) {
      const char c = text_[at];
      if (c == '"') at = end_of_string(at);
      if (c == '{' || c == '[') ++open;
      if (c == '}' || c == ']') --open;
    }
    tokens_.seek(std::min(at, static_cast<std::uint32_t>(text_.size())));
  }

  /// The closing quote of the string, or the end of its line.
  std::uint32_t end_of_string(std::uint32_t at) const {
    for (++at; at < text_.size() && text_[at] != '"' && text_[at] != '\n'; ++at) {
      if (text_[at] == '\\') ++at;
    }
    return at;
  }

  std::string unquoted(const Token& name) const {
    std::string_view text = tokens_.text(name);
    if (is_string(name.kind)) text.remove_prefix(1);
    if (name.kind == TokenKind::String && !text.empty()) text.remove_suffix(1);
    return excerpt_of(text);
  }

  SymbolIcon icon_of(const Token& first) const {
    const std::string_view text = tokens_.text(first);
    if (text == "{") return SymbolIcon::Object;
    if (text == "[") return SymbolIcon::Array;
    if (text == "true" || text == "false") return SymbolIcon::Bool;
    if (first.kind == TokenKind::Number) return SymbolIcon::Number;
    return is_string(first.kind) ? SymbolIcon::String : SymbolIcon::Null;
  }

  std::string_view text_;
  TokenReader tokens_;
  std::size_t max_count_;
  std::vector<DocumentSymbol> symbols_;
};

}  // namespace

std::vector<DocumentSymbol> config_symbols(std::string_view text, std::size_t max_count) {
  return ConfigOutline(text, max_count).read();
}

}  // namespace sdlc::lang
