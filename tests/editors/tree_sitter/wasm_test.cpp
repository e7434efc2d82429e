#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/editors/node.hpp"
#include "tests/editors/tree_sitter/example_captures.hpp"
#include "tests/editors/tree_sitter/scene_tree.hpp"

// The checked-in parser for WebAssembly is the one that the other tests compile.
namespace sdlc::test {
namespace {

class WasmQueries : public testing::TestWithParam<const char*> {};

TEST_P(WasmQueries, CaptureWhatTheyCaptureNatively) {
  SDLC_NEED_NODE_PACKAGE("web-tree-sitter");
  std::vector<std::string> arguments = example_files();
  arguments.insert(arguments.begin(), GetParam());
  EXPECT_EQ(run_node("tree_sitter/captures.mjs", arguments),
            captures_in_examples(Query(GetParam())));
}

INSTANTIATE_TEST_SUITE_P(TreeSitter, WasmQueries,
                         testing::Values("highlights.scm", "helix/highlights.scm", "folds.scm",
                                         "indents.scm", "injections.scm", "locals.scm",
                                         "tags.scm"));

}  // namespace
}  // namespace sdlc::test
