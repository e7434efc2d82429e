#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lang/compile/compile.hpp"
#include "lang/source/source.hpp"
#include "render/scene/scene.hpp"

// The same file lowers to the same scene, bit for bit, whatever the compiler, its flags and the
// machine: these digests hold for all of them.
namespace sdlc::lang {
namespace {

namespace fs = std::filesystem;

/// FNV-1a, 64 bits, over the bits of numbers.
class Digest {
 public:
  void add(std::uint64_t word) {
    for (int i = 0; i < 8; ++i) {
      hash_ = (hash_ ^ (word >> 8 * i & 0xFF)) * 0x100000001B3u;
    }
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(render::Vec3 v) { add(v.x), add(v.y), add(v.z); }
  void add(render::LinearRgb c) { add(c.r), add(c.g), add(c.b); }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xCBF29CE484222325u;
};

std::uint64_t digest_of(const render::Scene& scene) {
  Digest digest;
  for (const render::Sphere& sphere : scene.spheres) {
    digest.add(sphere.center);
    digest.add(sphere.radius);
    digest.add(std::uint64_t{sphere.material});
  }
  for (const render::Material& material : scene.materials) {
    digest.add(material.color);
    digest.add(material.parameter);
    digest.add(static_cast<std::uint64_t>(material.type) * 2 +
               static_cast<std::uint64_t>(material.fresnel));
  }
  for (const render::Vec3 shift : scene.shifts) digest.add(shift);
  digest.add(scene.camera.from);
  digest.add(scene.camera.at);
  digest.add(scene.camera.up);
  digest.add(scene.camera.plane_height);
  digest.add(scene.camera.aspect);
  digest.add(scene.background.bottom);
  digest.add(scene.background.top);
  return digest.value();
}

/// A line for each example: its name, its spheres and its digest.
std::string digests_of_examples() {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(fs::path(SDLC_SOURCE_DIR) / "examples")) {
    if (entry.path().extension() == ".scene") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::string lines;
  const DiskFileSystem files;
  for (const fs::path& path : paths) {
    std::error_code error;
    const SourceFile file(path.string(), *files.read(path, error));
    DiagnosticSink sink;
    Compiler compiler(file, {.files = &files, .limits = {}, .sets = {}}, sink);
    const auto lowered = compiler.lower({});
    EXPECT_TRUE(lowered) << path;
    if (!lowered) continue;
    lines += fmt::format("{} {} {:016x}\n", path.filename().string(), lowered->scene.spheres.size(),
                         digest_of(lowered->scene));
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
