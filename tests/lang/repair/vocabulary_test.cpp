#include "lang/repair/vocabulary.hpp"

#include <set>
#include <string>
#include <type_traits>

#include <gtest/gtest.h>
#include <tao/pegtl/memory_input.hpp>
#include <tao/pegtl/parse.hpp>

#include "grammar/scene_tokens.hpp"
#include "lang/token/name_characters.hpp"

// The words and characters that token code knows are those of the grammar.
namespace sdlc::lang {
namespace {

namespace pegtl = tao::pegtl;
using Words = std::set<std::string>;

template <typename Rule>
bool matches(std::string_view text) {
  pegtl::memory_input<> in(text.data(), text.data() + text.size(), "");
  return pegtl::parse<pegtl::seq<Rule, pegtl::eof>>(in);
}

template <char... C>
std::string spelled(std::type_identity<grammar::word<C...>>) {
  return {C...};
}
template <char... C>
std::string spelled(std::type_identity<grammar::text<C...>>) {
  return {C...};
}
template <char C>
std::string spelled(std::type_identity<grammar::one<C>>) {
  return {C};
}

/// The alternatives of a rule that looks ahead at the first character.
template <typename First, typename... Rules>
Words alternatives(const pegtl::seq<pegtl::at<First>, pegtl::sor<Rules...>>& /*rule*/) {
  return {spelled(std::type_identity<Rules>())...};
}

TEST(Vocabulary, HasTheReservedWordsOfTheGrammar) {
  EXPECT_EQ(Words(kReservedWords.begin(), kReservedWords.end()), alternatives(grammar::reserved()));
  for (const std::string_view word : kReservedWords) {
    EXPECT_TRUE(matches<grammar::reserved>(word)) << word;
    EXPECT_FALSE(matches<grammar::name>(word)) << word;
  }
}

TEST(Vocabulary, HasTheUnitsOfTheGrammar) {
  EXPECT_EQ(Words(kUnits.begin(), kUnits.end()), alternatives(grammar::unit()));
  for (const std::string_view unit : kUnits) EXPECT_TRUE(matches<grammar::unit>(unit)) << unit;
}

TEST(NameCharacters, AreThoseOfTheGrammar) {
  for (int byte = 0; byte < 256; ++byte) {
    const std::string text(1, static_cast<char>(byte));
    EXPECT_EQ(is_digit(text[0]), matches<grammar::digit>(text)) << byte;
    EXPECT_EQ(is_letter(text[0]), matches<grammar::identifier>(text)) << byte;
    EXPECT_EQ(is_idchar(text[0]), matches<grammar::idchar>(text)) << byte;
  }
}

}  // namespace
}  // namespace sdlc::lang
