#include <algorithm>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "lang/repair/vocabulary.hpp"
#include "tests/editors/node.hpp"
#include "tests/editors/scene_texts.hpp"
#include "tests/editors/token_classes.hpp"

// The TextMate grammar colors the tokens of the program's lexer by what they are.
namespace sdlc::test {
namespace {

using File = std::shared_ptr<const lang::SourceFile>;

/// What a scope makes of its text; Wrong if that depends on the scopes around it.
TokenClass class_of(std::string_view scope) {
  // Longer prefixes first.
  static constexpr std::pair<std::string_view, TokenClass> kClasses[] = {
      {"comment.line.documentation", TokenClass::DocComment},
      {"comment", TokenClass::Comment},
      {"string", TokenClass::String},
      {"constant.numeric", TokenClass::Number},
      {"constant.other.color", TokenClass::Color},
      {"constant.language.boolean", TokenClass::Boolean},
      {"keyword.operator.logical", TokenClass::Keyword},
      {"keyword.operator", TokenClass::Operator},
      {"keyword.control", TokenClass::Keyword},
      {"storage.type", TokenClass::Keyword},
      {"punctuation.separator", TokenClass::Punctuation},
      {"punctuation.section", TokenClass::Punctuation},
      {"punctuation.accessor", TokenClass::Punctuation},
      {"support.type.property-name", TokenClass::Property},
      {"support.type", TokenClass::BuiltinType},
      {"support.class", TokenClass::BuiltinType},
      {"support.constant", TokenClass::BuiltinValue},
      {"support.function", TokenClass::BuiltinFunction},
      {"entity.name.function", TokenClass::Function},
      {"entity.name.type", TokenClass::Type},
      {"entity.name.namespace", TokenClass::Module},
      {"entity.name.label", TokenClass::Label},
      {"variable.parameter", TokenClass::Parameter},
      {"variable.other.member", TokenClass::Member},
      {"variable.other", TokenClass::Variable},
  };
  const auto* const found = std::ranges::find_if(
      kClasses, [&](const auto& entry) { return scope.starts_with(entry.first); });
  return found == std::end(kClasses) ? TokenClass::Wrong : found->second;
}

/// The innermost scope decides that does.
TokenClass class_of_scopes(std::istringstream& scopes) {
  TokenClass token_class = TokenClass::Wrong;
  for (std::string scope; scopes >> scope;) {
    const TokenClass inner = class_of(scope);
    if (inner != TokenClass::Wrong) token_class = inner;
    if (scope.starts_with("invalid")) token_class = TokenClass::Wrong;
  }
  return token_class;
}

/// Joins the parts of a token: of a comment over several lines, a string with its quotes.
void add(std::vector<ClassifiedToken>& tokens, const ClassifiedToken& part,
         const std::vector<ClassifiedToken>& expected) {
  const auto whole = std::ranges::find_if(expected, [&](const ClassifiedToken& token) {
    return token.span.begin <= part.span.begin && part.span.begin < token.span.end;
  });
  const bool continues = !tokens.empty() && whole != expected.end() &&
                         tokens.back().token_class == part.token_class &&
                         tokens.back().span.begin >= whole->span.begin;
  if (continues) {
    tokens.back().span.end = part.span.end;
  } else {
    tokens.push_back(part);
  }
}

/// The tokens by the TextMate grammar, for each file.
std::vector<std::vector<ClassifiedToken>> colored_tokens(const std::vector<File>& files) {
  const TemporaryFolder folder;
  std::vector<std::string> names;
  for (const File& file : files) {
    names.push_back((folder / (std::to_string(names.size()) + ".scene")).string());
    write_text(names.back(), std::string(file->text()));
  }
  std::istringstream lines(run_node("textmate/tokens.mjs", names));
  std::vector<std::vector<ClassifiedToken>> result;
  std::vector<ClassifiedToken> expected;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('/')) {
      expected = classify(*files[result.size()]);
      result.emplace_back();
      continue;
    }
    std::istringstream words(line);
    ClassifiedToken part;
    words >> part.span.begin >> part.span.end;
    part.token_class = class_of_scopes(words);
    add(result.back(), part, expected);
  }
  return result;
}

using Tokens = std::vector<ClassifiedToken>;

void expect_same(const std::vector<File>& files,
                 Tokens (*simplify)(const lang::SourceFile&, Tokens)) {
  const auto tokens = colored_tokens(files);
  ASSERT_EQ(tokens.size(), files.size());
  for (std::size_t i = 0; i < files.size(); ++i) {
    const lang::SourceFile& file = *files[i];
    EXPECT_EQ(compare_tokens(file, simplify(file, classify(file)), simplify(file, tokens[i])), "");
  }
}

/// Whether the text has the layout in which people write: in the cases of tests, comments and line
/// ends may be anywhere.
bool is_written_by_people(const File& file) {
  return file->name().starts_with("examples/") || file->name().starts_with("tests/files/") ||
         file->name().find(".md:") != std::string::npos;
}

TEST(TextMateGrammar, GivesTheScopesThatThemesColor) {
  SDLC_NEED_NODE_PACKAGE("vscode-tmgrammar-test");
  const std::string folder = std::getenv("SDLC_NODE_MODULES");
  const std::string root = SDLC_SOURCE_DIR;
  const std::string command = "'" + folder + "/.bin/vscode-tmgrammar-test' -g '" + root +
                              "/editors/vscode/syntaxes/scene.tmLanguage.json' '" + root +
                              "/tests/editors/textmate/scopes.scene'";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST(TextMateGrammar, ColorsEveryTokenOfTheScenesAsWhatItIs) {
  SDLC_NEED_NODE_PACKAGE("vscode-textmate");
  std::vector<File> files = correct_scene_texts();
  std::erase_if(files, std::not_fn(is_written_by_people));
  EXPECT_GT(files.size(), 50u);
  expect_same(files, [](const lang::SourceFile& /*file*/, Tokens tokens) { return tokens; });
}

/// Names of all sorts are one, and so are the words that can be names: the rules of the grammar end
/// with the line, and where a comment divides words they know only that there is a name.
Tokens with_plain_names(const lang::SourceFile& file, Tokens tokens) {
  for (ClassifiedToken& token : tokens) {
    const bool is_name =
        (token.token_class >= TokenClass::Property && token.token_class < TokenClass::Wrong) ||
        lang::is_one_of(file.text(token.span), lang::kContextualWords);
    if (is_name) token.token_class = TokenClass::Variable;
  }
  return tokens;
}

TEST(TextMateGrammar, FindsTheTokensOfEveryCorrectText) {
  SDLC_NEED_NODE_PACKAGE("vscode-textmate");
  const std::vector<File> files = correct_scene_texts();
  EXPECT_GT(files.size(), 400u);
  expect_same(files, with_plain_names);
}

}  // namespace
}  // namespace sdlc::test
