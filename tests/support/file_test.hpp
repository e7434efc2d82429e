#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/source.hpp"

/// File tests: texts as a user could have written them, with what is reported about them written
/// below the line at fault. A file holds named cases:
///
///     --- unknown_key_names_the_nearest_one ---
///     {"radus": 1}
///     // ^^^^^ E105: unknown key `radus` in a sphere
///     // ^^^^^ fix: `radius`
///
/// Every diagnostic must be expected, with its code, message, first column and length (of a span
/// over several lines, the length on the first), and every expectation must come true. A case
/// without expectations says that nothing is reported. `fix`, `label` and `help` are compared where
/// they are given. Carets count code points; where they cannot stand below (the first two columns),
/// `// @COLUMN+LENGTH E105: …` says it. ⟦FF⟧ in a text is the byte with that hexadecimal number.
/// SDLC_UPDATE=1 rewrites the expectations.
namespace sdlc::test {

/// One remark about the text of a case: a diagnostic (`kind` is its code), or its label, fix or
/// help.
struct Remark {
  std::uint32_t line = 0, column = 0, length = 0;  ///< from 1; of help only the line counts
  std::string kind;
  std::string message;

  friend bool operator==(const Remark&, const Remark&) = default;
};

struct FileCase {
  std::filesystem::path file;
  std::string name;
  std::vector<std::string> lines;  ///< of the text, as they stand in the file
  std::vector<Remark> expected;

  /// What is to be read: the lines with ⟦…⟧ replaced.
  std::string text() const;
};
void PrintTo(const FileCase& file_case, std::ostream* out);

/// The cases of all files in tests/files/FOLDER, by file name and place.
std::vector<FileCase> load_cases(std::string_view folder);
std::vector<FileCase> parse_cases(std::string_view text, const std::filesystem::path& file);

/// The file's text with the expectations of the case replaced.
std::string replace_expectations(std::string_view file_text, const FileCase& file_case,
                                 const std::vector<Remark>& remarks);

/// What the sink holds, as remarks: each diagnostic followed by its labels, fixes and help.
std::vector<Remark> remarks_of(const lang::DiagnosticSink& sink, const FileCase& file_case);

/// What is wrong with the remarks; empty if they are as expected.
std::string compare(const FileCase& file_case, const std::vector<Remark>& remarks);

using Reader = std::function<void(const lang::SourceFile&, lang::DiagnosticSink&)>;

/// Reads the case's text under the name `file_name` and fails the current test if the outcome is
/// not as expected, or writes the outcome to the case's file.
void run_case(const FileCase& file_case, std::string_view file_name, const Reader& reader);

/// Names a parametrised test after its case.
struct CaseName {
  std::string operator()(const testing::TestParamInfo<FileCase>& info) const {
    return info.param.name;
  }
};

}  // namespace sdlc::test
