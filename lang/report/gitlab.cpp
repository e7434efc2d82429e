#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lang/report/report_place.hpp"
#include "lang/report/writers.hpp"

namespace sdlc::lang {
namespace {

using Json = nlohmann::ordered_json;

class GitlabWriter final : public DiagnosticWriter {
 public:
  GitlabWriter(std::ostream& out, ReportFacts facts) : out_(out), facts_(std::move(facts)) {}

  void enter(const std::string& name) override { entered_ = name; }

  void write(const Diagnostic& diagnostic) override {
    const auto& [file, span] = diagnostic.where;
    const std::string path = report_path(file == nullptr ? entered_ : file->name(), facts_.root);
    const Position begin = file == nullptr ? Position{} : file->position(span.begin);
    const Position end = file == nullptr ? Position{} : file->position(span.end);
    const std::string line = file == nullptr ? "" : fingerprints_.of(*file, begin.line);
    const bool is_error = diagnostic.info->severity == Severity::Error;
    issues_.push_back(
        {{"description", message_with_suggestion(diagnostic)},
         {"check_name", fmt::format("{} {}", diagnostic.info->code, diagnostic.info->name)},
         {"fingerprint", unique(fmt::format("{}:{}:{}", diagnostic.info->code, line, path))},
         {"severity", is_error ? "major" : "minor"},
         {"location",
          {{"path", path},
           {"positions",
            {{"begin", {{"line", begin.line}, {"column", begin.column}}},
             {"end", {{"line", end.line}, {"column", end.column}}}}}}}});
  }

  void fail(const std::string& name, const std::string& reason) override {
    const std::string path = report_path(name, facts_.root);
    issues_.push_back({{"description", reason},
                       {"check_name", "cannot be read or written"},
                       {"fingerprint", unique("unreadable:" + path)},
                       {"severity", "blocker"},
                       {"location", {{"path", path}, {"lines", {{"begin", 1}}}}}});
  }

  void finish(const DiagnosticCounts& /*counts*/) override {
    constexpr bool kIsAscii = true;
    out_ << issues_.dump(2, ' ', kIsAscii, Json::error_handler_t::replace) << '\n';
  }

 private:
  /// Two findings of a report must not have the same fingerprint.
  std::string unique(const std::string& fingerprint) {
    std::string numbered = fingerprint;
    for (int n = 2; !seen_.insert(numbered).second; ++n) {
      numbered = fmt::format("{}:{}", fingerprint, n);
    }
    return numbered;
  }

  std::ostream& out_;
  ReportFacts facts_;
  std::string entered_;
  LineFingerprints fingerprints_;
  std::set<std::string> seen_;
  Json issues_ = Json::array();
};

}  // namespace

std::unique_ptr<DiagnosticWriter> make_gitlab_writer(std::ostream& out, ReportFacts facts) {
  return std::make_unique<GitlabWriter>(out, std::move(facts));
}

}  // namespace sdlc::lang
