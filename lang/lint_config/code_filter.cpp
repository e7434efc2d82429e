#include "lang/lint_config/code_filter.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "lang/text/ascii.hpp"
#include "lang/text/display_width.hpp"
#include "lang/text/nearest_name.hpp"

namespace sdlc::lang {
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
  return std::ranges::any_of(all_diagnostics(), [&](const DiagnosticInfo* info) {
    return info->code.starts_with(beginning);
  });
}

}  // namespace

std::string parse_code(std::string text) {
  text = upper_case(text);
  if (!text.empty() && fits_some_code(text)) return text;
  std::vector<std::string_view> codes;
  for (const DiagnosticInfo* info : all_diagnostics()) codes.push_back(info->code);
  throw std::invalid_argument(fmt::format("no diagnostic code begins with `{}`{}", printable(text),
                                          did_you_mean(text, codes)));
}

std::optional<bool> CodeFilter::answer(std::string_view code) const {
  const std::size_t against = longest(ignored, code);
  if (!selected.empty()) return longest(selected, code) > against;
  return against > 0 ? std::optional(false) : std::nullopt;
}

}  // namespace sdlc::lang
