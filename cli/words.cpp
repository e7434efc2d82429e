#include "cli/words.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lang/text/nearest_name.hpp"

namespace sdlc::cli {

std::string did_you_mean(std::string_view name, std::span<const std::string_view> candidates) {
  const auto nearest = lang::nearest_name(name, candidates);
  return nearest ? fmt::format(" (did you mean `{}`?)", *nearest) : std::string();
}

CLI::Validator one_of(std::span<const std::string_view> words) {
  const auto check = [words](std::string& text) -> std::string {
    if (std::find(words.begin(), words.end(), text) != words.end()) return {};
    return fmt::format("`{}` is not one of {}{}", text, fmt::join(words, ", "),
                       did_you_mean(text, words));
  };
  return CLI::Validator(check, fmt::format("{}", fmt::join(words, "|")));
}

}  // namespace sdlc::cli
