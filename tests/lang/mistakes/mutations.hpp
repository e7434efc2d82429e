#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lang/source/source.hpp"

/// Programs that are sound but for one slip of the pen.
namespace sdlc::test {

/// A text in which nothing is wrong.
struct SoundText {
  std::string name;  ///< as other texts of its program call it
  std::string root;  ///< the text that is compiled: itself, or one that needs it
  std::string text;
};

/// Some that need each other.
using SoundTexts = std::vector<SoundText>;

/// The examples and their library.
SoundTexts example_texts();
/// Every statement, property, argument and form of expression of the language.
SoundTexts whole_language_texts();
/// Configs in JSON, with every key of the format.
SoundTexts config_texts();

enum class Slip : std::uint8_t {
  ByteDeleted,
  ByteDoubled,
  BytesSwapped,  ///< two that stand side by side
  BracketLost,   ///< one that is part of no comment and no string
  NameMisspelt,  ///< one letter of a word changed, dropped or swapped with the next
};
inline constexpr std::size_t kSlipCount = 5;
std::string_view describe(Slip slip) noexcept;

/// A text with one slip of the pen in it.
struct Mutant {
  const SoundText* of = nullptr;
  Slip slip = Slip::ByteDeleted;
  std::size_t at = 0;  ///< the byte of the sound text where the damage begins
  std::string text;
};

/// Where a mutant is damaged, lines from 1. Where a line end has gone or come, both its lines.
std::vector<std::uint32_t> damaged_lines(const Mutant& mutant);
/// The next line behind `line` that is not blank; 0 where there is none.
std::uint32_t next_written_line(std::string_view text, std::uint32_t line);
bool is_blank_line(std::string_view text, std::uint32_t line);

/// SplitMix64: the same damage in every run.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::size_t below(std::size_t bound);

 private:
  std::uint64_t state_;
};

/// Makes mutants of `texts`, which must outlive it. Each slip is as likely as another, each text as
/// it is long, and each place of a text as another.
class Mutator {
 public:
  Mutator(const SoundTexts& texts, std::uint64_t seed);

  Mutant next();

 private:
  struct Places {
    std::vector<lang::Span> brackets, words;
  };

  std::size_t any_text();
  bool damage(Mutant& mutant, const Places& places);
  bool misspell(Mutant& mutant, lang::Span word);

  const SoundTexts& texts_;
  std::size_t size_ = 0;  ///< of all texts
  std::vector<Places> places_;
  Random random_;
};

/// An error about a mutant. A line is 0 where it is one of another text.
struct MutantError {
  std::string code, message;
  std::uint32_t line = 0;
  std::vector<std::uint32_t> label_lines = {};
};

/// What is wrong with a mutant, as linting it would tell.
std::vector<MutantError> errors_of(const Mutant& mutant, const SoundTexts& texts);

}  // namespace sdlc::test
