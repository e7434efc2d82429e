#include "render/image/codec_loader.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/image/image.hpp"
#include "render/image/io_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::render {
namespace {

using test::TemporaryFolder;
using test::write_text;

using testing::HasSubstr;

// The codec is loaded once per process: each of these runs its body in a separate process, which
// ends with the message of the error on its standard error.
void load_from(const std::string& folder, void (*load)()) {
  ::setenv("SDLC_MODULE_PATH", folder.c_str(), 1);
  try {
    load();
    std::fputs("loaded", stderr);
  } catch (const IoError& error) {
    std::fputs(error.what(), stderr);
  }
  std::exit(0);
}

class CodecLoader : public testing::Test {
 protected:
  CodecLoader() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(CodecLoader, SaysWhereItLookedForAMissingModule) {
  EXPECT_EXIT(load_from("/nowhere", [] { image_codec(CodecModule::Standard); }),
              testing::ExitedWithCode(0),
              "cannot load `/nowhere/sdlc_image_codec.so`: .*is missing.*SDLC_MODULE_PATH");
}

TEST_F(CodecLoader, ReportsAMissingModuleBeforeTheFirstPicture) {
  EXPECT_EXIT(load_from("/nowhere", [] { preload_image_codec(ImageFormat::Png); }),
              testing::ExitedWithCode(0), "cannot load `/nowhere/sdlc_image_codec.so`");
}

TEST_F(CodecLoader, SaysWhatTheModuleIsForThatIsMissing) {
  EXPECT_EXIT(load_from("/nowhere", [] { image_codec(ImageFormat::Jpeg); }),
              testing::ExitedWithCode(0),
              "cannot load `/nowhere/sdlc_openimageio.so`: .*the other formats.*is missing");
}

TEST_F(CodecLoader, ReportsAFileThatIsNotAModule) {
  const TemporaryFolder folder;
  write_text(folder / "sdlc_image_codec.so", "not a library");
  EXPECT_EXIT(load_from(folder.path().string(), [] { image_codec(CodecModule::Standard); }),
              testing::ExitedWithCode(0),
              "cannot load `.*sdlc_image_codec.so`: .*(invalid ELF header|file too short)");
}

TEST_F(CodecLoader, FindsTheModuleBesideTheProgramWhenNoVariableIsSet) {
  EXPECT_EXIT(load_from("", [] { image_codec(CodecModule::Standard); }), testing::ExitedWithCode(0),
              "loaded");
}

bool is_loaded(const char* library) {
  std::ifstream maps("/proc/self/maps");
  const std::string all{std::istreambuf_iterator<char>(maps), {}};
  return all.find(library) != std::string::npos;
}

/// Ends the process with 1 if the module was loaded at its end.
void tell_at_exit_whether_loaded() {
  // Runs after the loader is destroyed, which is created later.
  std::atexit([] { std::_Exit(is_loaded("sdlc_image_codec.so") ? 1 : 0); });
}

TEST_F(CodecLoader, DoesNotLoadAtTheEndWhatWasNeverNeeded) {
  EXPECT_EXIT(
      {
        tell_at_exit_whether_loaded();
        preload_image_codec(ImageFormat::Png);
        std::exit(2);
      },
      testing::ExitedWithCode(0), "");
}

TEST_F(CodecLoader, LoadsNowWhatIsNeededSoon) {
  EXPECT_EXIT(
      {
        tell_at_exit_whether_loaded();
        preload_image_codec(ImageFormat::Png, Preload::Now);
        std::exit(2);
      },
      testing::ExitedWithCode(1), "");
}

TEST_F(CodecLoader, NeedsNoOpenImageIoForPngExrAndPpm) {
  EXPECT_EXIT(
      {
        for (const ImageFormat format : {ImageFormat::Png, ImageFormat::Exr, ImageFormat::Ppm}) {
          encode_picture(Picture(1, 1), {.format = format});
        }
        std::_Exit(is_loaded("libOpenImageIO") ? 1 : 0);
      },
      testing::ExitedWithCode(0), "");
}

TEST_F(CodecLoader, SaysWhichFileNeedsTheMissingModule) {
  const TemporaryFolder folder;
  std::filesystem::copy(SDLC_MODULES "/sdlc_image_codec.so", folder.path());
  write_text(folder / "a.ppm", "P1 1 1\n1\n");
  ::setenv("FOLDER", folder.path().c_str(), 1);
  EXPECT_EXIT(load_from(folder.path().string(),
                        [] { read_picture(std::string(std::getenv("FOLDER")) + "/a.ppm"); }),
              testing::ExitedWithCode(0),
              "cannot read `.*a.ppm`: only OpenImageIO reads PPM files of this kind: cannot load "
              "`.*sdlc_openimageio.so`");
}

TEST_F(CodecLoader, MayStillBeLoadingWhenTheProcessEnds) {
  EXPECT_EXIT(load_from("", [] { preload_image_codec(ImageFormat::Png, Preload::Now); }),
              testing::ExitedWithCode(0), "loaded");
}

TEST_F(CodecLoader, HandsOutOneCodecWhetherPreloadedOrNot) {
  preload_image_codec(ImageFormat::Png);
  ImageCodec* const first = &image_codec(CodecModule::Standard);
  preload_image_codec(ImageFormat::Png);
  EXPECT_EQ(&image_codec(ImageFormat::Exr), first);
}

}  // namespace
}  // namespace sdlc::render
