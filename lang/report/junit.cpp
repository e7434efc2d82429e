#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/report/report_place.hpp"
#include "lang/report/writers.hpp"
#include "lang/text/display_width.hpp"
#include "lang/text/utf8.hpp"

namespace sdlc::lang {
namespace {

/// Escapes text for XML attributes and content. XML cannot represent most control characters,
/// U+FFFE and U+FFFF, so all control characters are replaced by visible symbols, including line
/// ends.
std::string escaped(std::string_view text) {
  const std::string shown = printable(text);
  std::string result;
  for (std::string_view left = shown; !left.empty();) {
    const DecodedChar c = decode_utf8(left);
    switch (c.code_point) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      case 0xFFFE:
      case 0xFFFF: append_utf8(0xFFFD, result); break;
      default: result += left.substr(0, c.size);
    }
    left.remove_prefix(c.size);
  }
  return result;
}

/// The findings in one file.
struct Suite {
  std::string name;
  std::string cases = {};  ///< failed cases, as XML
  std::size_t failures = 0;
  std::size_t errors = 0;  ///< failures to read or write the file

  /// A suite without findings has one passed case, so that it counts as checked.
  std::size_t tests() const { return std::max<std::size_t>(failures + errors, 1); }
};

std::string failure(const Diagnostic& diagnostic, const std::string& path) {
  const auto& [file, span] = diagnostic.where;
  const std::string_view severity = severity_name(diagnostic.info->severity);
  const std::string message = message_with_suggestion(diagnostic);
  std::string place, line, details;
  if (file != nullptr) {
    const Position begin = file->position(span.begin);
    place = fmt::format(" {}:{}", begin.line, begin.column);
    line = fmt::format(" line=\"{}\"", begin.line);
    details = escaped(describe_place(diagnostic.where)) + ": ";
  }
  details += escaped(fmt::format("{}[{}]: {}", severity, diagnostic.info->code, message));
  for (const std::string& text : diagnostic.help) details += "\nhelp: " + escaped(text);
  return fmt::format(
      "    <testcase name=\"{0} {1}{2}\" classname=\"{3}\" file=\"{3}\"{4}>\n"
      "      <failure type=\"{5}\" message=\"{6}\">{7}</failure>\n"
      "    </testcase>\n",
      diagnostic.info->code, diagnostic.info->name, place, escaped(path), line, severity,
      escaped(message), details);
}

class JunitWriter final : public DiagnosticWriter {
 public:
  JunitWriter(std::ostream& out, ReportFacts facts) : out_(out), facts_(std::move(facts)) {}

  void enter(const std::string& name) override {
    entered_ = report_path(name, facts_.root);
    suite_of(entered_);
  }

  void write(const Diagnostic& diagnostic) override {
    const SourceFile* file = diagnostic.where.file;
    const std::string path = file == nullptr ? entered_ : report_path(file->name(), facts_.root);
    Suite& suite = suite_of(path);
    suite.cases += failure(diagnostic, path);
    ++suite.failures;
  }

  void fail(const std::string& name, const std::string& reason) override {
    const std::string path = report_path(name, facts_.root);
    Suite& suite = suite_of(path);
    suite.cases += fmt::format(
        "    <testcase name=\"cannot be read or written\" classname=\"{0}\" file=\"{0}\">\n"
        "      <error type=\"error\" message=\"{1}\"/>\n"
        "    </testcase>\n",
        escaped(path), escaped(reason));
    ++suite.errors;
  }

  void finish(const DiagnosticCounts& counts) override {
    if (counts.omitted > 0) add_omitted(counts.omitted);
    std::size_t tests = 0, failures = 0, errors = 0;
    for (const Suite& suite : suites_) {
      tests += suite.tests();
      failures += suite.failures;
      errors += suite.errors;
    }
    out_ << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         << fmt::format("<testsuites name=\"sdlc\" tests=\"{}\" failures=\"{}\" errors=\"{}\">\n",
                        tests, failures, errors);
    for (const Suite& suite : suites_) write_suite(suite);
    out_ << "</testsuites>\n";
  }

 private:
  Suite& suite_of(const std::string& name) {
    const auto [known, is_new] = index_.emplace(name, suites_.size());
    return is_new ? suites_.emplace_back(Suite{.name = name}) : suites_[known->second];
  }

  void add_omitted(std::size_t omitted) {
    Suite& suite = suite_of("further findings");
    suite.cases = fmt::format(
        "    <testcase name=\"further findings\" classname=\"further findings\">\n"
        "      <failure type=\"error\" message=\"{}\"/>\n"
        "    </testcase>\n",
        escaped(omitted_text(omitted)));
    suite.failures = 1;
  }

  void write_suite(const Suite& suite) {
    const std::string name = escaped(suite.name);
    out_ << fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\">\n",
                        name, suite.tests(), suite.failures, suite.errors)
         << suite.cases;
    if (suite.failures + suite.errors == 0) {
      out_ << fmt::format("    <testcase name=\"no findings\" classname=\"{0}\" file=\"{0}\"/>\n",
                          name);
    }
    out_ << "  </testsuite>\n";
  }

  std::ostream& out_;
  ReportFacts facts_;
  std::string entered_ = "sdlc";
  std::vector<Suite> suites_;  // in order of occurrence
  std::unordered_map<std::string, std::size_t> index_;
};

}  // namespace

std::unique_ptr<DiagnosticWriter> make_junit_writer(std::ostream& out, ReportFacts facts) {
  return std::make_unique<JunitWriter>(out, std::move(facts));
}

}  // namespace sdlc::lang
