#include "cli/words.hpp"

#include <string>

#include <fmt/format.h>

#include "lang/text/nearest_name.hpp"

namespace sdlc::cli {

std::string did_you_mean(std::string_view name, std::span<const std::string_view> candidates) {
  const auto nearest = lang::nearest_name(name, candidates);
  return nearest ? fmt::format(" (did you mean `{}`?)", *nearest) : std::string();
}

}  // namespace sdlc::cli
