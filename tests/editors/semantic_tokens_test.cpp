#include "lang/editor/semantic_tokens.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lang/editor/scene_view.hpp"
#include "lang/workspace/workspace.hpp"
#include "tests/editors/token_classes.hpp"

// Semantic tokens, which know what names mean, color the same tokens as the grammars of editors, by
// the same classes as far as the spelling shows them.
namespace sdlc::test {
namespace {

using lang::SemanticType;
namespace fs = std::filesystem;

/// The classes that a token of this type may have for a grammar.
const std::set<TokenClass>& classes_of(SemanticType type) {
  using enum TokenClass;
  static const std::map<SemanticType, std::set<TokenClass>> classes{
      // A grammar does not know which names are imports, parameters or labels where they are used.
      {SemanticType::Namespace, {Module, Variable}},
      {SemanticType::Parameter, {Parameter, Variable}},
      {SemanticType::Label, {Label, Variable}},
      {SemanticType::Variable, {Variable, BuiltinValue, Member}},
      // Words may have the names of values.
      {SemanticType::EnumMember, {Variable, BuiltinValue}},
      {SemanticType::Type, {BuiltinType}},
      {SemanticType::Class, {Type}},
      {SemanticType::Struct, {BuiltinFunction}},
      {SemanticType::Function, {Function, BuiltinFunction}},
      {SemanticType::Property, {Property, Member}},
      {SemanticType::Keyword, {Keyword, Boolean}},
      {SemanticType::Comment, {Comment, DocComment}},
      {SemanticType::String, {String}},
      {SemanticType::Number, {Number, Color}},
      {SemanticType::Operator, {Operator}},
  };
  return classes.at(type);
}

std::vector<fs::path> example_files() {
  std::vector<fs::path> files;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(SDLC_SOURCE_DIR) / "examples")) {
    if (entry.path().extension() == ".scene") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

std::string differences(const lang::SceneView& view) {
  const lang::SourceFile& file = view.file(0);
  std::map<std::uint32_t, lang::SemanticToken> semantic;
  for (const lang::SemanticToken& token : lang::semantic_tokens(view, 0)) {
    semantic[token.span.begin] = token;
  }
  std::string lines;
  for (const ClassifiedToken& token : classify(file)) {
    if (token.token_class == TokenClass::Punctuation) continue;
    const auto found = semantic.find(token.span.begin);
    const bool is_same =
        found != semantic.end() && classes_of(found->second.type).contains(token.token_class);
    if (is_same) continue;
    lines += fmt::format(
        "{}:{}: `{}` is a {} and {}\n", file.name(), file.position(token.span.begin).line,
        file.text(token.span), name_of(token.token_class),
        found == semantic.end()
            ? "no semantic token"
            : lang::kSemanticTypeNames[static_cast<std::size_t>(found->second.type)]);
  }
  return lines;
}

TEST(SemanticTokens, AgreeWithTheGrammarsOfEditors) {
  const lang::DiskFileSystem disk;
  ASSERT_GT(example_files().size(), 10u);
  for (const fs::path& path : example_files()) {
    lang::Workspace workspace(disk);
    std::error_code error;
    const auto document = workspace.load(path, std::uint64_t{1} << 20, error);
    ASSERT_NE(document, nullptr) << path;
    lang::ProgramOptions options;
    options.workspace = &workspace;
    EXPECT_EQ(differences(lang::SceneView(document, options)), "");
  }
}

}  // namespace
}  // namespace sdlc::test
