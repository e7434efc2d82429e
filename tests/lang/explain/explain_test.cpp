#include "lang/explain/explain.hpp"

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/explain/pages.hpp"
#include "tests/docs/markdown.hpp"
#include "tests/support/temporary_folder.hpp"

// Checks the structure of the pages. tests/docs/blocks_test.cpp checks that their messages and
// examples are right.
namespace sdlc::lang {
namespace {

namespace fs = std::filesystem;

using test::CodeBlock;

std::string page_of(const DiagnosticInfo& info) {
  return std::string(explanation(info.code).value_or(""));
}

/// The kinds of the blocks below a heading: "scene-wrong", "message", …
std::vector<std::string> kinds_below(std::string_view page, std::string_view heading) {
  std::vector<std::string> kinds;
  for (const CodeBlock& block : test::code_blocks_of(page)) {
    if (block.heading == heading) kinds.push_back(block.words.at(1));
  }
  return kinds;
}

/// The codes in the messages of a page.
std::set<std::string> codes_told(std::string_view page) {
  static const std::regex head(R"((?:^|\n)(?:error|warning)\[(\w+)\]: )");
  std::set<std::string> codes;
  for (const CodeBlock& block : test::code_blocks_of(page)) {
    if (block.words.at(1) != "message" && block.words.at(1) != "session") continue;
    const std::sregex_iterator begin(block.text.begin(), block.text.end(), head), end;
    for (auto match = begin; match != end; ++match) codes.insert((*match)[1]);
  }
  return codes;
}

TEST(Explain, HasAPageForEveryCode) {
  for (const DiagnosticInfo* info : all_diagnostics()) {
    EXPECT_TRUE(explanation(info->code).has_value())
        << "docs/explain/" << info->code << ".md is missing: the page of " << info->name;
  }
}

TEST(Explain, HasNoOtherPages) {
  std::set<std::string_view> codes;
  for (const DiagnosticInfo* info : all_diagnostics()) codes.insert(info->code);
  for (const Page& page : kPages) {
    EXPECT_TRUE(codes.contains(page.name)) << "docs/explain/" << page.name << ".md has no row";
  }
  EXPECT_FALSE(explanation("E000").has_value());
  EXPECT_FALSE(explanation("").has_value());
}

TEST(Explain, HoldsThePagesByteForByte) {
  for (const Page& page : kPages) {
    const fs::path path =
        fs::path(SDLC_SOURCE_DIR) / "docs/explain" / (std::string(page.name) + ".md");
    EXPECT_TRUE(page.text == test::content_of(path)) << path;
  }
}

TEST(Explain, HeadsEachPageWithItsCodeAndName) {
  for (const DiagnosticInfo* info : all_diagnostics()) {
    const std::string heading = "# " + std::string(info->code) + ": " + title_of(*info) + "\n\n";
    EXPECT_TRUE(page_of(*info).starts_with(heading)) << info->code << " begins with " << heading;
  }
}

TEST(Explain, ShowsAWrongAndARightExampleOfEach) {
  for (const DiagnosticInfo* info : all_diagnostics()) {
    const std::string page = page_of(*info);
    const auto wrong = kinds_below(page, "Wrong"), right = kinds_below(page, "Right");
    const auto is_wrong = [](const std::string& kind) { return kind.ends_with("-wrong"); };
    const auto is_right = [](const std::string& kind) {
      return kind == "scene" || kind == "config";
    };
    EXPECT_TRUE(std::ranges::any_of(wrong, is_wrong)) << info->code;
    EXPECT_TRUE(std::ranges::any_of(right, is_right)) << info->code;
    EXPECT_FALSE(std::ranges::any_of(wrong, is_right)) << info->code;
    EXPECT_FALSE(std::ranges::any_of(right, is_wrong)) << info->code;
  }
}

TEST(Explain, ShowsExamplesThatAreWrongInThisWayOnly) {
  for (const DiagnosticInfo* info : all_diagnostics()) {
    EXPECT_EQ(codes_told(page_of(*info)), std::set<std::string>{std::string(info->code)});
  }
}

TEST(Explain, HasTextBeforeItsExamples) {
  for (const DiagnosticInfo* info : all_diagnostics()) {
    EXPECT_GT(page_of(*info).find("\n## Wrong\n"), 100u) << info->code;
  }
}

TEST(Explain, KnowsTheFamilyOfEveryCode) {
  for (const DiagnosticInfo* info : all_diagnostics()) {
    const auto count = std::ranges::count_if(kDiagnosticFamilies, [&](const auto& family) {
      return info->code.starts_with(family.prefix);
    });
    EXPECT_EQ(count, 1) << info->code;
  }
}

}  // namespace
}  // namespace sdlc::lang
