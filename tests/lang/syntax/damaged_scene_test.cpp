#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "lang/repair/repaired_text.hpp"
#include "lang/source/limits.hpp"
#include "lang/syntax/syntax.hpp"
#include "lang/text/utf8.hpp"
#include "tests/lang/syntax/tree_checks.hpp"

// Whatever a file is damaged by, its tree has a sound shape and its tokens spell the file.
namespace sdlc::lang {
namespace {

void expect_sound(const std::string& text) {
  const SourceFile file("test.scene", text);
  DiagnosticSink sink;
  const SyntaxTree tree = parse(file, sink);
  EXPECT_EQ(test::fault_of(tree), "") << text;
  EXPECT_EQ(test::spelling_of(text), text);
  EXPECT_TRUE(sink.has_errors() || !test::has_skipped(tree)) << text;
  for (const Diagnostic& diagnostic : sink.diagnostics()) {
    EXPECT_LE(diagnostic.where.span.begin, diagnostic.where.span.end);
    EXPECT_LE(diagnostic.where.span.end, text.size()) << diagnostic.message << "\n" << text;
  }
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

std::vector<std::string> sound_files() {
  std::vector<std::string> files{std::string(test::kWholeLanguage)};
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(SDLC_SOURCE_DIR) + "/examples")) {
    if (entry.path().extension() != ".scene") continue;
    std::error_code error;
    if (auto text = DiskFileSystem().read(entry.path(), Limits().any_file(), error))
      files.push_back(std::move(*text));
  }
  return files;
}

TEST(DamagedScene, IsSoundBeforeTheDamage) {
  for (const std::string& text : sound_files()) {
    const SourceFile file("test.scene", text);
    DiagnosticSink sink;
    const SyntaxTree tree = parse(file, sink);
    EXPECT_FALSE(sink.has_errors()) << text;
    expect_sound(text);
  }
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const DecodedChar c = decode_utf8(text);
    if (!c.is_valid) return false;
    text.remove_prefix(c.size);
  }
  return true;
}

TEST(DamagedScene, CutsALongTokenBetweenCharacters) {
  std::string text = "scene 1\n";
  while (text.size() <= kMaxRepairedText) text += "\u00E9";
  const SourceFile file("test.scene", text);
  DiagnosticSink sink;
  parse(file, sink);
  ASSERT_TRUE(sink.has_errors());
  const std::string& message = sink.diagnostics().front().message;
  EXPECT_TRUE(is_utf8(message)) << message;
  EXPECT_LT(message.size(), 200u);
}

TEST(DamagedScene, MayEndAnywhere) {
  const std::string text(test::kWholeLanguage);
  for (std::size_t size = 0; size < text.size(); ++size) expect_sound(text.substr(0, size));
}

TEST(DamagedScene, MayLackAnyByte) {
  const std::string text(test::kWholeLanguage);
  for (std::size_t i = 0; i < text.size(); ++i) expect_sound(std::string(text).erase(i, 1));
}

TEST(DamagedScene, MayBeDamagedInManyPlaces) {
  const std::string bytes(
      "{}[]()\",:'\\/#*-+.0e9nNtu= \n\t\r\x01\x7F\x80\xC3\xA0\xE2\xEF\xFF\0;&|!?%^<>_ab", 50);
  Random random(7);
  const auto files = sound_files();
  for (int i = 0; i < 4000; ++i) {
    std::string text = files[random.below(files.size())];
    const std::size_t damages = 1 + random.below(6);
    for (std::size_t k = 0; k < damages; ++k) {
      const std::size_t at = random.below(text.size());
      const std::size_t size = random.below(12);
      switch (random.below(4)) {
        case 0: text.erase(at, 1 + size); break;
        case 1: text.insert(at, 1, bytes[random.below(bytes.size())]); break;
        case 2: text[at] = bytes[random.below(bytes.size())]; break;
        default: text.insert(random.below(text.size()), text.substr(at, size)); break;
      }
      if (text.empty()) text = " ";
    }
    expect_sound(text);
    if (HasFailure()) return;
  }
}

TEST(DamagedScene, OfManyErrorsIsReadInLinearTime) {
  for (const char* line : {"a: (1\n", "let = 5\n", "} ) ]\n", "f(\n", "x: \"abc\n", "@@@@\n",
                           "sphere { a: [\n", "1 2 3\n", "/* "}) {
    std::string text = "scene 1\n";
    while (text.size() < 300'000) text += line;
    const SourceFile file("test.scene", text);
    DiagnosticSink sink;
    parse(file, sink);
    EXPECT_TRUE(sink.has_errors()) << line;
  }
}

}  // namespace
}  // namespace sdlc::lang
