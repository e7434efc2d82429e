#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "lang/schema/habits.hpp"

namespace sdlc::lang {

/// A word that begins a statement of another language.
struct ForeignWord {
  enum Kind : std::uint8_t {
    Value,      ///< `var x = …`
    Function,   ///< `function f(…)`
    Loop,       ///< `foreach x in …`
    Statement,  ///< one that has no counterpart
  };

  std::string_view text;
  Kind kind;
  std::string_view meant;  ///< the word of the language; empty: see help
  std::string_view help = {};
};

inline constexpr std::string_view kNameLetters =
    "names consist of the letters a to z and A to Z, digits and `_`";
inline constexpr std::string_view kFunction = "a function is one expression: `fn f(x) = …`";

inline constexpr auto kForeignWords = std::to_array<ForeignWord>({
    {"var", ForeignWord::Value, "let"},
    {"val", ForeignWord::Value, "let"},
    {"const", ForeignWord::Value, "let"},
    {"auto", ForeignWord::Value, "let"},
    {"int", ForeignWord::Value, "let"},
    {"float", ForeignWord::Value, "let"},
    {"double", ForeignWord::Value, "let"},
    {"number", ForeignWord::Value, "let"},
    {"bool", ForeignWord::Value, "let"},
    {"string", ForeignWord::Value, "let"},
    {"vec3", ForeignWord::Value, "let"},
    {"color", ForeignWord::Value, "let"},
    {"material", ForeignWord::Value, "let"},
    {"function", ForeignWord::Function, "fn"},
    {"func", ForeignWord::Function, "fn"},
    {"fun", ForeignWord::Function, "fn"},
    {"foreach", ForeignWord::Loop, "for"},
    {"while", ForeignWord::Statement, "", kNoLoop},
    {"do", ForeignWord::Statement, "", kNoLoop},
    {"repeat", ForeignWord::Statement, "", kNoLoop},
    {"loop", ForeignWord::Statement, "", kNoLoop},
    {"return", ForeignWord::Statement, "", kFunction},
    {"pass", ForeignWord::Statement, "", "a block may be empty: `{ }`"},
    {"module", ForeignWord::Statement, "", kOwnKind},
    {"class", ForeignWord::Statement, "", kOwnKind},
    {"switch", ForeignWord::Statement, "", "write `if … { … } else if … { … }`"},
    {"match", ForeignWord::Statement, "", "write `if … { … } else if … { … }`"},
});

/// The word that is written exactly so; null where there is none.
inline const ForeignWord* find_foreign_word(std::string_view text) noexcept {
  const auto found = std::find_if(kForeignWords.begin(), kForeignWords.end(),
                                  [&](const ForeignWord& word) { return word.text == text; });
  return found == kForeignWords.end() ? nullptr : &*found;
}

}  // namespace sdlc::lang
