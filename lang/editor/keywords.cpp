#include "lang/editor/keywords.hpp"

#include <algorithm>
#include <array>

#include "lang/repair/vocabulary.hpp"

namespace sdlc::lang {
namespace {

constexpr std::string_view kConditional = "if condition then value else value";

constexpr auto kKeywords = std::to_array<Keyword>({
    {"scene", "scene 1", "The version of the language: the first statement of a file."},
    {"let", "let name = value",
     "Names a value; in a value, `let a = …, b = … in value` names parts of it."},
    {"param", "param name: type = value",
     "Names a value that `sdlc render --set name=value` replaces."},
    {"fn", "fn name(parameter, …) = value", "Defines a function of values, also in a block."},
    {"def", "def name(parameter, …) { … }",
     "Defines a kind of object; its instances are groups with the objects in the block."},
    {"import", "import \"file.scene\" as name",
     "Makes the values, functions and kinds of another file available as `name.…`."},
    {"include", "include \"file.scene\"", "Places the objects of another file here."},
    {"assert", "assert condition, \"message\"", "Reports the message if the condition is false."},
    {"for", "for name in list { … }",
     "Places the objects in the block once per element; in brackets, `[value for name in list]` is "
     "a list."},
    {"if", kConditional,
     "Chooses one of two values; as a statement, `if condition { … } else { … }` chooses objects."},
    {"then", kConditional, "Precedes the value if the condition is true."},
    {"else", kConditional, "Precedes what is chosen if the condition is false."},
    {"and", "a and b", "True if both are; `b` is evaluated only if `a` is true."},
    {"or", "a or b", "True if one is; `b` is evaluated only if `a` is false."},
    {"not", "not a", "True if `a` is false."},
    {"true", "true", "The value of a condition that holds."},
    {"false", "false", "The value of a condition that does not hold."},
    {"as", "import \"file.scene\" as name", "Precedes the name of an imported file."},
    {"in", "for name in list { … }",
     "Precedes the list of a loop, or the value of `let name = … in value`."},
});

constexpr bool has_all_reserved_words() {
  return std::ranges::all_of(kReservedWords, [](std::string_view word) {
    return std::ranges::find(kKeywords, word, &Keyword::word) != kKeywords.end();
  });
}
static_assert(has_all_reserved_words());
static_assert(kKeywords.size() == kReservedWords.size() + 3);

}  // namespace

std::span<const Keyword> all_keywords() noexcept { return kKeywords; }

const Keyword* find_keyword(std::string_view word) noexcept {
  const auto found = std::ranges::find(kKeywords, word, &Keyword::word);
  return found == kKeywords.end() ? nullptr : &*found;
}

}  // namespace sdlc::lang
