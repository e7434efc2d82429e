#include "tests/support/file_test.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <ostream>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "lang/allowances/allowances.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/report/report.hpp"
#include "lang/text/display_width.hpp"
#include "lang/text/utf8.hpp"
#include "tests/support/folder_lock.hpp"

namespace sdlc::test {
namespace {

namespace fs = std::filesystem;

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> split_lines(std::string_view text) {
  std::vector<std::string> lines;
  std::istringstream stream{std::string(text)};
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::optional<std::string> name_in(const std::string& line, const std::regex& header) {
  std::smatch match;
  if (!std::regex_match(line, match, header)) return std::nullopt;
  return match[1];
}

std::optional<std::string> case_name(const std::string& line) {
  static const std::regex header("--- (\\w+) ---");
  return name_in(line, header);
}

std::optional<std::string> text_name(const std::string& line) {
  static const std::regex header("=== (\\S.*) ===");
  return name_in(line, header);
}

/// The expectation in the line, if it is one, about line `number` of a text.
std::optional<Remark> parse_expectation(const std::string& line, std::size_t text,
                                        std::uint32_t number) {
  static const std::regex below("(//\\s*)(\\^+) ([A-Z]\\d\\d\\d|label|fix|chain): (.*)");
  static const std::regex by_number("// @(\\d+)\\+(\\d+) ([A-Z]\\d\\d\\d|label|fix|chain): (.*)");
  static const std::regex help("// help: (.*)");
  if (!line.starts_with("//")) return std::nullopt;
  std::smatch match;
  const auto remark = [&](std::size_t column, std::size_t length) {
    return Remark{.line = number,
                  .column = static_cast<std::uint32_t>(column),
                  .length = static_cast<std::uint32_t>(length),
                  .kind = match[3],
                  .message = match[4],
                  .text = text};
  };
  if (std::regex_match(line, match, below)) {
    return remark(static_cast<std::size_t>(match[1].length()) + 1,
                  static_cast<std::size_t>(match[2].length()));
  }
  if (std::regex_match(line, match, by_number)) {
    return remark(std::stoul(match[1]), std::stoul(match[2]));
  }
  if (std::regex_match(line, match, help)) {
    return Remark{.line = number, .kind = "help", .message = match[1], .text = text};
  }
  return std::nullopt;
}

std::string to_line(const Remark& remark) {
  constexpr std::uint32_t kFirstFreeColumn = 3;
  if (remark.kind == "help") return fmt::format("// help: {}", remark.message);
  if (remark.column < kFirstFreeColumn) {
    return fmt::format("// @{}+{} {}: {}", remark.column, remark.length, remark.kind,
                       remark.message);
  }
  return fmt::format("//{:{}}{:^>{}} {}: {}", "", remark.column - kFirstFreeColumn, "",
                     remark.length, remark.kind, remark.message);
}

/// Creates remarks about places in the texts of a case.
class Remarker {
 public:
  Remarker(const FileCase& file_case, std::string_view file_name)
      : file_case_(file_case), file_name_(file_name) {}

  /// A remark at the place, restricted to its first line.
  Remark at(const lang::Location& where, std::string_view kind, std::string_view message) const {
    const std::optional<std::size_t> text = text_of(where.file);
    if (!text) {
      const bool is_empty = file_case_.texts.front().lines.empty();
      return {.line = is_empty ? 0u : 1u,
              .column = 1,
              .length = 1,
              .kind = std::string(kind),
              .message = lang::printable(message)};
    }
    const lang::SourceFile& file = *where.file;
    const lang::Position position = file.position(where.span.begin);
    const std::uint32_t line_end = file.line_begin(position.line) +
                                   static_cast<std::uint32_t>(file.line(position.line).size());
    const std::uint32_t end = std::max(where.span.begin, std::min(where.span.end, line_end));
    const std::size_t length = lang::count_code_points(file.text({where.span.begin, end}));
    Remark remark{.line = position.line,
                  .column = position.column,
                  .length = static_cast<std::uint32_t>(std::max<std::size_t>(length, 1)),
                  .kind = std::string(kind),
                  .message = lang::printable(message),
                  .text = *text};

    // The end of the text is after the last line break, where the case has no line.
    const auto last_line = static_cast<std::uint32_t>(file_case_.texts[*text].lines.size());
    if (remark.line > last_line) {
      remark.line = last_line;
      remark.column = 1;
      if (last_line > 0) {
        remark.column += static_cast<std::uint32_t>(lang::count_code_points(file.line(last_line)));
      }
    }
    return remark;
  }

 private:
  std::optional<std::size_t> text_of(const lang::SourceFile* file) const {
    if (file == nullptr) return std::nullopt;
    if (file->name() == file_name_) return 0;
    for (std::size_t i = 1; i < file_case_.texts.size(); ++i) {
      if (file_case_.texts[i].name == file->name()) return i;
    }
    return std::nullopt;
  }

  const FileCase& file_case_;
  std::string_view file_name_;
};

bool is_diagnostic(const Remark& remark) {
  return remark.kind.size() == 4 && remark.kind != "help";
}

/// Checks that no diagnostic suggests or fixes nothing, or omits its choices.
std::string nonsense_in(const lang::DiagnosticSink& sink) {
  std::string found;
  const auto text_of = [](const lang::Location& where) {
    return where.file == nullptr ? std::string_view() : where.file->text(where.span);
  };
  for (const lang::Diagnostic& diagnostic : sink.diagnostics()) {
    const auto complain = [&](std::string_view what) {
      found += fmt::format("{} ({}): {}\n", diagnostic.info->code, diagnostic.message, what);
    };
    const std::string& suggestion = diagnostic.suggestion;
    const std::string named = fmt::format("`{}`", suggestion);
    if (!suggestion.empty() && suggestion == text_of(diagnostic.where)) complain("suggests itself");
    // "expected `for`, found `foreach`" already contains the expectation.
    const bool is_expected = diagnostic.info->code == lang::diag::expected.code;
    if (!suggestion.empty() && !is_expected &&
        diagnostic.message.find(named) != std::string::npos) {
      complain("suggests what its message names");
    }
    for (const lang::Fix& fix : diagnostic.fixes) {
      if (fix.replacement == text_of(fix.where)) complain("a fix changes nothing");
    }
    const bool is_choice = diagnostic.info->code == lang::diag::unknown_word.code ||
                           diagnostic.info->code == lang::diag::unknown_type.code;
    const bool has_choices = std::ranges::any_of(
        diagnostic.help, [](const std::string& help) { return help.find(", ") != help.npos; });
    if (is_choice && !has_choices) complain("does not list the choices");
  }
  const std::string shown =
      lang::render_diagnostics(sink, {.format = lang::MessageFormat::Human, .facts = {}});
  for (const std::string& line : split_lines(shown)) {
    constexpr std::string_view kWrite = "help: write ", kInstead = " instead of ";
    const std::size_t write = line.find(kWrite), instead = line.find(kInstead);
    if (write == std::string::npos || instead == std::string::npos) continue;
    const std::size_t begin = write + kWrite.size();
    if (line.substr(begin, instead - begin) == line.substr(instead + kInstead.size())) {
      found += line + "\n";
    }
  }
  return found;
}

void update(const FileCase& file_case, const std::vector<Remark>& remarks) {
  const FolderLock lock(file_case.file.parent_path());
  const std::string text = replace_expectations(read_file(file_case.file), file_case, remarks);
  std::ofstream(file_case.file, std::ios::binary) << text;
}

}  // namespace

std::string with_bytes(std::string_view text) {
  static const std::regex mark("⟦(?:([0-9A-F]{2})|(\\w)×(\\d+))⟧");
  std::string result;
  std::cmatch match;
  const char* rest = text.data();
  const char* const end = rest + text.size();
  while (std::regex_search(rest, end, match, mark)) {
    result.append(rest, match[0].first);
    if (match[1].matched) {
      result += static_cast<char>(std::stoi(match[1], nullptr, 16));
    } else {
      result.append(std::stoul(match[3]), *match[2].first);
    }
    rest = match[0].second;
  }
  return result.append(rest, end);
}

std::string CaseText::text() const {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return with_bytes(text);
}

void PrintTo(const FileCase& file_case, std::ostream* out) {
  *out << file_case.file.filename().string() << ": " << file_case.name;
}

std::optional<std::string> CaseFiles::read(const fs::path& path, std::uint64_t /*most*/,
                                           std::error_code& error) const {
  for (const CaseText& text : file_case_.texts) {
    if (!text.name.empty() && !text.is_flag() && text.name == path.generic_string()) {
      return text.text();
    }
  }
  error = std::make_error_code(std::errc::no_such_file_or_directory);
  return std::nullopt;
}

std::vector<lang::FolderEntry> CaseFiles::list(const fs::path& folder) const {
  std::set<std::string> files, folders;
  for (const CaseText& text : file_case_.texts) {
    if (text.name.empty() || text.is_flag()) continue;
    const fs::path inside = fs::path("./" + text.name).lexically_relative("." / folder);
    if (inside.empty() || *inside.begin() == "..") continue;
    const bool is_file = inside.parent_path().empty();
    (is_file ? files : folders).insert(inside.begin()->string());
  }
  std::vector<lang::FolderEntry> entries;
  for (const std::string& name : files) entries.push_back({name, false});
  for (const std::string& name : folders) entries.push_back({name, true});
  return entries;
}

std::vector<FileCase> parse_cases(std::string_view text, const fs::path& file) {
  std::vector<FileCase> cases;
  const auto end_text = [&] {
    if (cases.empty()) return;
    // An empty line before the next text is a separator, not part of the text.
    std::vector<std::string>& lines = cases.back().texts.back().lines;
    if (!lines.empty() && lines.back().empty()) lines.pop_back();
  };
  for (const std::string& line : split_lines(text)) {
    if (const auto name = case_name(line)) {
      end_text();
      cases.push_back({.file = file, .name = *name});
      continue;
    }
    if (cases.empty()) continue;  // text before the first case is about the file
    FileCase& file_case = cases.back();
    if (const auto name = text_name(line)) {
      end_text();
      file_case.texts.push_back({.name = *name});
      continue;
    }
    CaseText& last = file_case.texts.back();
    const auto number = static_cast<std::uint32_t>(last.lines.size());
    if (auto remark = parse_expectation(line, file_case.texts.size() - 1, number)) {
      file_case.expected.push_back(std::move(*remark));
    } else {
      last.lines.push_back(line);
    }
  }
  end_text();
  return cases;
}

std::vector<FileCase> load_cases(std::string_view folder) {
  std::vector<fs::path> files;
  for (const auto& entry :
       fs::directory_iterator(fs::path(SDLC_SOURCE_DIR) / "tests/files" / folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());

  std::vector<FileCase> cases;
  for (const fs::path& file : files) {
    auto more = parse_cases(read_file(file), file);
    std::move(more.begin(), more.end(), std::back_inserter(cases));
  }
  return cases;
}

std::string replace_expectations(std::string_view file_text, const FileCase& file_case,
                                 const std::vector<Remark>& remarks) {
  std::string result;
  bool is_inside = false;
  std::size_t text = 0;
  std::uint32_t number = 0;
  const auto begin_text = [&](std::size_t index) {
    text = index;
    number = 0;
  };
  const auto write_remarks = [&] {
    for (const Remark& remark : remarks) {
      if (remark.text == text && remark.line == number) result += to_line(remark) + "\n";
    }
  };
  for (const std::string& line : split_lines(file_text)) {
    const auto name = case_name(line);
    if (name) {
      is_inside = *name == file_case.name;
      begin_text(0);
    }
    const bool is_head = name || (is_inside && text_name(line));
    if (is_head && !name) begin_text(text + 1);
    if (is_head || !is_inside) {
      result += line + "\n";
    } else if (parse_expectation(line, text, number)) {
      continue;
    } else {
      ++number;
      result += line + "\n";
    }
    if (is_inside) write_remarks();
  }
  return result;
}

std::vector<Remark> remarks_of(const lang::DiagnosticSink& sink, const FileCase& file_case,
                               std::string_view file_name) {
  const Remarker remarker(file_case, file_name);
  std::vector<Remark> remarks;
  for (const lang::Diagnostic* diagnostic : select_unallowed(sink).shown) {
    remarks.push_back(remarker.at(diagnostic->where, diagnostic->info->code, diagnostic->message));
    const Remark own = remarks.back();
    for (const lang::Label& label : diagnostic->labels) {
      remarks.push_back(remarker.at(label.where, "label", label.message));
    }
    for (const lang::Fix& fix : diagnostic->fixes) {
      remarks.push_back(remarker.at(fix.where, "fix", fmt::format("`{}`", fix.replacement)));
    }
    for (const std::string& help : diagnostic->help) {
      remarks.push_back(
          {.line = own.line, .kind = "help", .message = lang::printable(help), .text = own.text});
    }
    std::size_t number = 0;
    for (const lang::ChainLink& link : diagnostic->chain) {
      remarks.push_back(
          remarker.at(link.where, "chain", fmt::format("{} {}", ++number, link.message)));
    }
  }
  return remarks;
}

std::string compare(const FileCase& file_case, const std::vector<Remark>& remarks) {
  std::string problems;
  const auto complain = [&](std::string_view what, const Remark& remark) {
    const CaseText& text = file_case.texts[remark.text];
    const std::string line = remark.line > 0 ? text.lines[remark.line - 1] : "(empty)";
    const std::string of = text.name.empty() ? "the case" : text.name;
    problems +=
        fmt::format("{} at line {} of {}:\n{}\n{}\n", what, remark.line, of, line, to_line(remark));
  };
  std::vector<Remark> unexpected = remarks;
  for (const Remark& expected : file_case.expected) {
    const auto found = std::find(unexpected.begin(), unexpected.end(), expected);
    if (found != unexpected.end()) {
      unexpected.erase(found);
    } else {
      complain("expected, but not reported", expected);
    }
  }
  for (const Remark& remark : unexpected) {
    if (is_diagnostic(remark)) complain("reported, but not expected", remark);
  }
  return problems;
}

void run_program_case(const FileCase& file_case, std::string_view file_name,
                      const ProgramReader& reader) {
  const lang::Document file{std::string(file_name), file_case.texts.front().text()};
  const CaseFiles files(file_case);
  lang::Workspace workspace(files);
  lang::DiagnosticSink sink;
  const std::shared_ptr<const void> texts = reader(file, workspace, sink);
  const std::vector<Remark> remarks = remarks_of(sink, file_case, file_name);
  EXPECT_EQ(nonsense_in(sink), "") << file_case.file.string() << ", case " << file_case.name;
  if (std::getenv("SDLC_UPDATE") != nullptr) return update(file_case, remarks);

  const std::string problems = compare(file_case, remarks);
  if (!problems.empty()) {
    ADD_FAILURE() << file_case.file.string() << ", case " << file_case.name << ":\n"
                  << problems << "SDLC_UPDATE=1 rewrites the expectations.";
  }
}

void run_case(const FileCase& file_case, std::string_view file_name, const Reader& reader) {
  ASSERT_EQ(file_case.texts.size(), 1u) << "more texts than this test reads";
  run_program_case(
      file_case, file_name,
      [&](const lang::Document& file, lang::Workspace& /*workspace*/, lang::DiagnosticSink& sink) {
        reader(file, sink);
        return nullptr;
      });
}

}  // namespace sdlc::test
