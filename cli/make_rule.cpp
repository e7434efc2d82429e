#include "cli/make_rule.hpp"

#include <cstddef>

#include <fmt/format.h>

#include "cli/usage_error.hpp"
#include "lang/text/display_width.hpp"

namespace sdlc::cli {
namespace {

/// The name as gcc -M writes it: a backslash before a space or #, the backslashes before a space
/// doubled, and $$ for a $. A colon, which gcc leaves as it is, also gets one: Make would stop
/// there.
std::string escaped(const std::string& name) {
  if (name.empty()) throw UsageError("the name of a file in a dependency file is empty");
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (c == '\n' || c == '\r') {
      throw UsageError(fmt::format("`{}` has a line break, and cannot be in a dependency file",
                                   lang::printable(name)));
    }
    if (c == ' ' || c == '\t') {
      for (std::size_t k = i; k > 0 && name[k - 1] == '\\'; --k) text += '\\';
    }
    if (c == ' ' || c == '\t' || c == '#' || c == ':') text += '\\';
    if (c == '$') text += '$';
    text += c;
  }
  return text;
}

}  // namespace

std::string make_rule(const std::vector<std::string>& targets,
                      const std::vector<std::string>& files) {
  std::string rule;
  for (const std::string& target : targets) rule += (rule.empty() ? "" : " ") + escaped(target);
  rule += ':';
  for (const std::string& file : files) rule += " \\\n  " + escaped(file);
  rule += '\n';
  for (std::size_t i = 1; i < files.size(); ++i) rule += "\n" + escaped(files[i]) + ":\n";
  return rule;
}

}  // namespace sdlc::cli
