#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include <gtest/gtest.h>

#include "lang/source/limits.hpp"
#include "lang/syntax/syntax.hpp"
#include "lang/token/token_reader.hpp"
#include "tests/lang/token/tokenize.hpp"

// The tokens of any text are the text, and where the grammar reads a scene without a mistake, its
// nodes begin and end where tokens do.
namespace sdlc::lang {
namespace {

namespace fs = std::filesystem;

struct Text {
  std::string name, text;
  SourceFormat format;
};

std::vector<Text> all_texts() {
  std::vector<Text> texts;
  for (const char* folder : {"examples", "tests/files"}) {
    const fs::path path = fs::path(SDLC_SOURCE_DIR) / folder;
    for (const auto& entry : fs::recursive_directory_iterator(path)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".scene" && extension != ".json" && extension != ".txt") continue;
      std::error_code error;
      auto text = DiskFileSystem().read(entry.path(), Limits().any_file(), error);
      if (!text) continue;
      texts.push_back({entry.path().string(), std::move(*text),
                       extension == ".scene" ? SourceFormat::Scene : SourceFormat::Json});
    }
  }
  std::ranges::sort(texts, {}, &Text::name);
  return texts;
}

/// A text, and the cases of a file test, which are texts of their own.
std::vector<Text> with_cases(const Text& whole) {
  constexpr std::string_view kCase = "\n--- ";
  std::vector<Text> cases{whole};
  for (std::size_t at = whole.text.find(kCase); at != std::string::npos;) {
    const std::size_t begin = std::min(whole.text.find('\n', at + 1), whole.text.size());
    at = whole.text.find(kCase, begin);
    cases.push_back({whole.name, whole.text.substr(begin, at - begin), whole.format});
  }
  return cases;
}

void expect_lossless(const std::string& text, SourceFormat format) {
  std::uint32_t end = 0;
  for (const Token& token : test::tokenize(text, format)) {
    ASSERT_EQ(token.span.begin, end) << text;
    ASSERT_GT(token.span.size(), 0u) << text;
    ASSERT_LE(token.span.end, text.size()) << text;
    end = token.span.end;
  }
  ASSERT_EQ(end, text.size()) << text;
}

/// SplitMix64: the same damage in every run.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::size_t below(std::size_t bound) {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return static_cast<std::size_t>((z ^ (z >> 31)) % bound);
  }

 private:
  std::uint64_t state_;
};

TEST(Texts, AreTheirTokens) {
  const auto texts = all_texts();
  ASSERT_GT(texts.size(), 100u);
  for (const Text& text : texts) expect_lossless(text.text, text.format);
}

TEST(Texts, AreTheirTokensWhateverTheDamage) {
  const std::string bytes(
      "{}[]()\",:'\\/#*-+.0e9nNtu= \n\t\r\x01\x7F\x80\xC3\xA0\xE2\xEF\xFF\0;&|!?%^<>_ab", 50);
  Random random(1);
  const auto texts = all_texts();
  for (int i = 0; i < 3000 && !testing::Test::HasFailure(); ++i) {
    const Text& whole = texts[random.below(texts.size())];
    std::string text = whole.text.substr(random.below(whole.text.size()), 1 + random.below(2000));
    for (std::size_t k = 0; k < 12; ++k) {
      text.insert(random.below(text.size()), 1, bytes[random.below(bytes.size())]);
    }
    expect_lossless(text, whole.format);
  }
}

/// Whether a token can be part of a scene without mistakes.
bool is_of_language(TokenKind kind) {
  return kind != TokenKind::Unknown && kind != TokenKind::ForeignName &&
         kind != TokenKind::UnclosedComment && kind != TokenKind::UnclosedString;
}

TokenKind kind_of_leaf(SyntaxKind kind) {
  switch (kind) {
    case SyntaxKind::Version:
    case SyntaxKind::Number: return TokenKind::Number;
    case SyntaxKind::String: return TokenKind::String;
    case SyntaxKind::Color: return TokenKind::Color;
    case SyntaxKind::Name:
    case SyntaxKind::TypeName:
    case SyntaxKind::True:
    case SyntaxKind::False: return TokenKind::Name;
    default: return TokenKind::End;  // of several tokens
  }
}

void expect_agreement(const SyntaxTree& tree) {
  const std::string_view text = tree.file().text();
  std::set<std::uint32_t> boundaries{0};
  std::vector<Token> comments;
  for (const Token& token : test::tokenize(text)) {
    EXPECT_TRUE(is_of_language(token.kind)) << tree.text(token.span) << "\n" << text;
    boundaries.insert(token.span.end);
    if (is_comment(token.kind)) comments.push_back(token);
  }
  for (const SyntaxNode& node : tree.nodes()) {
    EXPECT_TRUE(boundaries.contains(node.begin)) << tree.text(node.span());
    EXPECT_TRUE(boundaries.contains(node.end)) << tree.text(node.span());
    EXPECT_TRUE(boundaries.contains(node.begin + node.head)) << tree.text(node.span());
    const TokenKind kind = kind_of_leaf(node.kind);
    if (kind == TokenKind::End) continue;
    const Token token = scene_token(text, node.begin);
    EXPECT_EQ(token.kind, kind) << tree.text(node.span());
    EXPECT_EQ(token.span, node.span()) << tree.text(node.span());
  }
  ASSERT_EQ(comments.size(), tree.comments().size()) << text;
  for (std::size_t i = 0; i < comments.size(); ++i) {
    const Comment& comment = tree.comments()[i];
    EXPECT_EQ(comments[i].span, comment.span);
    EXPECT_EQ(comments[i].kind, comment.kind == CommentKind::Doc     ? TokenKind::DocComment
                                : comment.kind == CommentKind::Block ? TokenKind::BlockComment
                                                                     : TokenKind::LineComment);
  }
}

TEST(Texts, AreReadAlikeByGrammarAndLexer) {
  std::size_t correct = 0;
  for (const Text& whole : all_texts()) {
    if (whole.format != SourceFormat::Scene) continue;
    for (const Text& text : with_cases(whole)) {
      const SourceFile file("test.scene", text.text);
      DiagnosticSink sink;
      const SyntaxTree tree = parse(file, sink);
      if (sink.has_errors()) continue;
      ++correct;
      expect_agreement(tree);
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(correct, 200u);
}

}  // namespace
}  // namespace sdlc::lang
