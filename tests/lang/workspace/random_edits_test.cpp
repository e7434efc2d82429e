#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "lang/workspace/workspace.hpp"
#include "tests/lang/workspace/checked_program.hpp"
#include "tests/support/compilation/compilation.hpp"

// Random edits of open documents that import each other: after each, the workspace that has seen
// all edits gives the same diagnostics and symbols as a new one. The seeds are fixed.
namespace sdlc::test {
namespace {

using Texts = std::map<std::string, std::string>;

constexpr int kShards = 20, kEditsPerShard = 500;
constexpr std::size_t kMaxText = 1500;
constexpr lang::Limits kLimits{.steps = 5'000, .objects = 200};

const Texts kOriginals{
    {"root.scene", R"(scene 1
import "lib.scene" as lib
param count = 3
let size = lib.unit * 0.5
def tower(height, wide = size) {
  for level in range(height) { sphere { center: (0, level, 0), radius: wide } }
}
camera main { from: (0, 2, 9), at: (0, 0, 0), fov: 40deg }
background { color: white }
group { material: lib.paint, translate: (1, 0, 0)
  tower first { height: count }
}
include "part.scene"
// sdlc: allow(W402) a test
let unused = lib.twice(2)
sphere ball { center: (0, 0, 0), radius: size, material: lib.paint }
)"},
    {"lib.scene", R"(scene 1
import "base.scene" as base
/// The length of everything.
let unit = base.meter * 2
fn twice(x) = x + x
let paint = diffuse(color: rgb(200, 100, 50))
def pair(gap) { sphere { radius: unit }, sphere { center: (gap, 0, 0), radius: unit } }
)"},
    {"base.scene", R"(scene 1
let meter = 1
let spare = [1, 2, 3]
)"},
    {"part.scene", R"(scene 1
import "base.scene" as base
for i in range(3) {
  let x = i * base.meter
  if x > 1 { sphere { center: (x, 1, 0), radius: 0.2, material: unlit(red) } }
}
include "spheres.json"
)"},
    {"spheres.json", R"({"spheres": [
  {"origin": [5, 0, 0], "radius": 1, "material": {"type": "diffuse", "color": [255, 0, 0]}},
  {"origin": [9, 0, 0], "radius": 2, "material": {"type": "specular", "color": [9, 9, 9], "fuzz": 1}}
]})"},
};

constexpr auto kTokens =
    std::to_array<std::string_view>({"{",
                                     "}",
                                     "(",
                                     ")",
                                     "[",
                                     "]",
                                     ",",
                                     ":",
                                     "=",
                                     "\"",
                                     "//",
                                     "/*",
                                     "*/",
                                     "+",
                                     " - ",
                                     "..",
                                     "1",
                                     "0.5",
                                     "2deg",
                                     " lib.unit ",
                                     "size",
                                     "sphere {",
                                     "let q = 1\n",
                                     "import \"base.scene\" as b2\n",
                                     "include \"part.scene\"\n",
                                     "for i in range(2) {",
                                     "if 1 < 2 {",
                                     "def ",
                                     "fn ",
                                     "radius: ",
                                     "material: ",
                                     "time",
                                     "unkown",
                                     "lib.",
                                     "é",
                                     "\n",
                                     ";",
                                     "#80b3ff",
                                     "import \"root.scene\" as me\n",
                                     "camera { from: (0, 0, 1), at: (0, 0, 0), fov: 1rad }\n"});

class Editing {
 public:
  explicit Editing(std::uint32_t seed) : random_(seed), disk_(kOriginals) {}

  void run() {
    for (int i = 0; i < kEditsPerShard && !testing::Test::HasFailure(); ++i) {
      edit();
      const std::string& root = random_name();
      compare(root);
      if (root != "root.scene" && below(4) == 0) compare("root.scene");
      if (i % 10 == 9) compare_dependents();
    }
  }

 private:
  std::uint32_t below(std::size_t count) {
    return static_cast<std::uint32_t>(random_() % static_cast<std::uint32_t>(count));
  }
  const std::string& random_name() {
    return std::next(kOriginals.begin(), below(kOriginals.size()))->first;
  }
  const std::string& text_of(const std::string& name) {
    const auto open = open_.find(name);
    return open == open_.end() ? kOriginals.at(name) : open->second;
  }

  void edit() {
    const std::string& name = random_name();
    const std::uint32_t choice = below(20);
    if (choice == 0) {
      open_.erase(name);
      workspace_.close(name);
      return;
    }
    std::string text = text_of(name);
    if (choice < 4 || text.size() > kMaxText) {
      text = kOriginals.at(name);
    } else {
      change(text, choice);
    }
    open_[name] = text;
    workspace_.open(name, text, ++version_);
  }

  void change(std::string& text, std::uint32_t choice) {
    const std::size_t at = below(text.size() + 1);
    const std::size_t line = text.rfind('\n', at == 0 ? 0 : at - 1) + 1;  // npos + 1 is 0
    const std::size_t line_end = std::min(text.find('\n', line), text.size() - 1) + 1;
    switch (choice % 6) {
      case 0: text.insert(at, kTokens[below(kTokens.size())]); break;
      case 1: text.erase(at, 1); break;
      case 2: text.erase(at, below(12)); break;
      case 3: text.replace(at, below(4), kTokens[below(kTokens.size())]); break;
      case 4: text.insert(line, text.substr(line, line_end - line)); break;
      default: text.erase(line, line_end - line); break;
    }
  }

  void compare(const std::string& root) {
    lang::Workspace fresh(disk_);
    for (const auto& [name, text] : open_) fresh.open(name, text, version_);
    const CheckedProgram expected = check_program(fresh, root, kLimits);
    const CheckedProgram checked = check_program(workspace_, root, kLimits);
    EXPECT_EQ(checked.diagnostics, expected.diagnostics) << root << ":\n" << text_of(root);
    EXPECT_EQ(checked.symbols, expected.symbols) << root << ":\n" << text_of(root);
  }

  /// Dependents are known exactly as soon as all files have been checked.
  void compare_dependents() {
    lang::Workspace fresh(disk_);
    for (const auto& [name, text] : open_) fresh.open(name, text, version_);
    for (const auto& [name, text] : kOriginals) {
      check_program(fresh, name, kLimits);
      check_program(workspace_, name, kLimits);
    }
    for (const auto& [name, text] : kOriginals) {
      EXPECT_EQ(workspace_.dependents(name), fresh.dependents(name)) << name;
      EXPECT_EQ(workspace_.roots(name), fresh.roots(name)) << name;
    }
  }

  std::minstd_rand random_;
  MemoryFiles disk_;
  lang::Workspace workspace_{disk_};
  Texts open_;
  int version_ = 0;
};

class RandomEdits : public testing::TestWithParam<int> {};

TEST_P(RandomEdits, GiveWhatANewWorkspaceGives) {
  Editing(static_cast<std::uint32_t>(GetParam()) + 1).run();
}

INSTANTIATE_TEST_SUITE_P(Shards, RandomEdits, testing::Range(0, kShards));

}  // namespace
}  // namespace sdlc::test
