#pragma once

#include <optional>
#include <string>
#include <string_view>

/// What people write in place of JSON, and what they mean by it.
namespace sdlc::lang {

struct MendedNumber {
  std::string_view reason;          ///< why the text is no number of JSON
  std::optional<std::string> text;  ///< the number that was meant, as JSON writes it
  bool is_certain = true;
};

/// Precondition: `text` is not a number of JSON.
MendedNumber mend_number(std::string_view text);

/// "true", "false" or "null" where the word means one of these: True, None, undefined, yes, off.
std::optional<std::string_view> mend_literal(std::string_view word);

/// Whether the word, with or without a sign, means a number that is not finite: NaN, Infinity, inf.
bool names_non_finite(std::string_view word);

/// The text between other quotes as a JSON string.
std::string quote_for_json(std::string_view content);

}  // namespace sdlc::lang
