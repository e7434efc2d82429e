#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lang/source/source.hpp"
#include "lang/text/bracket_repair.hpp"

namespace sdlc::lang {

/// Several tokens that mean something in another language, and what they mean here: one mistake.
struct ForeignPhrase {
  enum Kind : std::uint8_t {
    Expected,  ///< `message` says what was expected
    Foreign,   ///< `message` is what is no part of the language
    NoVersion,
  };

  Kind kind = Expected;
  Span span;
  std::string message;
  std::string help;  ///< empty where the edits say it all
  std::vector<std::pair<Span, std::string>> edits = {};
  bool is_safe = false;  ///< the edits can be made unasked
};

struct ForeignPhrases {
  std::vector<ForeignPhrase> phrases;
  std::vector<bool> is_told;      ///< of each token: that it is not what was meant
  std::deque<std::string> words;  ///< what tokens are meant to be, where it is not a constant
};

/// Finds phrases of other languages and makes their tokens what was meant. Where something is
/// missing that the text has no place for, such as the braces around an indented block, a token
/// without length takes its place.
ForeignPhrases mark_foreign_phrases(std::string_view text, std::vector<LayoutToken>& tokens);

}  // namespace sdlc::lang
