#include "tests/editors/token_classes.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>

#include <fmt/format.h>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/repair/vocabulary.hpp"
#include "lang/resolve/builtin_symbols.hpp"
#include "lang/syntax/syntax.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::test {
namespace {

using lang::SymbolKind, lang::SyntaxKind, lang::TokenKind;

bool is_builtin(SymbolKind kind, std::string_view name) {
  return lang::find_builtin_symbol(kind, name).is_known();
}

/// What the names of a file are, by where they begin.
class Names {
 public:
  explicit Names(const lang::SyntaxTree& tree) : tree_(tree) {
    for (lang::NodeIndex i = 0; i < tree.nodes().size(); ++i) visit(lang::ast::Node(tree, i));
  }

  const std::map<std::uint32_t, TokenClass>& classes() const noexcept { return classes_; }

 private:
  void set(lang::Span span, TokenClass token_class) { classes_[span.begin] = token_class; }

  /// The names of a path; `whole` is for a name alone.
  void set_path(lang::Span path, TokenClass whole, TokenClass first, TokenClass last) {
    std::vector<lang::Span> names;
    lang::TokenReader reader(tree_.file().text(), path.begin);
    for (auto token = reader.next_solid(); token.span.begin < path.end && token.span.size() > 0;
         token = reader.next_solid()) {
      if (lang::is_name(token.kind)) names.push_back(token.span);
    }
    if (names.empty()) return;
    for (const lang::Span name : names) set(name, first);
    set(names.back(), names.size() == 1 ? whole : last);
  }

  static TokenClass class_of_name(SyntaxKind parent) {
    switch (parent) {
      case SyntaxKind::Import: return TokenClass::Module;
      case SyntaxKind::Fn: return TokenClass::Function;
      case SyntaxKind::Def: return TokenClass::Type;
      case SyntaxKind::Object: return TokenClass::Label;
      default: return TokenClass::Variable;
    }
  }

  void visit_reference(lang::ast::Node node) {
    const lang::Span path = node.span();
    set_path(path, TokenClass::Member, TokenClass::Member, TokenClass::Member);
    const lang::Span first = lang::token_at(tree_.file().text(), path.begin);
    const bool is_value = is_builtin(SymbolKind::BuiltinValue, tree_.text(first));
    set(first, is_value ? TokenClass::BuiltinValue : TokenClass::Variable);
  }

  void visit(lang::ast::Node node) {
    const auto either = [&](SymbolKind kind, TokenClass builtin, TokenClass other) {
      return is_builtin(kind, node.is(SyntaxKind::TypeName) ? node.text() : node.head()) ? builtin
                                                                                         : other;
    };
    for (const lang::ast::Node child : node.children()) {
      if (child.is(SyntaxKind::Name)) set(child.span(), class_of_name(node.kind()));
    }
    switch (node.kind()) {
      case SyntaxKind::Property: return set(node.head_span(), TokenClass::Property);
      case SyntaxKind::Argument:
      case SyntaxKind::Parameter: return set(node.head_span(), TokenClass::Parameter);
      case SyntaxKind::TypeName:
        return set(node.span(),
                   either(SymbolKind::Type, TokenClass::BuiltinType, TokenClass::Type));
      case SyntaxKind::Object:
        return set_path(node.head_span(),
                        either(SymbolKind::BuiltinKind, TokenClass::BuiltinType, TokenClass::Type),
                        TokenClass::Module, TokenClass::Type);
      case SyntaxKind::Call:
        return set_path(
            node.head_span(),
            either(SymbolKind::BuiltinFunction, TokenClass::BuiltinFunction, TokenClass::Function),
            TokenClass::Module, TokenClass::Function);
      case SyntaxKind::Reference: return visit_reference(node);
      case SyntaxKind::Member:
        return set_path(node.span(), TokenClass::Member, TokenClass::Member, TokenClass::Member);
      default: return;
    }
  }

  const lang::SyntaxTree& tree_;
  std::map<std::uint32_t, TokenClass> classes_;
};

TokenClass class_of_word(std::string_view word) {
  if (word == "true" || word == "false") return TokenClass::Boolean;
  const bool is_keyword =
      lang::is_one_of(word, lang::kReservedWords) || lang::is_one_of(word, lang::kContextualWords);
  return is_keyword ? TokenClass::Keyword : TokenClass::Wrong;
}

TokenClass class_of_mark(std::string_view mark) {
  return mark == "," || mark == ":" || mark == "." ? TokenClass::Punctuation : TokenClass::Operator;
}

TokenClass class_of(TokenKind kind, std::string_view text) {
  switch (kind) {
    case TokenKind::LineComment:
    case TokenKind::BlockComment: return TokenClass::Comment;
    case TokenKind::DocComment: return TokenClass::DocComment;
    case TokenKind::Name: return class_of_word(text);
    case TokenKind::Number: return TokenClass::Number;
    case TokenKind::String: return TokenClass::String;
    case TokenKind::Color: return TokenClass::Color;
    case TokenKind::Open:
    case TokenKind::Close: return TokenClass::Punctuation;
    case TokenKind::Mark: return class_of_mark(text);
    default: return TokenClass::Wrong;
  }
}

}  // namespace

std::string_view name_of(TokenClass token_class) noexcept {
  constexpr auto kNames = std::to_array<std::string_view>(
      {"comment",  "doc comment",    "string",      "number",   "color",     "boolean",
       "keyword",  "operator",       "punctuation", "property", "parameter", "label",
       "variable", "built-in value", "member",      "module",   "function",  "built-in function",
       "type",     "built-in type",  "wrong"});
  return kNames[static_cast<std::size_t>(token_class)];
}

std::vector<ClassifiedToken> classify(const lang::SourceFile& file) {
  lang::DiagnosticSink sink;
  const lang::SyntaxTree tree = lang::parse(file, sink);
  const Names names(tree);
  std::vector<ClassifiedToken> tokens;
  lang::TokenReader reader(file.text());
  for (lang::Token token = reader.next(); token.kind != TokenKind::End; token = reader.next()) {
    if (token.kind == TokenKind::Space || token.kind == TokenKind::LineEnd) continue;
    const auto name = names.classes().find(token.span.begin);
    tokens.push_back({token.span, name != names.classes().end()
                                      ? name->second
                                      : class_of(token.kind, file.text(token.span))});
  }
  return tokens;
}

std::string compare_tokens(const lang::SourceFile& file,
                           const std::vector<ClassifiedToken>& expected,
                           const std::vector<ClassifiedToken>& actual) {
  std::string differences;
  const auto report = [&](const ClassifiedToken& token, std::string_view remark) {
    const lang::Position at = file.position(token.span.begin);
    differences += fmt::format("{}:{}:{}: `{}` {} {}\n", file.name(), at.line, at.column,
                               file.text(token.span), remark, name_of(token.token_class));
  };
  const auto comes_before = [](const ClassifiedToken& a, const ClassifiedToken& b) {
    return std::pair(a.span.begin, a.span.end) < std::pair(b.span.begin, b.span.end);
  };
  auto a = expected.begin();
  auto b = actual.begin();
  while (a != expected.end() || b != actual.end()) {
    if (b == actual.end() || (a != expected.end() && comes_before(*a, *b))) {
      report(*a++, "is missing, a");
    } else if (a == expected.end() || comes_before(*b, *a)) {
      report(*b++, "is too much, a");
    } else {
      if (a->token_class != b->token_class) {
        report(*b, fmt::format("should be a {}, is a", name_of(a->token_class)));
      }
      ++a, ++b;
    }
  }
  return differences;
}

}  // namespace sdlc::test
