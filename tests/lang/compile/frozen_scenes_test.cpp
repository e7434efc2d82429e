#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lang/compile/compile.hpp"
#include "lang/source/limits.hpp"
#include "lang/source/source.hpp"
#include "render/scene/digest.hpp"

// What `scene 1` and the JSON format mean is fixed. tests/files/frozen has files of both, and
// DIGESTS what they lower to. Neither is ever changed; files may be added.
namespace sdlc::lang {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(SDLC_SOURCE_DIR) / "tests/files/frozen";

/// One line: the spheres and their digest, what surrounds them, and the settings.
std::string describe(const LoweredScene& lowered) {
  const render::RenderSettings& settings = lowered.settings;
  return fmt::format("{} {:016x} {}x{} samples {} depth {} seed {} tone {} output \"{}\"",
                     lowered.scene.spheres.size(), render::digest_of(lowered.scene), settings.width,
                     settings.height, settings.samples, settings.depth, settings.seed,
                     static_cast<int>(lowered.output.mapping.tone), lowered.output.output);
}

/// What every frame of the file lowers to, by "file" or "file frame".
void add_digests(const fs::path& path, std::map<std::string, std::string>& digests) {
  const DiskFileSystem files;
  Workspace workspace(files);
  std::error_code error;
  const Document file(path.string(), *files.read(path, Limits().any_file(), error));
  DiagnosticSink sink;
  Compiler compiler(file, {.workspace = &workspace, .limits = {}, .sets = {}}, sink);
  const std::string name = path.filename().string();
  const std::optional<Animation> film = compiler.animation();
  const int first = film ? film->first : 0, last = film ? film->last : 0;
  const int step = std::max(1, (last - first) / 2);  // the ends, and a frame in between
  for (int frame = first; frame <= last; frame += step) {
    const auto lowered = compiler.lower({.instancing = Instancing::Never},
                                        film ? std::optional(frame) : std::nullopt);
    ASSERT_TRUE(lowered) << name << ": " << sink.diagnostics().front().message;
    digests[film ? fmt::format("{} {}", name, frame) : name] = describe(*lowered);
  }
}

std::map<std::string, std::string> read_digests() {
  std::map<std::string, std::string> digests;
  std::ifstream stream(kFolder / "DIGESTS");
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(": ");
    digests[line.substr(0, colon)] = line.substr(colon + 2);
  }
  return digests;
}

TEST(FrozenScenes, LowerToTheSameForever) {
  std::map<std::string, std::string> now;
  for (const auto& entry : fs::directory_iterator(kFolder)) {
    const fs::path& path = entry.path();
    const bool is_part = path.stem() == "parts" || path.stem() == "shelf";
    if (path.has_extension() && !is_part) add_digests(path, now);
  }
  std::map<std::string, std::string> known = read_digests();
  if (std::getenv("SDLC_UPDATE") != nullptr) {
    known.insert(now.begin(), now.end());  // adds, never changes
    std::ofstream stream(kFolder / "DIGESTS");
    for (const auto& [name, digest] : known) stream << name << ": " << digest << '\n';
  }
  EXPECT_GE(known.size(), 20u);
  EXPECT_EQ(now, known);
}

}  // namespace
}  // namespace sdlc::lang
