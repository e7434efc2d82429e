#include "tests/support/case_flags/case_flags.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "lang/source/limits.hpp"

namespace sdlc::test {

lang::ProgramOptions program_options(const FileCase& file_case, lang::Workspace& workspace) {
  lang::ProgramOptions options{.workspace = &workspace, .limits = {}};
  for (const CaseText& text : file_case.texts) {
    if (!text.is_flag()) continue;
    const std::size_t blank = std::min(text.name.find(' '), text.name.size());
    const std::string flag = text.name.substr(0, blank);
    const std::string name = text.name.substr(std::min(blank + 1, text.name.size()));
    std::string value = text.text();
    if (!value.empty()) value.pop_back();  // the line break after the last line
    const auto limit = std::find_if(lang::kLimits.begin(), lang::kLimits.end(),
                                    [&](const auto& known) { return known.name == name; });
    if (flag == "--set") {
      options.sets.push_back({.name = name, .value = value});
    } else if (flag == "--limit" && limit != lang::kLimits.end()) {
      options.limits.*(limit->limit) = std::stoull(value);
    } else if (flag == "--sandbox") {
      options.is_sandboxed = true;
    } else {
      throw std::runtime_error("no flag of file tests: " + text.name);
    }
  }
  return options;
}

}  // namespace sdlc::test
