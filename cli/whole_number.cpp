#include "cli/whole_number.hpp"

#include <charconv>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "lang/text/display_width.hpp"

namespace sdlc::cli {

std::uint64_t parse_whole_number(const std::string& flag, const std::string& text,
                                 WholeNumbers range) {
  std::uint64_t number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end || number < range.lowest || number > range.highest) {
    throw ArgumentError(flag, fmt::format("takes a whole number from {} to {}, not `{}`",
                                          range.lowest, range.highest, lang::printable(text)));
  }
  return number;
}

Option add_whole_number(Command& command, const std::string& flag, WholeNumbers range,
                        std::function<void(std::uint64_t)> take, const std::string& doc) {
  return command
      .add_text(
          flag,
          [flag, range, take = std::move(take)](const std::string& text) {
            take(parse_whole_number(flag, text, range));
          },
          doc)
      .type_name("N");
}

}  // namespace sdlc::cli
