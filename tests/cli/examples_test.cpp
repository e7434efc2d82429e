#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "render/image/image.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

namespace fs = std::filesystem;

TEST(Examples, RenderWithoutAWord) {
  const TemporaryFolder folder;
  int count = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(SDLC_SOURCE_DIR) / "examples")) {
    if (entry.path().extension() != ".scene") continue;
    const ProgramResult result =
        run_shell(folder.path(), "\"$SDLC\" render '" + entry.path().string() +
                                     "' -o picture.png --width 64 --samples 4 --quiet");
    EXPECT_EQ(result.exit_code, 0) << entry.path();
    EXPECT_EQ(result.err, "") << entry.path();
    EXPECT_EQ(render::read_picture(folder / "picture.png").width, 64) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 0);
}

/// The first fenced block of a Markdown file that begins with the language's version.
std::string first_scene_of(const fs::path& path) {
  const std::string text = content_of(path);
  const std::size_t begin = text.find("```\nscene 1") + 4;
  return text.substr(begin, text.find("```", begin) - begin);
}

TEST(Readme, ShowsASceneThatRenders) {
  for (const char* page : {"README.md", "docs/language.md"}) {
    const TemporaryFolder folder;
    write_text(folder / "page.scene", first_scene_of(fs::path(SDLC_SOURCE_DIR) / page));
    const ProgramResult result = run_shell(
        folder.path(), "\"$SDLC\" render page.scene -o p.png --width 64 --samples 4 --quiet");
    EXPECT_EQ(result.exit_code, 0) << page << "\n" << result.err;
    EXPECT_EQ(result.err, "") << page;
  }
}

TEST(Readme, ShowsTheMessageThatAMistakeGets) {
  const TemporaryFolder folder;
  std::string scene = first_scene_of(fs::path(SDLC_SOURCE_DIR) / "README.md");
  scene.replace(scene.find("radius: 0.5"), std::string("radius").size(), "radus");
  write_text(folder / "ball.scene", scene);
  const ProgramResult result =
      run_shell(folder.path(), "\"$SDLC\" render ball.scene --color never");
  EXPECT_EQ(result.exit_code, 1);
  const std::string readme = content_of(fs::path(SDLC_SOURCE_DIR) / "README.md");
  const std::size_t begin = readme.find("error[E104]");
  const std::string shown = readme.substr(begin, readme.find("```", begin) - begin);
  EXPECT_NE(result.err.find(shown), std::string::npos) << result.err;
}

}  // namespace
}  // namespace sdlc::test
