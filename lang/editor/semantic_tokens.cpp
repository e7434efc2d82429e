#include "lang/editor/semantic_tokens.hpp"

#include <algorithm>
#include <span>

#include "lang/editor/cursor.hpp"
#include "lang/editor/keywords.hpp"
#include "lang/resolve/builtin_symbols.hpp"
#include "lang/schema/schema.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

/// How names of a symbol are shown.
struct Style {
  SemanticType type = SemanticType::Variable;
  std::uint8_t modifiers = 0;
};

bool is_of_kind(const Property* property) {
  return std::ranges::any_of(all_kinds(), [&](const Kind& kind) {
    return std::ranges::any_of(kind.properties,
                               [&](const Property& own) { return &own == property; });
  });
}

Style style_of(const BuiltinSymbol& builtin) {
  const std::uint8_t of_language = kDefaultLibraryModifier;
  switch (builtin.kind) {
    case SymbolKind::BuiltinKind:
    case SymbolKind::Type: return {SemanticType::Type, of_language};
    case SymbolKind::BuiltinFunction: {
      const auto materials = all_materials();
      const bool is_material =
          std::ranges::find(materials, builtin.name, &MaterialInfo::name) != materials.end();
      return {is_material ? SemanticType::Struct : SemanticType::Function, of_language};
    }
    case SymbolKind::Property:
      return {is_of_kind(builtin.property) ? SemanticType::Property : SemanticType::Parameter,
              of_language};
    case SymbolKind::Word: return {SemanticType::EnumMember, of_language};
    default:
      return {SemanticType::Variable, static_cast<std::uint8_t>(of_language | kReadonlyModifier)};
  }
}

/// By index of builtin_symbols().
const std::vector<Style>& builtin_styles() {
  static const std::vector<Style> styles = [] {
    std::vector<Style> all;
    for (const BuiltinSymbol& builtin : builtin_symbols()) all.push_back(style_of(builtin));
    return all;
  }();
  return styles;
}

Style style_of(SymbolKind kind) {
  switch (kind) {
    case SymbolKind::Import: return {SemanticType::Namespace};
    case SymbolKind::Fn: return {SemanticType::Function};
    case SymbolKind::Def: return {SemanticType::Class};
    case SymbolKind::Parameter: return {SemanticType::Parameter, kReadonlyModifier};
    case SymbolKind::Object: return {SemanticType::Label};
    default: return {SemanticType::Variable, kReadonlyModifier};
  }
}

bool is_operator(std::string_view mark) {
  return mark != "," && mark != ":" && mark != "." && mark != ";";
}

/// The last token before the token at `begin` that is no trivia.
Token solid_token_before(const SyntaxTree& tree, std::uint32_t begin) {
  while (begin > 0) {
    const Token token = cursor_on(tree, begin - 1).token;
    if (!is_trivia(token.kind)) return token;
    begin = token.span.begin;
  }
  return {};
}

/// One pass over the tokens and, beside it, one over the names.
class SemanticReader {
 public:
  SemanticReader(const SceneView& view, std::uint32_t file, Span range)
      : view_(view), table_(view.table(file)), text_(view.file(file).text()), range_(range) {
    const std::uint32_t begin = cursor_on(view.tree(file), range.begin).token.span.begin;
    tokens_.seek(begin);
    last_ = solid_token_before(view.tree(file), begin);
    name_ = std::ranges::lower_bound(table_.occurrences(), begin, {},
                                     [](const Occurrence& name) { return name.where.begin; });
  }

  std::vector<SemanticToken> read() {
    Token token = tokens_.next();
    for (; token.kind != TokenKind::End && token.span.begin < range_.end; token = tokens_.next()) {
      add(token);
      if (!is_trivia(token.kind)) last_ = token;
    }
    return std::move(found_);
  }

 private:
  std::string_view text_of(Span span) const { return text_.substr(span.begin, span.size()); }

  void push(Span span, SemanticType type, int modifiers = 0) {
    if (span.end > range_.begin && span.begin < range_.end) {
      found_.push_back({span, type, static_cast<std::uint8_t>(modifiers)});
    }
  }

  void add(const Token& token) {
    switch (token.kind) {
      case TokenKind::LineComment: return push(token.span, SemanticType::Comment);
      case TokenKind::DocComment:
        return push(token.span, SemanticType::Comment, kDocumentationModifier);
      case TokenKind::BlockComment:
      case TokenKind::UnclosedComment: return add_lines(token.span);
      case TokenKind::Name: return add_name(token.span);
      case TokenKind::Number:
      case TokenKind::Color: return push(token.span, SemanticType::Number);
      case TokenKind::String:
      case TokenKind::UnclosedString: return push(token.span, SemanticType::String);
      case TokenKind::Mark:
        if (is_operator(text_of(token.span))) push(token.span, SemanticType::Operator);
        return;
      default: return;
    }
  }

  /// A comment of several lines, line by line.
  void add_lines(Span span) {
    while (span.begin < span.end) {
      const std::string_view rest = text_of(span);
      const std::size_t size = std::min(rest.find_first_of("\r\n"), rest.size());
      const std::uint32_t end = span.begin + static_cast<std::uint32_t>(size);
      if (size > 0) push({span.begin, end}, SemanticType::Comment);
      span.begin = std::min(span.end, end + 1);
    }
  }

  void add_name(Span span) {
    const auto end = table_.occurrences().end();
    while (name_ != end && name_->where.begin < span.begin) ++name_;
    if (name_ != end && name_->where == span) return add_symbol(*name_);
    const bool is_component = last_.kind == TokenKind::Mark && text_of(last_.span) == ".";
    if (is_component) return push(span, SemanticType::Property);
    const bool is_label = has_colon_after(text_, span.end);
    if (!is_label && find_keyword(text_of(span)) != nullptr) push(span, SemanticType::Keyword);
  }

  void add_symbol(const Occurrence& name) {
    if (name.symbol.is_builtin()) {
      const Style& style = builtin_styles()[name.symbol.index];
      return push(name.where, style.type, style.modifiers);
    }
    const Symbol* symbol = view_.index().find(name.symbol);
    if (symbol == nullptr) return;
    const bool is_declaration = name.symbol.file == table_.file() && symbol->where == name.where;
    Style style = style_of(symbol->kind);
    if (symbol->kind == SymbolKind::Parameter && !is_declaration && is_property(name, *symbol)) {
      style.type = SemanticType::Property;
    }
    push(name.where, style.type, style.modifiers | (is_declaration ? kDeclarationModifier : 0));
  }

  /// Whether the parameter is the label of a property of an instance.
  bool is_property(const Occurrence& name, const Symbol& symbol) const {
    const SyntaxTree& tree = view_.tree(name.symbol.file);
    return tree[symbol.owner].kind == SyntaxKind::Def && has_colon_after(text_, name.where.end);
  }

  const SceneView& view_;
  const SymbolTable& table_;
  std::string_view text_;
  Span range_;
  TokenReader tokens_{text_};
  std::span<const Occurrence>::iterator name_;
  Token last_;  ///< that is no trivia
  std::vector<SemanticToken> found_;
};

}  // namespace

std::vector<SemanticToken> semantic_tokens(const SceneView& view, std::uint32_t file,
                                           std::optional<Span> range) {
  const auto size = static_cast<std::uint32_t>(view.file(file).text().size());
  Span part = range.value_or(Span{0, size});
  part.end = std::min(part.end, size);
  part.begin = std::min(part.begin, part.end);
  return SemanticReader(view, file, part).read();
}

}  // namespace sdlc::lang
