#include <filesystem>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "lang/diagnostics/diagnostics.hpp"
#include "tests/support/file_test.hpp"

namespace sdlc::test {
namespace {

namespace fs = std::filesystem;

/// The codes that some file test expects.
std::set<std::string> expected_codes() {
  std::set<std::string> codes;
  for (const auto& entry : fs::directory_iterator(fs::path(SDLC_SOURCE_DIR) / "tests/files")) {
    if (!entry.is_directory()) continue;
    for (const FileCase& file_case : load_cases(entry.path().filename().string())) {
      for (const Remark& remark : file_case.expected) codes.insert(remark.kind);
    }
  }
  return codes;
}

TEST(Diagnostics, EveryCodeHasAFileTest) {
  const std::set<std::string> codes = expected_codes();
  for (const lang::DiagnosticInfo* info : lang::all_diagnostics()) {
    EXPECT_TRUE(codes.contains(std::string(info->code)))
        << "no case in tests/files expects " << info->code << ", " << info->name;
  }
}

}  // namespace
}  // namespace sdlc::test
