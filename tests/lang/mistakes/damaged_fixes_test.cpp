#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lang/allowances/allowances.hpp"
#include "lang/compile/compile.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lint/fix_text.hpp"
#include "lang/lint/lint.hpp"
#include "lang/program/program.hpp"
#include "tests/lang/mistakes/mutations.hpp"

// Fixes of damaged files: bytes and tokens deleted, inserted, doubled, swapped and replaced, quotes
// and brackets removed, habits of other languages planted, in all scenes and configs of the
// repository.
//
// Safe fixes do not increase the number of errors, leave strings and comments unchanged, and leave
// nothing to do for a second run. Unsafe ones do not increase the errors either, and each is
// reported as a guess.
//
// SDLC_DAMAGED_FILES=N damages N files of each set of texts, SDLC_MUTATION_SEED=N selects others.
namespace sdlc::test {
namespace {

namespace fs = std::filesystem;

std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

/// Texts by name; others are read from the folder on disk.
class Files final : public lang::FileSystem {
 public:
  explicit Files(const SoundTexts& texts) : texts_(texts) {}
  std::optional<std::string> read(const fs::path& path, std::uint64_t /*most*/,
                                  std::error_code& error) const override {
    const std::string name = path.generic_string();
    for (const SoundText& text : texts_) {
      if (text.name == name) return text.text;
    }
    error = std::make_error_code(std::errc::no_such_file_or_directory);
    return std::nullopt;
  }

 private:
  const SoundTexts& texts_;
};

/// A text as `sdlc lint` checks it, with limits that keep large scenes short.
class Checked final : public lang::CheckedText {
 public:
  Checked(std::string name, std::string text, const Files& files)
      : workspace_(files),
        file_(std::move(name), std::move(text)),
        compiler_(file_, {.workspace = &workspace_, .limits = kLimits, .sets = {}}, sink_) {
    lang::lint(compiler_, file_, sink_);
    findings_ = select_unallowed(sink_);
  }
  const lang::SourceFile& file() const override { return file_; }
  std::size_t error_count() const override { return sink_.error_count(); }
  const lang::Findings& findings() const override { return findings_; }

 private:
  static constexpr lang::Limits kLimits{.steps = 1'000'000, .objects = 200};

  lang::Workspace workspace_;
  lang::Document file_;
  lang::DiagnosticSink sink_;
  lang::Findings findings_;
  lang::Compiler compiler_;
};

// Damage

constexpr auto kHabits = std::to_array<std::string_view>({
    ";",
    ";\n",
    "=",
    " = ",
    ":",
    ",",
    "&&",
    "||",
    "!",
    " !",
    "===",
    "=<",
    "<>",
    "**",
    "++",
    "%",
    "?",
    "°",
    "−",
    "–",
    "×",
    "÷",
    "≤",
    "≠",
    "…",
    "“",
    "”",
    "„",
    "‘",
    "’",
    "'",
    "\"",
    "\\",
    "\\d",
    "\t",
    "\r",
    "\xC2\xA0",
    "\xE2\x80\x8B",
    "\x01",
    "\xFF",
    "# ",
    "#",
    "-- ",
    "--",
    "<!-- x -->",
    "// ",
    "/* ",
    "*/",
    "#declare R = 3;\n",
    "#define N 4\n",
    "#include \"x\"\n",
    "var x = 1\n",
    "new ",
    "0xff0000",
    "0x10",
    "1_000_",
    "1.",
    ".5",
    "+1",
    "007",
    "5 m",
    "40 deg",
    "2 s",
    "“#e8e8e8”",
    "'text'",
    "‘text’",
    "\"#ff0000\"",
    "<1, 2, 3>",
    "{1, 2, 3}",
    "[1, 2, 3]",
    "1 2 3",
    "16:9",
    "True",
    "None",
    "on",
    "undefined",
    "NaN",
    "return ",
    "float ",
    "number ",
    "x ",
    "earth ",
    "-sampling",
    "radius",
    " radius 1 ",
    "center ",
    "material: gold",
    "\n",
    "\n\n",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    "=>",
    "->",
    "then ",
    "else ",
    "and ",
    "1e",
    "5metres",
    "\"x\" ",
    "[1 2 3]",
    "sphere ball = {",
    "sphere(",
    "def f(x):\n",
    "fn f(x) { return x }\n",
    "scene 1\n",
    "scene",
});

/// The ends of the tokens of a text, approximately: words, and everything else one character at a
/// time.
std::size_t end_of_token(std::string_view text, std::size_t at) {
  const auto is_word = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '.'; };
  std::size_t end = at;
  while (end < text.size() && is_word(static_cast<unsigned char>(text[end]))) ++end;
  return std::max(end, std::min(at + 1, text.size()));
}

class Damager {
 public:
  explicit Damager(std::uint64_t seed) : random_(seed) {}

  std::string damage(std::string text) {
    const std::size_t slips = 1 + random_.below(random_.below(4) == 0 ? 6 : 2);
    for (std::size_t i = 0; i < slips && text.size() > 2; ++i) slip(text);
    return text;
  }
  std::size_t below(std::size_t bound) { return random_.below(bound); }

 private:
  void slip(std::string& text) {
    const std::size_t at = random_.below(text.size() - 1);
    switch (random_.below(12)) {
      case 0: text.erase(at, 1); return;
      case 1: text.insert(at, 1, text[at]); return;
      case 2: std::swap(text[at], text[at + 1]); return;
      case 3: text.insert(at, 1, kBytes[random_.below(kBytes.size())]); return;
      case 4: text[at] = kBytes[random_.below(kBytes.size())]; return;
      case 5: return erase_any_of(text, "\"'#/");
      case 6: return erase_any_of(text, "()[]{}");
      case 7: return erase_any_of(text, ",:");
      case 8: text.insert(token_near(text, at), habit()); return;
      case 9: {
        const std::size_t begin = token_near(text, at);
        text.replace(begin, end_of_token(text, begin) - begin, habit());
        return;
      }
      default: return slip_of_token(text, token_near(text, at));
    }
  }

  void slip_of_token(std::string& text, std::size_t begin) {
    const std::size_t end = end_of_token(text, begin);
    const std::string token = text.substr(begin, end - begin);
    switch (random_.below(3)) {
      case 0: text.erase(begin, token.size()); return;
      case 1: text.insert(end, " " + token); return;
      default: {
        const std::size_t next = std::min(text.find_first_not_of(" \n", end), text.size());
        const std::size_t next_end = end_of_token(text, next);
        const std::string other = text.substr(next, next_end - next);
        text.replace(next, other.size(), token);
        text.replace(begin, token.size(), other);
      }
    }
  }

  std::string habit() { return std::string(kHabits[random_.below(kHabits.size())]); }

  static std::size_t token_near(std::string_view text, std::size_t at) {
    const std::size_t space = text.find_first_of(" \n(,:", at);
    const std::size_t begin =
        space == std::string_view::npos ? space : text.find_first_not_of(" \n", space);
    return begin == std::string_view::npos ? at : begin;
  }

  void erase_any_of(std::string& text, std::string_view bytes) {
    const std::size_t found = text.find_first_of(bytes, random_.below(text.size()));
    if (found != std::string::npos) text.erase(found, 1);
  }

  static constexpr std::string_view kBytes{"{}[]()\",:;'\\/#*-+.=<>!&|?%^_ab019 \n\t\r\x01\xC3\xE2",
                                           48};
  Random random_;
};

// The parts of a text that are visible to a reader who knows only quotes and comment marks.

/// The content of its closed strings and its comments, in order.
std::vector<std::string_view> strings_and_comments(std::string_view text) {
  std::vector<std::string_view> all;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '"') {
      std::size_t end = at + 1;
      while (end < text.size() && text[end] != '"' && text[end] != '\n') {
        end += text[end] == '\\' && end + 1 < text.size() && text[end + 1] != '\n' ? 2 : 1;
      }
      end = std::min(end, text.size());
      if (end < text.size() && text[end] == '"') all.push_back(text.substr(at + 1, end - at - 1));
      at = end;
    } else if (text.substr(at).starts_with("//")) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      all.push_back(text.substr(at, end - at));
      at = end;
    } else if (text.substr(at).starts_with("/*")) {
      std::size_t depth = 0, end = at;
      do {
        const std::string_view mark = text.substr(end, 2);
        depth += mark == "/*";
        depth -= mark == "*/";
        end += mark == "/*" || mark == "*/" ? 2 : 1;
      } while (depth > 0 && end < text.size());
      all.push_back(text.substr(at, end - at));
      at = end - 1;
    }
  }
  return all;
}

/// The first of them that does not occur in the other text after the previous one; empty if there
/// is none.
std::string_view first_lost(std::string_view text, std::string_view fixed) {
  std::size_t at = 0;
  for (const std::string_view part : strings_and_comments(text)) {
    const std::size_t found = fixed.find(part, at);
    if (found == std::string_view::npos) return part;
    at = found + part.size();
  }
  return {};
}

// The properties

struct Tally {
  std::uint64_t files = 0, wrong = 0, fixed_safely = 0, fixed_by_guesses = 0, refused = 0;
};

class Properties {
 public:
  Properties(const SoundTexts& texts, const std::string& name)
      : files_(texts),
        name_(name),
        check_([this](std::string text) { return checked(std::move(text)); }) {}

  void expect_of(const std::string& damaged, Tally& tally) const {
    const auto before = checked(damaged);
    const std::size_t errors = before->error_count();

    const lang::FixResult safe = fixed(damaged, false);
    const std::string text(safe.checked->file().text());
    EXPECT_LE(checked(text)->error_count(), errors) << "after " << text;
    EXPECT_TRUE(safe.guesses.empty());
    EXPECT_EQ(first_lost(damaged, text), "") << "in " << text;
    expect_stable(text, false);

    const lang::FixResult guessed = fixed(damaged, true);
    const std::string guess(guessed.checked->file().text());
    EXPECT_LE(checked(guess)->error_count(), errors) << "after " << guess;
    EXPECT_TRUE(guess == text || !guessed.guesses.empty()) << "not reported: " << guess;
    expect_stable(guess, true);

    ++tally.files;
    tally.wrong += errors > 0;
    tally.fixed_safely += text != damaged;
    tally.fixed_by_guesses += guess != text;
    tally.refused += safe.refused > 0;
  }

 private:
  std::unique_ptr<lang::CheckedText> checked(std::string text) const {
    return std::make_unique<Checked>(name_, std::move(text), files_);
  }
  lang::FixResult fixed(const std::string& text, bool applies_unsafe) const {
    return lang::fix_text(checked(text), applies_unsafe, check_);
  }
  void expect_stable(const std::string& text, bool applies_unsafe) const {
    const lang::FixResult again = fixed(text, applies_unsafe);
    EXPECT_EQ(again.checked->file().text(), text) << "a second run changes it";
    EXPECT_EQ(again.applied, 0u);
  }
  Files files_;
  std::string name_;
  lang::CheckText check_;
};

void expect_good_fixes(const SoundTexts& texts, std::uint64_t count) {
  count = from_environment("SDLC_DAMAGED_FILES", count);
  Damager damager(from_environment("SDLC_MUTATION_SEED", 20));
  Tally tally;
  for (std::uint64_t i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    const SoundText& sound = texts[damager.below(texts.size())];
    const std::string damaged = damager.damage(sound.text);
    Properties(texts, sound.name).expect_of(damaged, tally);
    if (testing::Test::HasFailure()) {
      ADD_FAILURE() << "file " << i << ", made of " << sound.name << ":\n" << damaged;
    }
  }
  const auto record = [](const char* name, std::uint64_t number) {
    testing::Test::RecordProperty(name, std::to_string(number));
  };
  record("files", tally.files);
  record("wrong", tally.wrong);
  record("fixed_safely", tally.fixed_safely);
  record("fixed_by_guesses", tally.fixed_by_guesses);
  record("refused", tally.refused);
  EXPECT_GE(tally.wrong, tally.files / 2) << "too few to tell";
}

/// Files that already contain many mistakes.
SoundTexts planted_texts() {
  SoundTexts texts;
  const fs::path folder = fs::path(SDLC_SOURCE_DIR) / "tests/files/planted";
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path extension = entry.path().extension();
    if (extension != ".scene" && extension != ".json") continue;
    std::error_code error;
    const auto text = lang::DiskFileSystem().read(entry.path(), std::uint64_t{1} << 20, error);
    const std::string name = entry.path().filename().string();
    texts.push_back({.name = name, .root = name, .text = text.value_or("")});
  }
  std::ranges::sort(texts, {}, &SoundText::name);
  return texts;
}

TEST(FixesOfDamagedFiles, OfTheExamplesDoNoHarm) { expect_good_fixes(example_texts(), 150); }
TEST(FixesOfDamagedFiles, OfTheWholeLanguageDoNoHarm) {
  expect_good_fixes(whole_language_texts(), 700);
}
TEST(FixesOfDamagedFiles, OfConfigsDoNoHarm) { expect_good_fixes(config_texts(), 1500); }
TEST(FixesOfDamagedFiles, OfFilesFullOfMistakesDoNoHarm) {
  expect_good_fixes(planted_texts(), 1200);
}

}  // namespace
}  // namespace sdlc::test
