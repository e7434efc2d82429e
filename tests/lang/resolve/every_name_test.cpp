#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/program/program.hpp"
#include "lang/resolve/symbol_index.hpp"
#include "lang/source/source.hpp"
#include "tests/support/file_test.hpp"

// In every file of the tests and examples, damaged or not, every name has a symbol or is unknown.
namespace sdlc::test {
namespace {

namespace fs = std::filesystem;
using namespace lang;

/// The span of the name that the node itself has; empty if it has none.
Span name_in(ast::Node node) {
  switch (node.kind()) {
    case SyntaxKind::Name:
    case SyntaxKind::TypeName:
    case SyntaxKind::Reference: return node.span();
    case SyntaxKind::Call:
    case SyntaxKind::Object:
    case SyntaxKind::Parameter:
    case SyntaxKind::Property: return node.head_span();
    default: return {};
  }
}

/// An error in the table; empty if there is none.
std::string fault_of(const SymbolIndex& index, const SymbolTable& table) {
  const SyntaxTree& tree = table.tree();
  const auto occurrences = table.occurrences();
  for (std::size_t i = 1; i < occurrences.size(); ++i) {
    if (occurrences[i].where.begin < occurrences[i - 1].where.end) {
      return "two occurrences at " + std::string(tree.text(occurrences[i].where));
    }
  }
  for (const Occurrence& occurrence : occurrences) {
    const SymbolId id = occurrence.symbol;
    if (!id.is_known() || id.is_builtin()) continue;
    const Symbol* symbol = index.find(id);
    if (symbol == nullptr) return "no symbol of " + std::string(tree.text(occurrence.where));
    if (symbol->name != tree.text(occurrence.where)) return "another name";
  }
  const auto unknown = static_cast<std::size_t>(std::ranges::count_if(
      occurrences, [](const Occurrence& occurrence) { return !occurrence.symbol.is_known(); }));
  if (unknown != table.unknown().size()) return "unknown names";
  for (NodeIndex i = 0; i < tree.nodes().size(); ++i) {
    const Span name = name_in({tree, i});
    if (name.size() == 0) continue;
    const Occurrence* found = table.at(name.begin);
    if (found == nullptr || found->where.begin != name.begin) {
      return "no occurrence of " + std::string(tree.text(name)) + " at " +
             std::to_string(name.begin);
    }
  }
  return {};
}

std::string fault_of(const Document& file, const FileSystem& files) {
  Workspace workspace(files);
  DiagnosticSink sink;
  Program program(file, {.workspace = &workspace, .limits = {}}, sink);
  const SymbolIndex index(program, sink);
  for (std::uint32_t i = 0; i < index.file_count(); ++i) {
    const std::string fault = fault_of(index, index.table(i));
    if (!fault.empty()) return fault;
  }
  return {};
}

/// The text, and the text with single bytes removed.
std::vector<std::string> variants_of(const std::string& text) {
  std::vector<std::string> variants{text};
  const std::size_t step = std::max<std::size_t>(text.size() / 7, 1);
  for (std::size_t at = 9; at < text.size(); at += step) {
    variants.push_back(text.substr(0, at) + text.substr(at + 1));
    variants.push_back(text.substr(0, at));
  }
  return variants;
}

TEST(EveryName, OfTheFileTestsHasASymbolOrIsUnknown) {
  std::size_t cases = 0;
  for (const char* folder : {"eval", "format", "lint", "lower", "mistakes", "syntax"}) {
    for (const FileCase& file_case : load_cases(folder)) {
      if (file_case.file.extension() != ".scene") continue;
      const CaseFiles files(file_case);
      for (const std::string& text : variants_of(file_case.texts[0].text())) {
        const Document file("test.scene", text);
        EXPECT_EQ(fault_of(file, files), "") << file_case.file << " " << file_case.name << "\n"
                                             << text;
      }
      ++cases;
    }
  }
  EXPECT_GT(cases, 300u);
}

TEST(EveryName, OfTheExamplesHasASymbolOrIsUnknown) {
  const DiskFileSystem files;
  for (const char* folder : {"examples", "tests/files/planted", "tests/files/whole"}) {
    for (const auto& entry : fs::directory_iterator(fs::path(SDLC_SOURCE_DIR) / folder)) {
      if (entry.path().extension() != ".scene") continue;
      std::ostringstream text;
      text << std::ifstream(entry.path()).rdbuf();
      for (const std::string& variant : variants_of(text.str())) {
        const Document file(entry.path().string(), variant);
        EXPECT_EQ(fault_of(file, files), "") << entry.path();
      }
    }
  }
}

}  // namespace
}  // namespace sdlc::test
