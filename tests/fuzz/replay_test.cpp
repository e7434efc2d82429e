#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include <gtest/gtest.h>

#include "lang/source/limits.hpp"
#include "lang/source/source.hpp"
#include "tests/fuzz/input.hpp"

// Compiles the seeds and all findings of the fuzzers in an ordinary test. Put a new finding into
// tests/fuzz/findings, under a name that describes the bug.
namespace sdlc::test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> inputs() {
  std::vector<fs::path> paths;
  for (const char* folder :
       {"examples", "examples/library", "tests/fuzz/seeds", "tests/fuzz/findings"}) {
    for (const auto& entry : fs::directory_iterator(fs::path(SDLC_SOURCE_DIR) / folder)) {
      const fs::path extension = entry.path().extension();
      if (extension == ".scene" || extension == ".json") paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

class FuzzInput : public testing::TestWithParam<fs::path> {};

TEST_P(FuzzInput, IsCompiledSoundly) {
  std::error_code error;
  const auto text = lang::DiskFileSystem().read(GetParam(), lang::Limits().any_file(), error);
  ASSERT_TRUE(text) << error.message();
  run_fuzz_input(*text, lang::source_format_of(GetParam(), *text));
}

/// The file's name, restricted to characters allowed in test names.
struct InputName {
  std::string operator()(const testing::TestParamInfo<fs::path>& input) const {
    std::string name = input.param.filename().string();
    const auto is_foreign = [](unsigned char c) { return std::isalnum(c) == 0; };
    std::replace_if(name.begin(), name.end(), is_foreign, '_');
    return name;
  }
};
INSTANTIATE_TEST_SUITE_P(Examples, FuzzInput, testing::ValuesIn(inputs()), InputName());

}  // namespace
}  // namespace sdlc::test
