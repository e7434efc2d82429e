#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/editors/node.hpp"
#include "tests/editors/tree_sitter/scene_tree.hpp"

// The checked-in parser for WebAssembly is the one that the other tests compile.
namespace sdlc::test {
namespace {

std::vector<std::string> examples() {
  std::vector<std::string> files;
  for (const char* folder : {"examples", "examples/library", "tests/files/frozen"}) {
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(SDLC_SOURCE_DIR) / folder)) {
      if (entry.path().extension() == ".scene") files.push_back(entry.path().string());
    }
  }
  return files;
}

/// As captures.mjs prints them.
std::string captures_of(const std::string& file, const Query& query) {
  const std::string text = content_of(file);
  const SceneTree tree(text);
  std::string lines = file + "\n";
  for (const Capture& capture : query.captures(tree)) {
    lines += fmt::format("{} {} {}\n", capture.span.begin, capture.span.end, capture.name);
  }
  return lines;
}

class WasmQueries : public testing::TestWithParam<const char*> {};

TEST_P(WasmQueries, CaptureWhatTheyCaptureNatively) {
  SDLC_NEED_NODE_PACKAGE("web-tree-sitter");
  std::vector<std::string> arguments = examples();
  const Query query(GetParam());
  std::string expected;
  for (const std::string& file : arguments) expected += captures_of(file, query);
  arguments.insert(arguments.begin(), GetParam());
  EXPECT_EQ(run_node("tree_sitter/captures.mjs", arguments), expected);
}

INSTANTIATE_TEST_SUITE_P(TreeSitter, WasmQueries,
                         testing::Values("highlights.scm", "helix/highlights.scm", "folds.scm",
                                         "indents.scm", "injections.scm", "locals.scm",
                                         "tags.scm"));

}  // namespace
}  // namespace sdlc::test
