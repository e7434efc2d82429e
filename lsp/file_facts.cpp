#include "lsp/file_facts.hpp"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <utility>

#include "lang/ast/ast.hpp"
#include "lang/object/value.hpp"
#include "lang/resolve/outline.hpp"
#include "lang/syntax/syntax.hpp"
#include "lang/token/token_reader.hpp"
#include "lang/value/literals.hpp"

namespace sdlc::lsp {

namespace fs = std::filesystem;

namespace {

/// The value of a string literal; nullopt if it is not correct.
std::optional<std::string> value_of(std::string_view literal) {
  const lang::SourceFile file("", std::string(literal));
  lang::DiagnosticSink ignored;
  const lang::SyntaxTree tree = lang::parse_expression(file, ignored);
  const auto expression = lang::ast::Node(tree, 0).child(0);
  if (!expression || !expression->is(lang::SyntaxKind::String)) return std::nullopt;
  const lang::Value value = lang::evaluate_string(*expression, ignored);
  const auto* text = lang::get_if<std::string>(&value);
  return text == nullptr ? std::nullopt : std::optional(*text);
}

/// The paths in imports and includes. Tokens are enough: a string follows these words nowhere else.
std::vector<std::string> read_dependencies(std::string_view text, const lang::StopRequest* stop) {
  std::vector<std::string> paths;
  lang::TokenReader tokens(text);
  bool is_after_word = false;
  for (lang::Token token = tokens.next_solid(); token.kind != lang::TokenKind::End;
       token = tokens.next_solid()) {
    lang::stop_if_requested(stop);
    if (is_after_word && token.kind == lang::TokenKind::String) {
      if (auto path = value_of(tokens.text(token))) paths.push_back(*std::move(path));
    }
    const std::string_view word = tokens.text(token);
    is_after_word = token.kind == lang::TokenKind::Name && (word == "import" || word == "include");
  }
  return paths;
}

/// The symbols of an outline, without objects that have no name. Their texts are those of `file`.
std::vector<IndexedSymbol> symbols_of(const lang::SourceFile& file, const lang::SyntaxTree& tree,
                                      lang::PositionEncoding encoding) {
  std::vector<IndexedSymbol> symbols;
  std::vector<std::string_view> around;  // names of the items around, by depth
  for (const lang::OutlineItem& item : lang::outline_of(tree)) {
    if (symbols.size() == kMaxIndexedSymbols) break;
    around.resize(std::min<std::size_t>(around.size(), item.depth));
    const bool has_name =
        item.kind != lang::SymbolKind::Object || item.where.begin != item.whole.begin;
    const std::string_view container = around.empty() ? std::string_view() : around.back();
    around.push_back(has_name ? item.name : std::string_view());
    if (!has_name || item.name.empty()) continue;
    symbols.push_back({.kind = item.kind,
                       .name = item.name,
                       .object_kind = item.object_kind,
                       .container = container,
                       .begin = lang::position_of(file, item.where.begin, encoding),
                       .end = lang::position_of(file, item.where.end, encoding)});
  }
  return symbols;
}

/// Copies the texts of the symbols, each once: most are repeated.
std::unique_ptr<char[]> own_names(std::vector<IndexedSymbol>& symbols) {
  std::unordered_map<std::string_view, std::string_view> copies;
  std::size_t bytes = 0;
  const auto for_each_text = [&](auto function) {
    for (IndexedSymbol& symbol : symbols) {
      for (auto text :
           {&IndexedSymbol::name, &IndexedSymbol::object_kind, &IndexedSymbol::container}) {
        function(symbol.*text);
      }
    }
  };
  for_each_text([&](std::string_view text) {
    if (copies.emplace(text, text).second) bytes += text.size();
  });
  auto names = std::make_unique<char[]>(bytes);
  char* end = names.get();
  for (auto& [text, copy] : copies) {
    copy = {end, text.size()};
    end = std::ranges::copy(text, end).out;
  }
  for_each_text([&](std::string_view& text) { text = copies.at(text); });
  return names;
}

}  // namespace

FileFacts read_facts(const fs::path& path, std::string text, const lang::FileSystem& files,
                     lang::PositionEncoding encoding, const lang::StopRequest* stop) {
  FileFacts facts{.path = path};
  for (const std::string& dependency : read_dependencies(text, stop)) {
    fs::path identity = files.identity(path.parent_path() / dependency);
    const bool is_known =
        std::ranges::find(facts.dependencies, identity) != facts.dependencies.end();
    if (!is_known) facts.dependencies.push_back(std::move(identity));
  }
  if (text.size() > kMaxIndexedBytes) return facts;
  const lang::SourceFile file(path.string(), std::move(text));
  lang::DiagnosticSink ignored(stop);
  facts.symbols = symbols_of(file, lang::parse(file, ignored), encoding);
  facts.symbols.shrink_to_fit();
  facts.names = own_names(facts.symbols);
  return facts;
}

}  // namespace sdlc::lsp
