#include "tests/docs/reference_tables.hpp"

#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/docs/markdown.hpp"
#include "tests/support/temporary_folder.hpp"

// The tables of the language reference match the code. SDLC_UPDATE=1 rewrites the page.
namespace sdlc::test {
namespace {

const std::filesystem::path kPage = std::filesystem::path(SDLC_SOURCE_DIR) / "docs/language.md";

std::vector<std::string> names_of(const std::vector<GeneratedPart>& parts) {
  std::vector<std::string> names;
  for (const GeneratedPart& part : parts) names.push_back(part.name);
  return names;
}

TEST(LanguageReference, HasAPlaceForEveryTable) {
  EXPECT_THAT(names_of(generated_parts_of(content_of(kPage))),
              testing::UnorderedElementsAreArray(names_of(reference_parts())));
}

TEST(LanguageReference, ShowsTheTablesOfTheCode) {
  std::string page = content_of(kPage);
  if (std::getenv("SDLC_UPDATE") != nullptr) {
    for (const GeneratedPart& part : reference_parts()) page = replace_generated_part(page, part);
    return write_text(kPage, page);
  }
  std::map<std::string, std::string> shown;
  for (const GeneratedPart& part : generated_parts_of(page)) shown[part.name] = part.text;
  for (const GeneratedPart& part : reference_parts()) {
    EXPECT_EQ(shown[part.name], part.text)
        << "`" << part.name << "`; SDLC_UPDATE=1 rewrites " << kPage;
  }
}

}  // namespace
}  // namespace sdlc::test
