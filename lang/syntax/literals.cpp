#include <array>
#include <charconv>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "lang/repair/habits.hpp"
#include "lang/repair/repair_report.hpp"
#include "lang/repair/vocabulary.hpp"
#include "lang/syntax/tree_builder.hpp"
#include "lang/token/name_characters.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

struct NumberFault {
  std::string reason;
  std::string replacement;  ///< empty: none is known
  bool is_certain = true;
  std::string help = {};  ///< empty: a general one
};

/// The end of the longest number at the beginning of `text`, without its unit; misplaced `_` and a
/// missing exponent are accepted.
std::size_t end_of_digits(std::string_view text) {
  std::size_t i = 0;
  const auto digits = [&] {
    while (is_digit(char_at(text, i)) || char_at(text, i) == '_') ++i;
  };
  digits();
  if (char_at(text, i) == '.') ++i, digits();
  const char e = char_at(text, i);
  if (e == 'e' || e == 'E') {
    std::size_t j = i + 1;
    if (char_at(text, j) == '+' || char_at(text, j) == '-') ++j;
    if (is_digit(char_at(text, j)) || !is_letter(char_at(text, j))) i = j, digits();
  }
  return i;
}

/// The number with each `_` between digits only and a digit after its point.
std::string tidied(std::string_view number) {
  std::string tidy;
  for (std::size_t i = 0; i < number.size(); ++i) {
    const bool joins = i > 0 && is_digit(number[i - 1]) && is_digit(char_at(number, i + 1));
    if (number[i] != '_' || joins) tidy += number[i];
    if (number[i] == '.' && !is_digit(char_at(number, i + 1))) tidy += '0';
  }
  return tidy;
}

/// `0xff8000`, which is a colour or a number.
bool may_be_color(std::string_view number) {
  return (number.starts_with("0x") || number.starts_with("0X")) &&
         (number.size() == 8 || number.size() == 5) &&
         number.find_first_not_of("0123456789abcdefABCDEF", 2) == std::string_view::npos;
}

NumberFault number_fault(std::string_view text) {
  const char base = char_at(text, 1);
  if (text[0] == '0' && (base == 'x' || base == 'X' || base == 'b' || base == 'o')) {
    std::uint64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [ptr, error] = std::from_chars(text.data() + 2, end, value,
                                              base == 'b'   ? 2
                                              : base == 'o' ? 8
                                                            : 16);
    const bool is_read = error == std::errc() && ptr == end;
    return {"numbers are decimal", is_read && !may_be_color(text) ? std::to_string(value) : ""};
  }

  const std::size_t digits = end_of_digits(text);
  const std::string_view number = text.substr(0, digits), suffix = text.substr(digits);
  if (number.find('_') != std::string_view::npos && tidied(number) != number) {
    const bool is_whole = tidied(number).size() < number.size();
    return {"a `_` must be between two digits", tidied(number) + std::string(suffix), is_whole};
  }
  if (suffix.starts_with('.')) return {"it has two points", ""};
  const std::size_t e = number.find_first_of("eE");
  if (e != std::string_view::npos && !is_digit(number.back())) {
    return {fmt::format("digits are missing after the `{}`", number.substr(e)), ""};
  }
  if (tidied(number) != number) {
    return {"a digit is missing after the point", tidied(number) + std::string(suffix), false};
  }
  const bool is_remainder = suffix.starts_with('%') && suffix.size() > 1;  // 5%3
  const auto unit =
      is_remainder ? find_habit(HabitPlace::Sign, "%") : find_habit(HabitPlace::Unit, suffix);
  const bool has_meaning = unit && !unit->meant.empty();
  return {.reason = fmt::format("there is no unit `{}`", suffix),
          .replacement = has_meaning ? fmt::format("{}{}", number, unit->meant) : "",
          .help = unit ? std::string(unit->help) : ""};
}

}  // namespace

std::uint32_t diagnose_number(TreeBuilder& builder, std::uint32_t begin) {
  const std::string_view text = builder.text();
  const std::uint32_t end = token_at(text, begin).end;
  const std::string_view number = text.substr(begin, end - begin);
  const NumberFault fault = number_fault(number);
  const Location where = builder.location({begin, end});
  auto report = builder.sink().report(diag::bad_number, where, number, fault.reason);
  if (!fault.replacement.empty()) {
    add_fix(report, fault.is_certain, where, fault.replacement);
  } else if (may_be_color(number) || is_color_without_sign(number)) {
    const std::string color = fmt::format("#{}", number.substr(may_be_color(number) ? 2 : 0));
    report.help(fmt::format("a colour is `{}`", color)).unsafe_fix(where, color);
  } else if (!fault.help.empty()) {
    report.help(fault.help);
  } else if (fault.reason.starts_with("there is no unit")) {
    report.help(fmt::format("units are {}", fmt::join(kUnits, ", ")));
  }
  return end;
}

std::uint32_t diagnose_string(TreeBuilder& builder, std::uint32_t begin) {
  const std::string_view text = builder.text();
  bool is_wrong = false;
  const auto wrong = [&](std::uint32_t from, std::uint32_t to, std::string what) {
    is_wrong = true;
    return builder.sink().report(diag::bad_string, builder.location({from, to}), what);
  };

  std::uint32_t at = begin + 1;
  while (at < text.size() && text[at] != '"' && text[at] != '\n') {
    if (text[at] == '\t')
      wrong(at, at + 1, "a tab").unsafe_fix(builder.location({at, at + 1}), "\\t");
    if (text[at] != '\\') {
      ++at;
      continue;
    }
    const char escape = char_at(text, at + 1);
    std::uint32_t end = at + 2;
    bool is_known = std::string_view("\"\\/bfnrt").find(escape) != std::string_view::npos;
    if (escape == 'u') {
      while (end < at + 6 &&
             std::string_view("0123456789abcdefABCDEF").find(char_at(text, end)) !=
                 std::string_view::npos &&
             char_at(text, end) != '\0') {
        ++end;
      }
      is_known = end == at + 6;
    }
    if (escape == '\0' || escape == '\n') break;
    if (!is_known) {
      end = std::max(end, token_at(text, at + 1).end);
      if (escape != 'u') end = at + 2;
      const std::string_view spelled = text.substr(at, end - at);
      auto report = wrong(at, end, fmt::format("the unknown escape `{}`", spelled));
      if (escape == 'u') {
        report.help("four hexadecimal digits follow `\\u`");
      } else {
        report.help("write `\\\\` for a backslash")
            .unsafe_fix(builder.location({at, at + 1}), "\\\\");
      }
    }
    at = end;
  }
  if (char_at(text, at) == '"') return at + 1;

  builder.sink()
      .report(diag::unclosed, builder.location({begin, begin + 1}), "\"")
      .help("a string ends in the line that it begins in");
  return end_of_unclosed_string(text, token_at(text, begin));
}

bool check_color(TreeBuilder& builder, Span color) {
  const std::string_view text = builder.text().substr(color.begin, color.size());
  const std::string_view digits = text.substr(1);
  const std::size_t other = digits.find_first_not_of("0123456789abcdefABCDEF");
  if (other == std::string_view::npos && (digits.size() == 3 || digits.size() == 6)) return true;

  const Location where = builder.location(color);
  if (other != std::string_view::npos) {
    builder.sink().report(diag::bad_color, where, text,
                          fmt::format("`{}` is no hexadecimal digit", digits[other]));
  } else if (digits.size() == 4 || digits.size() == 8) {
    builder.sink()
        .report(diag::bad_color, where, text, "colours have no alpha")
        .unsafe_fix(where, std::string(text.substr(0, 1 + digits.size() / 4 * 3)));
  } else {
    builder.sink().report(diag::bad_color, where, text,
                          fmt::format("it takes 3 or 6 digits, not {}", digits.size()));
  }
  return false;
}

}  // namespace sdlc::lang
