#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <gtest/gtest.h>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/source.hpp"
#include "lang/workspace/workspace.hpp"

/// File tests: texts as users write them, with the expected diagnostics below the wrong line. A
/// file holds named cases:
///
///     --- unknown_key_names_the_nearest_one ---
///     {"radus": 1}
///     // ^^^^^ E105: unknown key `radus` in a sphere
///     // ^^^^^ fix: `radius`
///
/// Every diagnostic must be expected, with its code, message, first column and length (for a span
/// over several lines, the length on the first), and every expectation must be met. A case without
/// expectations must have no diagnostics. `fix`, `label`, `help` and `chain` are compared if they
/// are given; the links of a chain are numbered, `chain: 1 in `ring``, innermost first, and are
/// below the text that they point to. Carets count code points; where carets are impossible (in the
/// first two columns), use `// @COLUMN+LENGTH E105: …`. ⟦FF⟧ in a text is the byte with that
/// hexadecimal number, ⟦a×9⟧ the letter nine times. SDLC_UPDATE=1 rewrites the expectations.
///
/// A line `=== materials.scene ===` inside a case ends its first text and begins another file,
/// which the first can import or include; expectations are in the file that they are about. A name
/// that begins with `--` is a flag, whose value is the text: `=== --set count ===`.
namespace sdlc::test {

/// The text with ⟦…⟧ replaced by the bytes.
std::string with_bytes(std::string_view text);

/// A remark about a text of a case: a diagnostic (`kind` is its code), or its label, fix, help or
/// link of its chain.
struct Remark {
  std::uint32_t line = 0, column = 0, length = 0;  ///< from 1; for help only the line counts
  std::string kind;
  std::string message;
  std::size_t text = 0;  ///< index in FileCase::texts

  friend bool operator==(const Remark&, const Remark&) = default;
};

struct CaseText {
  std::string name;                     ///< as in `=== NAME ===`; empty for the first text
  std::vector<std::string> lines = {};  ///< as in the file

  bool is_flag() const { return name.starts_with("--"); }
  /// The text to read: the lines, after `with_bytes`.
  std::string text() const;
};

struct FileCase {
  std::filesystem::path file;
  std::string name;
  std::vector<CaseText> texts = {{}};  ///< at least one
  std::vector<Remark> expected = {};
};
void PrintTo(const FileCase& file_case, std::ostream* out);

/// The texts of a case by name, without the first and the flags.
class CaseFiles final : public lang::FileSystem {
 public:
  explicit CaseFiles(const FileCase& file_case) : file_case_(file_case) {}

  std::optional<std::string> read(const std::filesystem::path& path, std::uint64_t /*most*/,
                                  std::error_code& error) const override;
  std::vector<lang::FolderEntry> list(const std::filesystem::path& folder) const override;

 private:
  const FileCase& file_case_;
};

/// The cases of all files in tests/files/FOLDER, by file name and place.
std::vector<FileCase> load_cases(std::string_view folder);
std::vector<FileCase> parse_cases(std::string_view text, const std::filesystem::path& file);

/// The file's text with the expectations of the case replaced.
std::string replace_expectations(std::string_view file_text, const FileCase& file_case,
                                 const std::vector<Remark>& remarks);

/// The sink's contents as remarks: each diagnostic followed by its labels, fixes, help and chain.
/// `file_name` is the name of the first text; remarks about none of the texts are at its beginning.
std::vector<Remark> remarks_of(const lang::DiagnosticSink& sink, const FileCase& file_case,
                               std::string_view file_name);

/// The differences between the remarks and the expectations; empty if they match.
std::string compare(const FileCase& file_case, const std::vector<Remark>& remarks);

using Reader = std::function<void(const lang::Document&, lang::DiagnosticSink&)>;

/// Reads the case's text under the name `file_name`. Fails the current test if the remarks differ
/// from the expectations, or writes them to the case's file.
void run_case(const FileCase& file_case, std::string_view file_name, const Reader& reader);

/// Reads a text and the files that it needs; returns the owner of the texts that the sink refers
/// to.
using ProgramReader = std::function<std::shared_ptr<const void>(
    const lang::Document&, lang::Workspace&, lang::DiagnosticSink&)>;

/// The same for a case of several files.
void run_program_case(const FileCase& file_case, std::string_view file_name,
                      const ProgramReader& reader);

/// Names a parametrised test after its case.
struct CaseName {
  std::string operator()(const testing::TestParamInfo<FileCase>& info) const {
    return info.param.name;
  }
};

}  // namespace sdlc::test
