#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lang/compile/compile.hpp"
#include "lang/source/limits.hpp"
#include "lang/source/source.hpp"
#include "render/scene/digest.hpp"

// The same file lowers to the same scene, bit for bit, with every compiler, its flags and every
// machine: these digests hold everywhere.
namespace sdlc::lang {
namespace {

namespace fs = std::filesystem;

/// One line per example: its name, its spheres and its digest.
std::string digests_of_examples() {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(fs::path(SDLC_SOURCE_DIR) / "examples")) {
    if (entry.path().extension() == ".scene") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::string lines;
  const DiskFileSystem files;
  Workspace workspace(files);
  for (const fs::path& path : paths) {
    std::error_code error;
    const Document file(path.string(), *files.read(path, Limits().any_file(), error));
    DiagnosticSink sink;
    Compiler compiler(file, {.workspace = &workspace, .limits = {}, .sets = {}}, sink);
    const auto lowered = compiler.lower({});
    EXPECT_TRUE(lowered) << path;
    if (!lowered) continue;
    lines += fmt::format("{} {} {:016x}\n", path.filename().string(), lowered->scene.spheres.size(),
                         render::digest_of(lowered->scene));
  }
  return lines;
}

TEST(LoweredBits, OfTheExamplesAreTheSameEverywhere) {
  const fs::path known = fs::path(SDLC_SOURCE_DIR) / "tests/files/lowered_bits.txt";
  const std::string digests = digests_of_examples();
  if (std::getenv("SDLC_UPDATE") != nullptr) std::ofstream(known) << digests;
  std::ostringstream expected;
  expected << std::ifstream(known).rdbuf();
  EXPECT_EQ(digests, expected.str()) << "where an example was changed, run with SDLC_UPDATE=1";
}

}  // namespace
}  // namespace sdlc::lang
