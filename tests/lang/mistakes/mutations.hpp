#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lang/source/source.hpp"

/// Valid programs with a single typo.
namespace sdlc::test {

/// A text without mistakes.
struct SoundText {
  std::string name;  ///< its name in other texts of its program
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
  BytesSwapped,  ///< two adjacent ones
  BracketLost,   ///< one outside comments and strings
  NameMisspelt,  ///< one letter of a word changed, dropped or swapped with the next
};
inline constexpr std::size_t kSlipCount = 5;
std::string_view describe(Slip slip) noexcept;

/// A text with one typo in it.
struct Mutant {
  const SoundText* of = nullptr;
  Slip slip = Slip::ByteDeleted;
  std::size_t at = 0;  ///< the byte of the valid text where the damage begins
  std::string text;
};

/// The lines that a mutant is damaged in, from 1. If a line end was removed or added, both its
/// lines.
std::vector<std::uint32_t> damaged_lines(const Mutant& mutant);
/// The next line after `line` that is not empty; 0 if there is none.
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

/// Makes mutants of `texts`, which must outlive it. All kinds of typo are equally likely, all texts
/// in proportion to their length, and all places of a text equally.
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

/// An error about a mutant. The line is 0 if it is in another text.
struct MutantError {
  std::string code, message;
  std::uint32_t line = 0;
  std::vector<std::uint32_t> label_lines = {};
};

/// The errors of a mutant, as linting would report them.
std::vector<MutantError> errors_of(const Mutant& mutant, const SoundTexts& texts);

}  // namespace sdlc::test
