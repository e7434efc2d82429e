#include "lang/json/value_extent.hpp"

#include "lang/text/utf8.hpp"

namespace sdlc::lang {

ValueExtent ValueExtents::measure(std::uint32_t begin) {
  ValueExtent extent{.end = begin};
  for (std::uint32_t i = begin; true;) {
    i = scan_.skip_blanks(i);
    if (ends(extent, i)) return extent;
    if (const std::uint32_t blank = scan_.foreign_blank(i); blank != 0) {
      i += blank;
      continue;
    }
    if (scan_.begins_string(i)) {
      if (!take_string(extent, i)) return extent;
    } else if (scan_.begins_word(i)) {
      if (!take_word(extent, begin, i)) return extent;
    } else {
      take_sign(extent, i);
    }
    extent.end = i;
    if (extent.first_end == 0) extent.first_end = i;
  }
}

/// Whether the value ends before `i`: at a mark, a comment or the next key.
bool ValueExtents::ends(const ValueExtent& extent, std::uint32_t i) const {
  const char c = scan_.at(i);
  if (scan_.ends_line(i) || is_one_of(c, ",}];):{[#")) return true;
  if (c == '/' && is_one_of(scan_.at(i + 1), "/*")) return true;
  if (extent.things + extent.odd == 0) return false;
  if (scan_.begins_string(i)) {
    const std::uint32_t end = scan_.end_of_string(i);
    return end != 0 && scan_.is_label_end(end);
  }
  return scan_.begins_word(i) && scan_.is_label_end(scan_.end_of_word(i));
}

bool ValueExtents::take_string(ValueExtent& extent, std::uint32_t& i) const {
  const std::uint32_t end = scan_.end_of_string(i);
  const bool is_inner =
      end != 0 && (is_ascii_letter(scan_.at(end)) || is_ascii_digit(scan_.at(end)));
  const std::uint32_t before_key = is_inner ? value_before_key(i, end) : 0;
  if (end == 0 || before_key != 0) {
    extent.is_unclosed = extent.things + extent.odd == 0;
    extent.odd += extent.is_unclosed ? 0 : 1;
    extent.end = end == 0 ? scan_.end_of_unclosed(i) : before_key;
    return false;
  }
  if (is_inner && extent.inner_quote == 0) extent.inner_quote = end;
  ++extent.things;
  i = end;
  return true;
}

bool ValueExtents::take_word(ValueExtent& extent, std::uint32_t begin, std::uint32_t& i) const {
  const char first = scan_.at(i);
  const std::uint32_t end = scan_.end_of_word(i);
  const bool is_alone = i == begin && scan_.is_value_end(scan_.skip_blanks(end));
  const bool is_operator =
      end == i + 1 && !is_ascii_letter(first) && !is_ascii_digit(first) && !is_alone;
  ++(is_operator ? extent.odd : extent.things);
  i = end;
  const bool is_first = extent.things == 1 && extent.odd == 0;
  if (scan_.at(i) != '"' || !is_first || !is_ascii_letter(scan_.at(begin))) return true;
  extent.lacks_quote = true;
  extent.end = i + 1;
  return false;
}

void ValueExtents::take_sign(ValueExtent& extent, std::uint32_t& i) {
  ++extent.odd;
  const std::uint32_t call = scan_.at(i) == '(' ? end_of_call(i) : 0;
  if (call != 0) ++extent.things;
  i = call != 0 ? call : i + decode_utf8(scan_.text().substr(i)).size;
}

/// "a.png, "next": the string from `begin` to `end` ends at the quote of a key, whose own text
/// follows. Returns the end of the value; 0 where it is not so.
std::uint32_t ValueExtents::value_before_key(std::uint32_t begin, std::uint32_t end) const {
  std::uint32_t word = end;
  while (is_word(scan_.at(word))) ++word;
  if (scan_.at(word) != '"' || !scan_.is_label_end(word + 1)) return 0;
  std::uint32_t last = end - 1;
  while (last > begin && is_one_of(scan_.at(last - 1), " \t")) --last;
  if (last <= begin + 1 || scan_.at(last - 1) != ',') return 0;
  return last - 1;
}

/// Behind the parenthesis that closes the one at `i`, if the line has it; else 0.
std::uint32_t ValueExtents::end_of_call(std::uint32_t i) {
  if (i < no_call_before_) return 0;
  int depth = 0;
  for (; !scan_.ends_line(i) && scan_.at(i) != '{' && scan_.at(i) != '}'; ++i) {
    if (scan_.at(i) == '"') {
      const std::uint32_t end = scan_.end_of_string(i);
      if (end == 0) break;
      i = end - 1;
    } else if (scan_.at(i) == '(') {
      ++depth;
    } else if (scan_.at(i) == ')' && --depth == 0) {
      return i + 1;
    }
  }
  no_call_before_ = i;
  return 0;
}

}  // namespace sdlc::lang
