#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lint/rules.hpp"
#include "tests/docs/markdown.hpp"
#include "tests/docs/reference_tables.hpp"
#include "tests/support/temporary_folder.hpp"

// The table of rules in docs/lint.md matches the code. SDLC_UPDATE=1 rewrites it.
namespace sdlc::test {
namespace {

const std::filesystem::path kPage = std::filesystem::path(SDLC_SOURCE_DIR) / "docs/lint.md";

std::string_view scope_text(lang::RuleScope scope) {
  switch (scope) {
    case lang::RuleScope::Text: return "the text";
    case lang::RuleScope::AnyFrame: return "a frame";
    case lang::RuleScope::EveryFrame: return "all frames";
  }
  return "";
}

std::string_view fix_text(lang::RuleFix fix) {
  switch (fix) {
    case lang::RuleFix::None: return "";
    case lang::RuleFix::Unsafe: return "`--unsafe-fixes`";
    case lang::RuleFix::Safe: return "`--fix`";
  }
  return "";
}

GeneratedPart rule_table() {
  std::string text =
      "| code | name | what it finds | of a film | fix |\n| --- | --- | --- | --- | --- |\n";
  for (const lang::DiagnosticInfo* info : lang::all_diagnostics()) {
    const auto rule = std::ranges::find(lang::all_rules(), info, &lang::Rule::info);
    if (rule == lang::all_rules().end()) continue;
    text +=
        fmt::format("| [{0}](explain/{0}.md) | {1} | {2} | {3} | {4} |\n", info->code, info->name,
                    shown_message(info->message), scope_text(rule->scope), fix_text(rule->fix));
  }
  return {"rules", text};
}

TEST(LintPage, ListsEveryRule) {
  const std::string page = content_of(kPage);
  if (std::getenv("SDLC_UPDATE") != nullptr) {
    return write_text(kPage, replace_generated_part(page, rule_table()));
  }
  const auto parts = generated_parts_of(page);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].name, rule_table().name);
  EXPECT_EQ(parts[0].text, rule_table().text) << "SDLC_UPDATE=1 rewrites " << kPage;
}

}  // namespace
}  // namespace sdlc::test
