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
    const bool is_film = content_of(entry.path()).find("\nanimation {") != std::string::npos;
    const ProgramResult result =
        run_shell(folder.path(), "\"$SDLC\" render '" + entry.path().string() +
                                     "' -o picture.####.png --width 64 --samples 4 --quiet" +
                                     (is_film ? " --frames 1-2" : ""));
    EXPECT_EQ(result.exit_code, 0) << entry.path();
    EXPECT_EQ(result.err, "") << entry.path();
    const fs::path picture = folder / (is_film ? "picture.0002.png" : "picture.####.png");
    EXPECT_EQ(render::read_picture(picture).width, 64) << entry.path();
    fs::remove(picture);
    ++count;
  }
  EXPECT_GT(count, 0);
}

}  // namespace
}  // namespace sdlc::test
