#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/explain/explain.hpp"
#include "tests/docs/markdown.hpp"
#include "tests/docs/reference_tables.hpp"
#include "tests/support/temporary_folder.hpp"

// The index of docs/explain matches the table of diagnostics. SDLC_UPDATE=1 rewrites it.
namespace sdlc::test {
namespace {

const std::filesystem::path kIndex =
    std::filesystem::path(SDLC_SOURCE_DIR) / "docs/explain/README.md";

std::vector<GeneratedPart> index_parts() {
  std::vector<GeneratedPart> parts;
  for (const lang::DiagnosticFamily& family : lang::kDiagnosticFamilies) {
    std::string text = "| code | | message |\n| --- | --- | --- |\n";
    for (const lang::DiagnosticInfo* info : lang::all_diagnostics()) {
      if (!info->code.starts_with(family.prefix)) continue;
      text += fmt::format("| [{0}]({0}.md) | {1} | {2} |\n", info->code, title_of(*info),
                          shown_message(info->message));
    }
    parts.push_back({fmt::format("{}xx", family.prefix), text});
  }
  return parts;
}

TEST(ExplainIndex, ListsEveryCode) {
  std::string page = content_of(kIndex);
  if (std::getenv("SDLC_UPDATE") != nullptr) {
    for (const GeneratedPart& part : index_parts()) page = replace_generated_part(page, part);
    return write_text(kIndex, page);
  }
  const std::vector<GeneratedPart> shown = generated_parts_of(page), expected = index_parts();
  ASSERT_EQ(shown.size(), expected.size());
  for (std::size_t i = 0; i < shown.size(); ++i) {
    EXPECT_EQ(shown[i].name, expected[i].name);
    EXPECT_EQ(shown[i].text, expected[i].text) << "SDLC_UPDATE=1 rewrites " << kIndex;
  }
}

}  // namespace
}  // namespace sdlc::test
