#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {

/// Runs the real program in a folder of its own.
class ProgramTest : public testing::Test {
 protected:
  /// Makes the folders of the file, too.
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    write_text(folder_ / name, text);
  }
  std::string content(const std::string& name) const { return content_of(folder_ / name); }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
  void expect_same(const std::string& a, const std::string& b) const {
    EXPECT_TRUE(exists(a) && exists(b)) << a << ", " << b;
    EXPECT_TRUE(content(a) == content(b)) << a << ", " << b;
  }

  /// A shell command with the program as "$SDLC".
  ProgramResult shell(const std::string& command) const {
    return run_shell(folder_.path(), command);
  }
  ProgramResult sdlc(const std::string& arguments) const { return shell("\"$SDLC\" " + arguments); }
  void succeed(const std::string& arguments) const {
    const ProgramResult result = sdlc(arguments);
    EXPECT_EQ(result.exit_code, 0) << arguments << "\n" << result.err;
  }
  /// The messages of a command that fails with this status.
  std::string failure(int status, const std::string& arguments) const {
    const ProgramResult result = sdlc(arguments);
    EXPECT_EQ(result.exit_code, status) << arguments << "\n" << result.err;
    return result.err;
  }

  TemporaryFolder folder_;
};

}  // namespace sdlc::test
