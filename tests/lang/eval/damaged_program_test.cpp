#include <cctype>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/compilation/compilation.hpp"

// Compilation of a damaged program always ends, and its diagnostics are inside its texts.
namespace sdlc::test {
namespace {

constexpr const char* kProgram = R"(scene 1
import "lib.scene" as lib
param count = 3
param tint: color = lib.tint
let path = [(0, 0, 0), (count, 0, 0), lib.at(count)]
fn wave(i, height: number = 0.5) = height * sin(i / count * 1turn) + (if i < 2 then time / 1s else 0)
def ring(n: number, radius = 1, material = lib.glass) {
  let step = 1turn / n
  for i in range(n) {
    let p = radius * (cos(i * step), wave(i), sin(i * step))
    sphere { center: p, radius: 0.1 * (i + 1), material: material }
  }
  if n > 2 { ring { n: n - 1, radius: radius / 2, translate: (0, 1, 0) } } else if n == 2 { } else { group { } }
}
camera main { from: (0, 0, 5 + time / 1s), at: path[0], fov: 40deg, shutter: 0s .. 20ms }
background { bottom: tint, top: mix(white, #80b3ff, 50%) }
animation { frames: 1 .. 10, fps: 5 }
group moving { translate: (0, time / 1s, 0), rotate: (0deg, 30deg, 0deg) ring { n: count } include "part.scene" }
lib.pair second { gap: len(path), scale: 2, material: emissive(color: kelvin(3000), intensity: 8) }
sphere ball { center: (9, 0, 0), radius: 1, material: unlit(red), motion: line(to: (9, 1, 0), over: 0s .. 1s) }
for p in path { assert length(p) < 100, "far: " + str(length(p)) }
render { width: 16, samples: 1, output: "a.####.png", camera: main, tone: sqrt }
)";

const std::map<std::string, std::string> kFiles{
    {"lib.scene",
     "let glass = transmissive(ior: 1.5) let tint = hsl(30deg, 50%, 50%)\n"
     "fn at(x) = (x, mod(x, 2), -x)\n"
     "def pair(gap) { for s in [-1, 1] { sphere { center: (s * gap, 0, 0), radius: 1 } } }"},
    {"part.scene",
     "import \"lib.scene\" as lib\nsphere { center: lib.at(7), radius: 1, material: "
     "lib.glass }"},
};

/// Few steps: damage may enlarge a scene.
Sources damaged(const std::string& text) {
  return {.root = text,
          .files = kFiles,
          .limits = {.steps = 20'000, .objects = 1000, .string = 1000, .include_depth = 4}};
}

bool is_sound(const std::string& text) {
  Compilation compilation(damaged(text));
  const auto lowered = compilation.lower({}, 2);
  bool has_error = false;
  for (const Told& told : compilation.told()) has_error = has_error || told.code[0] == 'E';
  return lowered.has_value() != has_error;
}

/// SplitMix64: the same damage in every run.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::size_t below(std::size_t bound) {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return static_cast<std::size_t>((z ^ (z >> 31)) % bound);
  }

 private:
  std::uint64_t state_;
};

/// The program's words, numbers and signs.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  const auto is_letter = [](char c) { return c == '_' || c == '.' || std::isalnum(c) != 0; };
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i + 1;
    while (is_letter(text[i]) && end < text.size() && is_letter(text[end])) ++end;
    words.push_back(text.substr(i, end - i));
    i = end;
  }
  return words;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += word;
  return text;
}

TEST(DamagedProgram, IsSoundBeforeTheDamage) {
  Compilation compilation(damaged(kProgram));
  EXPECT_TRUE(compilation.lower({}, 2));
  for (const Told& told : compilation.told()) EXPECT_EQ(told.code, "W404") << told.message;
}

TEST(DamagedProgram, MayLackAnyWord) {
  const auto words = words_of(kProgram);
  for (std::size_t i = 2; i < words.size(); ++i) {
    auto rest = words;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_TRUE(is_sound(joined(rest))) << "without word " << i << ", " << words[i];
  }
}

TEST(DamagedProgram, MayEndAnywhere) {
  const auto words = words_of(kProgram);
  std::string text;
  for (const std::string& word : words) {
    text += word;
    if (text.size() <= 8) continue;
    EXPECT_TRUE(is_sound(text)) << text;
  }
}

TEST(DamagedProgram, MayHaveItsWordsExchanged) {
  const auto sound = words_of(kProgram);
  Random random(11);
  for (int i = 0; i < 3000; ++i) {
    auto words = sound;
    const std::size_t damages = 1 + random.below(4);
    for (std::size_t k = 0; k < damages; ++k) {
      const std::size_t at = 2 + random.below(words.size() - 2);
      const std::string other = words[2 + random.below(words.size() - 2)];
      if (random.below(2) == 0) {
        words[at] = other;
      } else {
        words.insert(words.begin() + static_cast<std::ptrdiff_t>(at), other);
      }
    }
    const std::string text = joined(words);
    EXPECT_TRUE(is_sound(text)) << text;
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace sdlc::test
