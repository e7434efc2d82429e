#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "tests/editors/tree_sitter/example_captures.hpp"
#include "tests/editors/tree_sitter/scene_tree.hpp"
#include "tests/support/temporary_folder.hpp"

// Neovim loads the parser and the queries.
namespace sdlc::test {
namespace {

class NeovimQueries : public testing::TestWithParam<const char*> {};

TEST_P(NeovimQueries, CaptureWhatTheyCaptureInTheLibrary) {
  if (std::system("command -v nvim >/dev/null") != 0) GTEST_SKIP() << "nvim is not installed";
  const TemporaryFolder folder;
  std::string files;
  for (const std::string& file : example_files()) files += (files.empty() ? "" : ":") + file;
  const std::string root = SDLC_SOURCE_DIR;
  const std::string command = "cd '" + folder.path().string() + "' && HOME=. OUT=out FILES='" +
                              files + "' PARSER='" SDLC_TREE_SITTER_MODULE "' QUERY='" + root +
                              "/editors/tree-sitter-sdlc/queries/" + GetParam() +
                              "' nvim --headless --clean -c 'luafile " + root +
                              "/tests/editors/tree_sitter/captures.lua' >err 2>&1 </dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0) << content_of(folder / "err");
  EXPECT_EQ(content_of(folder / "out"), captures_in_examples(Query(GetParam())));
}

INSTANTIATE_TEST_SUITE_P(TreeSitter, NeovimQueries,
                         testing::Values("highlights.scm", "folds.scm", "indents.scm",
                                         "injections.scm", "locals.scm"));

}  // namespace
}  // namespace sdlc::test
