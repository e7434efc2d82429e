#include "tests/lang/mistakes/mutations.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "lang/compile/compile.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/program/program.hpp"
#include "lang/report/findings.hpp"
#include "lang/source/limits.hpp"
#include "lang/token/name_characters.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::test {
namespace {

namespace fs = std::filesystem;

/// The end of the comment or string at `at`; `at` if there is none.
std::uint32_t end_of_opaque(std::string_view text, std::uint32_t at) {
  if (text[at] != '"' && text[at] != '/') return at;
  const lang::Token token = lang::scene_token(text, at);
  return is_comment(token.kind) || is_string(token.kind) ? token.span.end : at;
}

std::string read_text(const fs::path& path) {
  std::error_code error;
  auto text = lang::DiskFileSystem().read(path, lang::Limits().any_file(), error);
  if (!text) throw std::runtime_error("cannot read " + path.string());
  return std::move(*text);
}

void add_texts(SoundTexts& texts, const fs::path& folder, const fs::path& part,
               std::string_view extension) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder / part)) {
    if (entry.path().extension() == extension) paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  for (const fs::path& path : paths) {
    const std::string name = (part / path.filename()).generic_string();
    texts.push_back({.name = name, .root = name, .text = read_text(path)});
  }
}

fs::path source_folder(std::string_view folder) { return fs::path(SDLC_SOURCE_DIR) / folder; }

/// A text that others need is compiled as a part of one of them.
void set_root(SoundTexts& texts, std::string_view name, std::string_view root) {
  for (SoundText& text : texts) {
    if (text.name == name) text.root = root;
  }
}

/// The texts from memory, one of them as the mutant has it.
class MutantFiles final : public lang::FileSystem {
 public:
  MutantFiles(const SoundTexts& texts, const Mutant& mutant) : texts_(texts), mutant_(mutant) {}

  const std::string* find(std::string_view name) const {
    if (name == mutant_.of->name) return &mutant_.text;
    const auto found = std::find_if(texts_.begin(), texts_.end(),
                                    [&](const SoundText& text) { return text.name == name; });
    return found == texts_.end() ? nullptr : &found->text;
  }
  std::optional<std::string> read(const fs::path& path, std::uint64_t most,
                                  std::error_code& error) const override {
    if (const std::string* text = find(path.generic_string())) return *text;
    // Data files are not damaged, but their names may be.
    if (path.extension() == ".csv") {
      return lang::DiskFileSystem().read(source_folder("examples") / path, most, error);
    }
    error = std::make_error_code(std::errc::no_such_file_or_directory);
    return std::nullopt;
  }

 private:
  const SoundTexts& texts_;
  const Mutant& mutant_;
};

std::uint32_t line_of(std::string_view text, std::size_t at) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(at, text.size()));
  return 1 + static_cast<std::uint32_t>(std::count(text.begin(), end, '\n'));
}

std::string_view line_text(std::string_view text, std::uint32_t line) {
  for (; line > 1; --line) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  return text.substr(0, text.find('\n'));
}

}  // namespace

SoundTexts example_texts() {
  SoundTexts texts;
  add_texts(texts, source_folder("examples"), "", ".scene");
  add_texts(texts, source_folder("examples"), "library", ".scene");
  add_texts(texts, source_folder("examples"), "library", ".json");
  set_root(texts, "library/materials.scene", "caffeine.scene");
  set_root(texts, "library/pool-table.scene", "pool.scene");
  set_root(texts, "library/rack.json", "pool.scene");
  return texts;
}

SoundTexts whole_language_texts() {
  SoundTexts texts;
  add_texts(texts, source_folder("tests/files/whole"), "", ".scene");
  set_root(texts, "parts.scene", "whole.scene");
  set_root(texts, "shelf.scene", "whole.scene");
  return texts;
}

SoundTexts config_texts() {
  SoundTexts texts;
  add_texts(texts, source_folder("tests/files/whole"), "", ".json");
  add_texts(texts, source_folder("examples/library"), "", ".json");
  return texts;
}

std::string_view describe(Slip slip) noexcept {
  constexpr std::array<std::string_view, kSlipCount> kDescriptions{
      "a byte deleted", "a byte doubled", "two bytes swapped", "a bracket lost", "a name misspelt"};
  return kDescriptions[static_cast<std::size_t>(slip)];
}

std::vector<std::uint32_t> damaged_lines(const Mutant& mutant) {
  const std::uint32_t first = line_of(mutant.text, mutant.at);
  const std::uint32_t last = line_of(mutant.text, mutant.at + 1);
  const bool is_swap = mutant.slip == Slip::BytesSwapped && last != first;
  return is_swap ? std::vector{first, last} : std::vector{first};
}

bool is_blank_line(std::string_view text, std::uint32_t line) {
  return line_text(text, line).find_first_not_of(" \t\r") == std::string_view::npos;
}

std::uint32_t next_written_line(std::string_view text, std::uint32_t line) {
  const std::uint32_t last = line_of(text, text.size());
  for (++line; line <= last; ++line) {
    if (!is_blank_line(text, line)) return line;
  }
  return 0;
}

std::size_t Random::below(std::size_t bound) {
  std::uint64_t z = (state_ += 0x9E3779B97F4A7C15);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
  return static_cast<std::size_t>((z ^ (z >> 31)) % bound);
}

Mutator::Mutator(const SoundTexts& texts, std::uint64_t seed) : texts_(texts), random_(seed) {
  for (const SoundText& sound : texts) {
    Places& places = places_.emplace_back();
    size_ += sound.text.size();
    const std::string_view text = sound.text;
    const bool is_json = sound.name.ends_with(".json");
    for (std::uint32_t at = 0; at < text.size();) {
      // The words of a config are its strings.
      const std::uint32_t behind = end_of_opaque(text, at);
      const std::uint32_t end = is_json ? behind : lang::end_of_identifier(text, at);
      if (end > at + (is_json ? 2 : 0)) {
        places.words.push_back(is_json ? lang::Span{at + 1, end - 1} : lang::Span{at, end});
      } else if (std::string_view("()[]{}").find(text[at]) != std::string_view::npos) {
        places.brackets.push_back({at, at + 1});
      }
      at = std::max({behind, end, at + 1});
    }
  }
}

std::size_t Mutator::any_text() {
  std::size_t place = random_.below(size_), text = 0;
  while (place >= texts_[text].text.size()) place -= texts_[text++].text.size();
  return text;
}

Mutant Mutator::next() {
  while (true) {
    const std::size_t of = any_text();
    Mutant mutant{.of = &texts_[of],
                  .slip = static_cast<Slip>(random_.below(kSlipCount)),
                  .at = 0,
                  .text = texts_[of].text};
    if (damage(mutant, places_[of])) return mutant;
  }
}

bool Mutator::damage(Mutant& mutant, const Places& places) {
  std::string& text = mutant.text;
  mutant.at = random_.below(text.size() - 1);
  switch (mutant.slip) {
    case Slip::ByteDeleted: text.erase(mutant.at, 1); return true;
    case Slip::ByteDoubled: text.insert(mutant.at, 1, text[mutant.at]); return true;
    case Slip::BytesSwapped:
      std::swap(text[mutant.at], text[mutant.at + 1]);
      return text[mutant.at] != text[mutant.at + 1];
    case Slip::BracketLost:
      mutant.at = places.brackets[random_.below(places.brackets.size())].begin;
      text.erase(mutant.at, 1);
      return true;
    case Slip::NameMisspelt:
      return misspell(mutant, places.words[random_.below(places.words.size())]);
  }
  return false;
}

bool Mutator::misspell(Mutant& mutant, lang::Span word) {
  std::string& text = mutant.text;
  mutant.at = word.begin + random_.below(word.size());
  switch (random_.below(3)) {
    case 0: {
      const char letter = static_cast<char>('a' + random_.below(26));
      return std::exchange(text[mutant.at], letter) != letter;
    }
    case 1: text.erase(mutant.at, 1); return word.size() > 1;
    default:
      if (mutant.at + 1 == word.end) return false;
      std::swap(text[mutant.at], text[mutant.at + 1]);
      return text[mutant.at] != text[mutant.at + 1];
  }
}

std::vector<MutantError> errors_of(const Mutant& mutant, const SoundTexts& texts) {
  // A slip may make a scene a large one.
  constexpr lang::Limits kLimits{.steps = 20'000'000, .objects = 100'000};
  const MutantFiles files(texts, mutant);
  lang::Workspace workspace(files);
  const lang::Document root(mutant.of->root, *files.find(mutant.of->root));
  lang::DiagnosticSink sink;
  lang::Compiler compiler(root, {.workspace = &workspace, .limits = kLimits, .sets = {}}, sink);
  compiler.check();
  const auto line = [&](const lang::Location& where) {
    const bool is_here = where.file != nullptr && where.file->name() == mutant.of->name;
    return is_here ? where.file->position(where.span.begin).line : 0;
  };

  std::vector<MutantError> errors;
  for (const lang::Diagnostic* diagnostic : select_findings(sink).shown) {
    if (diagnostic->info->severity != lang::Severity::Error) continue;
    MutantError error{.code = std::string(diagnostic->info->code),
                      .message = diagnostic->message,
                      .line = line(diagnostic->where)};
    for (const lang::Label& label : diagnostic->labels) {
      error.label_lines.push_back(line(label.where));
    }
    errors.push_back(std::move(error));
  }
  return errors;
}

}  // namespace sdlc::test
