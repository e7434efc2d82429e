#include "cli/code_filter_options.hpp"

#include <stdexcept>
#include <string>
#include <vector>

namespace sdlc::cli {
namespace {

void add_codes(Command& command, const std::string& flag, std::vector<std::string>& codes,
               const std::string& doc) {
  command
      .add_repeated(
          flag,
          [flag, &codes](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) {
              try {
                codes.push_back(lang::parse_code(text));
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

void add_code_filter(Command& command, lang::CodeFilter& filter) {
  add_codes(command, "--select", filter.selected,
            "Only diagnostics with these codes or prefixes, such as E104,W4");
  add_codes(command, "--ignore", filter.ignored, "All except these");
}

}  // namespace sdlc::cli
