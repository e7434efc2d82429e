#include <algorithm>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/lang/format/scene_texts.hpp"
#include "tests/support/file_test.hpp"
#include "tests/support/folder_lock.hpp"
#include "tests/support/temporary_folder.hpp"

// The cases of tests/files/format: a text, a line `>>>`, and the formatted text.
namespace sdlc::test {
namespace {

constexpr std::string_view kArrow = ">>>";

std::string joined(std::vector<std::string>::const_iterator begin,
                   std::vector<std::string>::const_iterator end) {
  std::string text;
  for (; begin != end; ++begin) text += *begin + '\n';
  return text;
}

struct TwoTexts {
  std::string before, after;
};

TwoTexts texts_of(const FileCase& file_case) {
  const std::vector<std::string>& lines = file_case.texts.front().lines;
  const auto arrow = std::ranges::find(lines, kArrow);
  EXPECT_NE(arrow, lines.end()) << "the case has no line " << kArrow;
  return {joined(lines.begin(), arrow), arrow == lines.end() ? "" : joined(arrow + 1, lines.end())};
}

/// Writes the result to the case's file.
void update(const FileCase& file_case, const std::string& outcome) {
  const FolderLock lock(file_case.file.parent_path());
  std::string text = content_of(file_case.file);
  const std::string head = "--- " + file_case.name + " ---\n";
  const std::size_t begin = text.find("\n>>>\n", text.find(head)) + 5;
  const std::size_t next = text.find("\n--- ", begin - 1);
  const bool is_last = next == std::string::npos;
  text.replace(begin, (is_last ? text.size() : next) - begin, outcome);
  write_text(file_case.file, text);
}

class FormatFiles : public testing::TestWithParam<FileCase> {};

TEST_P(FormatFiles, AreFormattedAsTheySay) {
  const auto [before, after] = texts_of(GetParam());
  const std::string outcome = formatted(with_bytes(before));
  if (std::getenv("SDLC_UPDATE") != nullptr) return update(GetParam(), outcome);
  EXPECT_EQ(outcome, after) << "SDLC_UPDATE=1 rewrites it.";
  EXPECT_EQ(formatted(outcome), outcome) << "formatted for the second time";
}
INSTANTIATE_TEST_SUITE_P(Cases, FormatFiles, testing::ValuesIn(load_cases("format")), CaseName());

}  // namespace
}  // namespace sdlc::test
