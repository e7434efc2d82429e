#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/editors/tree_sitter/scene_tree.hpp"
#include "tests/support/temporary_folder.hpp"

// The cases of editors/tree-sitter-sdlc/test/corpus, which `tree-sitter test` runs too.
namespace sdlc::test {
namespace {

struct CorpusCase {
  std::string name, text, tree;
};

/// Without line ends, indentation and the names of fields.
std::string normalized(std::string tree) {
  tree = std::regex_replace(tree, std::regex("\\s+"), " ");
  tree = std::regex_replace(tree, std::regex(" \\)"), ")");
  return std::regex_replace(tree, std::regex("[a-z]+: |^ | $"), "");
}

std::vector<CorpusCase> cases_in(const std::string& file) {
  static const std::regex kTitle("(^|\n)=+\n(.*)\n=+\n");
  static const std::regex kLine("\n-+\n");
  const std::string content = content_of(file);
  std::vector<CorpusCase> cases;
  for (std::sregex_iterator i(content.begin(), content.end(), kTitle), end; i != end; ++i) {
    const auto next = std::next(i);
    const std::string body((*i)[0].second, next == end ? content.end() : (*next)[0].first);
    std::smatch line;
    if (!std::regex_search(body, line, kLine)) continue;
    cases.push_back({(*i)[2], line.prefix(), normalized(line.suffix())});
  }
  return cases;
}

TEST(TreeSitterCorpus, HasTheExpectedTrees) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(
           SDLC_SOURCE_DIR "/editors/tree-sitter-sdlc/test/corpus")) {
    for (const CorpusCase& corpus_case : cases_in(entry.path())) {
      EXPECT_EQ(normalized(SceneTree(corpus_case.text).shape()), corpus_case.tree)
          << entry.path() << ": " << corpus_case.name;
      ++count;
    }
  }
  EXPECT_GE(count, 20u);
}

}  // namespace
}  // namespace sdlc::test
