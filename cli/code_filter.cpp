#include "cli/code_filter.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "cli/words.hpp"
#include "lang/text/ascii.hpp"
#include "lang/text/display_width.hpp"

namespace sdlc::cli {
namespace {

/// The length of the longest prefix of `code` in `beginnings`; 0 if there is none.
std::size_t longest(const std::vector<std::string>& beginnings, std::string_view code) {
  std::size_t size = 0;
  for (const std::string& beginning : beginnings) {
    if (code.starts_with(beginning)) size = std::max(size, beginning.size());
  }
  return size;
}

bool fits_some_code(std::string_view beginning) {
  return std::ranges::any_of(lang::all_diagnostics(), [&](const lang::DiagnosticInfo* info) {
    return info->code.starts_with(beginning);
  });
}

void add_codes(Command& command, const std::string& flag, std::vector<std::string>& codes,
               const std::string& doc) {
  command
      .add_repeated(
          flag,
          [flag, &codes](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) {
              try {
                codes.push_back(parse_code(text));
              } catch (const std::invalid_argument& error) {
                throw ArgumentError(flag, error.what());
              }
            }
          },
          doc)
      .type_name("CODES")
      .comma_separated();
}

}  // namespace

std::string parse_code(std::string text) {
  text = lang::upper_case(text);
  if (!text.empty() && fits_some_code(text)) return text;
  std::vector<std::string_view> codes;
  for (const lang::DiagnosticInfo* info : lang::all_diagnostics()) codes.push_back(info->code);
  throw std::invalid_argument(fmt::format("no diagnostic code begins with `{}`{}",
                                          lang::printable(text), did_you_mean(text, codes)));
}

std::optional<bool> CodeFilter::answer(std::string_view code) const {
  const std::size_t against = longest(ignored, code);
  if (!selected.empty()) return longest(selected, code) > against;
  return against > 0 ? std::optional(false) : std::nullopt;
}

void add_code_filter(Command& command, CodeFilter& filter) {
  add_codes(command, "--select", filter.selected,
            "Only diagnostics with these codes or prefixes, such as E104,W4");
  add_codes(command, "--ignore", filter.ignored, "All except these");
}

}  // namespace sdlc::cli
