#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/editors/scene_texts.hpp"
#include "tests/editors/token_classes.hpp"
#include "tests/editors/tree_sitter/scene_tree.hpp"

// The queries for tree-sitter color the tokens of the program's lexer by what they are.
namespace sdlc::test {
namespace {

TokenClass class_of(std::string_view capture) {
  static const std::map<std::string_view, TokenClass> classes{
      {"comment", TokenClass::Comment},
      {"comment.documentation", TokenClass::DocComment},
      {"string", TokenClass::String},
      {"number", TokenClass::Number},
      {"string.special", TokenClass::Color},
      {"boolean", TokenClass::Boolean},
      {"keyword", TokenClass::Keyword},
      {"keyword.import", TokenClass::Keyword},
      {"keyword.function", TokenClass::Keyword},
      {"keyword.repeat", TokenClass::Keyword},
      {"keyword.conditional", TokenClass::Keyword},
      {"keyword.operator", TokenClass::Keyword},
      {"operator", TokenClass::Operator},
      {"punctuation.delimiter", TokenClass::Punctuation},
      {"punctuation.bracket", TokenClass::Punctuation},
      {"property", TokenClass::Property},
      {"variable.parameter", TokenClass::Parameter},
      {"label", TokenClass::Label},
      {"variable", TokenClass::Variable},
      {"constant.builtin", TokenClass::BuiltinValue},
      {"variable.member", TokenClass::Member},
      {"module", TokenClass::Module},
      {"function", TokenClass::Function},
      {"function.call", TokenClass::Function},
      {"function.builtin", TokenClass::BuiltinFunction},
      {"constructor", TokenClass::BuiltinFunction},
      {"type", TokenClass::Type},
      {"type.builtin", TokenClass::BuiltinType},
  };
  const auto found = classes.find(capture);
  if (found == classes.end()) throw std::runtime_error("no class for @" + std::string(capture));
  return found->second;
}

std::vector<ClassifiedToken> colored_tokens(const Query& query, std::string_view text) {
  std::vector<ClassifiedToken> tokens;
  for (const Capture& capture : query.captures(SceneTree(text))) {
    // Inside a string.
    if (capture.name == "string.escape") continue;
    tokens.push_back({capture.span, class_of(capture.name)});
  }
  return tokens;
}

TEST(TreeSitterQueries, ColorEveryTokenOnceAndAsWhatItIs) {
  const Query query("highlights.scm");
  for (const auto& file : correct_scene_texts()) {
    EXPECT_EQ(compare_tokens(*file, classify(*file), colored_tokens(query, file->text())), "");
  }
}

TEST(TreeSitterQueries, ColorEscapesWithinStrings) {
  const std::string text = R"(x: "a\n\u00e9b")";
  std::vector<std::string> escapes;
  const Query query("highlights.scm");
  for (const Capture& capture : query.captures(SceneTree(text))) {
    if (capture.name != "string.escape") continue;
    escapes.push_back(text.substr(capture.span.begin, capture.span.size()));
  }
  EXPECT_THAT(escapes, testing::ElementsAre("\\n", "\\u00e9"));
}

TEST(TreeSitterQueries, GiveHelixTheSameCaptures) {
  const Query query("highlights.scm"), helix("helix/highlights.scm");
  for (const auto& file : correct_scene_texts()) {
    const SceneTree tree(file->text());
    const auto ours = query.captures(tree), its = helix.captures(tree);
    ASSERT_EQ(ours.size(), its.size()) << file->name();
    for (std::size_t i = 0; i < ours.size(); ++i) ASSERT_EQ(ours[i].span, its[i].span);
  }
}

/// The captured texts as `name: text`.
std::vector<std::string> captured(const std::string& file, const std::string& text) {
  const Query query(file);
  std::vector<std::string> captures;
  for (const Capture& capture : query.captures(SceneTree(text))) {
    captures.push_back(std::string(capture.name) + ": " +
                       text.substr(capture.span.begin, capture.span.size()));
  }
  return captures;
}

TEST(TreeSitterQueries, FoldBlocksListsAndComments) {
  EXPECT_THAT(
      captured("folds.scm", "a { b: f(1) c: [2] } /* d */"),
      testing::ElementsAre("fold: { b: f(1) c: [2] }", "fold: (1)", "fold: [2]", "fold: /* d */"));
}

TEST(TreeSitterQueries, IndentWhatIsInBrackets) {
  EXPECT_THAT(
      captured("indents.scm", "a{b:(1)}"),
      testing::ElementsAre("indent: {b:(1)}", "indent.begin: {b:(1)}", "indent: (1)",
                           "indent.begin: (1)", "indent.branch: )", "indent.end: )", "outdent: )",
                           "indent.branch: }", "indent.end: }", "outdent: }"));
}

TEST(TreeSitterQueries, FindDefinitionsAndReferences) {
  EXPECT_THAT(captured("locals.scm", "fn f(a) = a + b.c\nk {}"),
              testing::IsSupersetOf({"local.definition.function: f", "local.definition: a",
                                     "local.reference: a", "local.reference: b",
                                     "local.reference: k", "local.scope: fn f(a) = a + b.c"}));
}

TEST(TreeSitterQueries, InjectCommentsAndTagDeclarations) {
  EXPECT_THAT(captured("injections.scm", "/// a\n/* b */ // c"),
              testing::ElementsAre("injection.content: /// a", "injection.content: /* b */",
                                   "injection.content: // c"));
  EXPECT_THAT(captured("tags.scm", "fn f() = g()"),
              testing::UnorderedElementsAre("definition.function: fn f() = g()", "name: f",
                                            "name: g", "reference.call: g()"));
}

}  // namespace
}  // namespace sdlc::test
