#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"

/// Scripts of tests in Node. Their packages are in the folder `node_modules` that the variable
/// SDLC_NODE_MODULES names; tests are skipped without them.
namespace sdlc::test {

/// Empty if the package is there, else why a test is skipped.
inline std::string missing_node_package(const std::string& package) {
  const char* const folder = std::getenv("SDLC_NODE_MODULES");
  if (folder == nullptr) return "SDLC_NODE_MODULES names no folder with the npm packages of tests";
  if (std::system("command -v node >/dev/null") != 0) return "node is not installed";
  const bool is_there = std::filesystem::exists(std::filesystem::path(folder) / package);
  return is_there ? "" : package + " is not in SDLC_NODE_MODULES";
}

/// Runs a script of tests/editors with the arguments, and returns its output. Fails the test if the
/// script does.
inline std::string run_node(const std::string& script, const std::vector<std::string>& arguments) {
  const TemporaryFolder logs;
  std::string line = "node '" SDLC_SOURCE_DIR "/tests/editors/" + script + "'";
  for (const std::string& argument : arguments) line += " '" + argument + "'";
  line += " >'" + (logs / "out").string() + "' 2>'" + (logs / "err").string() + "' </dev/null";
  EXPECT_EQ(std::system(line.c_str()), 0) << content_of(logs / "err");
  return content_of(logs / "out");
}

}  // namespace sdlc::test

/// Skips a test whose npm package is missing.
#define SDLC_NEED_NODE_PACKAGE(package)                                                          \
  if (const std::string missing = sdlc::test::missing_node_package(package); !missing.empty()) { \
    GTEST_SKIP() << missing;                                                                     \
  }                                                                                              \
  static_assert(true)
