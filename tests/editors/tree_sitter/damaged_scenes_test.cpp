#include <cstddef>
#include <cstdint>
#include <iterator>
#include <regex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <tao/pegtl/memory_input.hpp>
#include <tao/pegtl/parse.hpp>

#include "grammar/scene.hpp"
#include "lang/token/token_reader.hpp"
#include "tests/editors/tree_sitter/example_captures.hpp"
#include "tests/editors/tree_sitter/scene_tree.hpp"
#include "tests/support/temporary_folder.hpp"

// Texts that nobody wrote: the two grammars agree which of them are scenes.
namespace sdlc::test {
namespace {

bool has_wrong_color(std::string_view text) {
  static const std::regex kColor("#([0-9a-fA-F]{3}|[0-9a-fA-F]{6})");
  lang::TokenReader reader(text);
  for (auto token = reader.next(); token.kind != lang::TokenKind::End; token = reader.next()) {
    const std::string color(reader.text(token));
    if (token.kind == lang::TokenKind::Color && !std::regex_match(color, kColor)) return true;
  }
  return false;
}

/// Whether the text is a scene by the grammar alone, which leaves the digits of a color open.
bool is_scene(std::string_view text) {
  namespace pegtl = tao::pegtl;
  pegtl::memory_input<pegtl::tracking_mode::lazy, pegtl::eol::lf> in(text.data(),
                                                                     text.data() + text.size(), "");
  try {
    return pegtl::parse<grammar::file>(in) && !has_wrong_color(text);
  } catch (const pegtl::parse_error&) {
    return false;
  }
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

/// A scene with every statement and every form of expression.
std::string whole_scene() { return content_of(SDLC_SOURCE_DIR "/tests/files/frozen/whole.scene"); }

std::vector<std::string> tokens_of(std::string_view text) {
  std::vector<std::string> tokens;
  lang::TokenReader reader(text);
  for (auto token = reader.next(); token.kind != lang::TokenKind::End; token = reader.next()) {
    tokens.emplace_back(reader.text(token));
  }
  return tokens;
}

/// Words and marks that begin, continue and end everything.
constexpr std::string_view kPieces[] = {
    "let",  "fn",   "def",  "param", "import", "include", "assert", "for", "if", "and",
    "or",   "then", "else", "not",   "true",   "scene",   "as",     "in",  "(",  ")",
    "[",    "]",    "{",    "}",     ",",      ":",       "=",      "==",  "<",  "..",
    ".",    "+",    "-",    "*",     "/",      "^",       "a",      "1",   "2m", "\"s\"",
    "#fff", " ",    "\n",   "\r\n",  "// c\n", "/* c */", "5min",   "1.",  "!",  "\"",
    "/*",   "a: 1", "a {}", "0x1",   "\\",     "\u00E9"};

/// Deletes, repeats, exchanges or adds a few tokens.
std::string damaged(std::vector<std::string> tokens, Random& random) {
  for (std::size_t i = random.below(3); i < 3; ++i) {
    const std::size_t at = random.below(tokens.size()), other = random.below(tokens.size());
    const auto place = tokens.begin() + static_cast<std::ptrdiff_t>(at);
    switch (random.below(5)) {
      case 0: tokens.erase(place); break;
      case 1: tokens.insert(place, std::string(tokens[other])); break;
      case 2: std::swap(tokens[at], tokens[other]); break;
      case 3: tokens[at] = kPieces[random.below(std::size(kPieces))]; break;
      default: tokens.insert(place, std::string(kPieces[random.below(std::size(kPieces))]));
    }
  }
  std::string text;
  for (const std::string& token : tokens) text += token;
  return text;
}

TEST(TreeSitterDamagedScenes, AreScenesByBothGrammarsOrByNone) {
  const std::vector<std::string> tokens = tokens_of(whole_scene());
  Random random(1);
  int scenes = 0, others = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::string text = damaged(tokens, random);
    // Both read the rest of a scene without its first tokens, one of them as a scene.
    if (!text.starts_with("/// Every statement") || text.find("\nscene 1\n") > 200) continue;
    const bool is_correct = is_scene(text);
    ++(is_correct ? scenes : others);
    const SceneTree tree(text);
    ASSERT_EQ(tree.first_error().empty(), is_correct) << tree.first_error() << "\n" << text;
  }
  EXPECT_GT(scenes, 100);
  EXPECT_GT(others, 1000);
}

/// Typing: a piece is put somewhere, and taken away again.
TEST(TreeSitterDamagedScenes, AreReadAsAnewWhenTheyAreRepaired) {
  const std::string text = whole_scene();
  const SceneTree whole(text);
  const std::string shape = whole.shape();
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    const auto at = static_cast<std::uint32_t>(random.below(text.size()));
    const std::string_view piece = kPieces[random.below(std::size(kPieces))];
    const auto size = static_cast<std::uint32_t>(piece.size());
    const std::string longer = std::string(text).insert(at, piece);
    const SceneTree typed(whole, longer, {at, at}, size);
    ASSERT_EQ(typed.has_error(), SceneTree(longer).has_error()) << at << " " << piece;
    const SceneTree repaired(typed, text, {at, at + size}, 0);
    ASSERT_EQ(repaired.shape(), shape) << at << " " << piece;
  }
}

}  // namespace
}  // namespace sdlc::test
