#pragma once

#include <cstdint>

#include "lang/json/config_scan.hpp"

namespace sdlc::lang {

/// A run of things that stands in the place of one value, up to what ends a value. Places are bytes
/// of the text.
struct ValueExtent {
  std::uint32_t end = 0;  ///< behind the last of them
  std::uint32_t first_end = 0;
  int things = 0;                 ///< strings and words
  int odd = 0;                    ///< operators, parentheses and whatever else no value has
  bool is_unclosed = false;       ///< the string that comes first
  bool lacks_quote = false;       ///< the word that comes first has its closing quote alone
  std::uint32_t inner_quote = 0;  ///< behind a quote that a word follows; 0: none
};

/// Measures what stands in the places of values, from the first place of a text to the last; the
/// work for all of them grows with the text.
class ValueExtents {
 public:
  explicit ValueExtents(const ConfigScan& scan) noexcept : scan_(scan) {}

  ValueExtent measure(std::uint32_t begin);

 private:
  bool ends(const ValueExtent& extent, std::uint32_t i) const;
  /// These take the string, the word or the sign at `i`; false where the value ends with it.
  bool take_string(ValueExtent& extent, std::uint32_t& i) const;
  bool take_word(ValueExtent& extent, std::uint32_t begin, std::uint32_t& i) const;
  void take_sign(ValueExtent& extent, std::uint32_t& i);
  std::uint32_t value_before_key(std::uint32_t begin, std::uint32_t end) const;
  std::uint32_t end_of_call(std::uint32_t i);

  const ConfigScan& scan_;
  std::uint32_t no_call_before_ = 0;  ///< parentheses that have been tried
};

}  // namespace sdlc::lang
