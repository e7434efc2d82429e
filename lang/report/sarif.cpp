#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lang/report/report_place.hpp"
#include "lang/report/rule_text.hpp"
#include "lang/report/writers.hpp"

// SARIF 2.1.0: https://docs.oasis-open.org/sarif/sarif/v2.1.0/sarif-v2.1.0.html. The subset that
// GitHub supports: "SARIF support for code scanning" in its documentation.
namespace sdlc::lang {
namespace {

using Json = nlohmann::ordered_json;

Json one(Json element) {
  Json array = Json::array();
  array.push_back(std::move(element));
  return array;
}

Json text_message(std::string_view text) { return Json::object({{"text", text}}); }

/// A message, with brackets escaped if SARIF would read a link.
Json message_of(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '[' || c == ']') escaped += '\\';
    escaped += c;
  }
  const bool looks_like_link = text.find("](") != std::string_view::npos;
  return text_message(looks_like_link ? escaped : text);
}

Json region_of(const Location& where) {
  const Position begin = where.file->position(where.span.begin);
  const Position end = where.file->position(where.span.end);
  return {{"startLine", begin.line},
          {"startColumn", begin.column},
          {"endLine", end.line},
          {"endColumn", end.column}};
}

/// A list of one location.
Json locations(Json physical_location) {
  return one(Json::object({{"physicalLocation", std::move(physical_location)}}));
}

std::string full_message(const Diagnostic& diagnostic) {
  std::string text = message_with_suggestion(diagnostic);
  for (const std::string& line : diagnostic.help) text += "\n" + line;
  return text;
}

class SarifWriter final : public DiagnosticWriter {
 public:
  SarifWriter(std::ostream& out, ReportFacts facts) : out_(out), facts_(std::move(facts)) {}

  void enter(const std::string& name) override { entered_ = name; }

  void write(const Diagnostic& diagnostic) override {
    const SourceFile* file = diagnostic.where.file;
    Json result = {{"ruleId", diagnostic.info->code},
                   {"ruleIndex", rule_index(*diagnostic.info)},
                   {"level", severity_name(diagnostic.info->severity)},
                   {"message", message_of(full_message(diagnostic))}};
    if (file != nullptr) {
      result["locations"] = locations(physical_location(diagnostic.where));
      const std::uint32_t line = file->position(diagnostic.where.span.begin).line;
      result["partialFingerprints"] = {{"primaryLocationLineHash", fingerprints_.of(*file, line)}};
    } else if (!entered_.empty()) {
      result["locations"] = locations({{"artifactLocation", artifact_location(entered_)}});
    }
    if (Json related = related_locations(diagnostic); !related.empty()) {
      result["relatedLocations"] = std::move(related);
    }
    if (!diagnostic.fixes.empty()) result["fixes"] = one(fix_of(diagnostic));
    results_.push_back(std::move(result));
  }

  void fail(const std::string& name, const std::string& reason) override {
    failures_.push_back(
        {{"level", "error"},
         {"message", message_of(reason)},
         {"locations", locations({{"artifactLocation", artifact_location(name)}})}});
  }

  void finish(const DiagnosticCounts& counts) override {
    Json invocation = {{"executionSuccessful", failures_.empty()}};
    Json notifications = std::move(failures_);
    if (counts.omitted > 0) {
      notifications.push_back(
          {{"level", "note"}, {"message", text_message(omitted_text(counts.omitted))}});
    }
    if (!notifications.empty()) {
      invocation["toolExecutionNotifications"] = std::move(notifications);
    }
    Json driver = {{"name", "sdlc"}};
    if (!facts_.version.empty()) driver["version"] = facts_.version;
    driver["rules"] = std::move(rules_);
    const Json run = {
        {"tool", {{"driver", std::move(driver)}}},
        {"columnKind", "unicodeCodePoints"},
        {"invocations", one(std::move(invocation))},
        {"originalUriBaseIds",
         {{kRoot, {{"description", text_message("The folder that sdlc was started in.")}}}}},
        {"results", std::move(results_)}};
    const Json log = {{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                      {"version", "2.1.0"},
                      {"runs", one(run)}};
    constexpr bool kIsAscii = true;
    out_ << log.dump(2, ' ', kIsAscii, Json::error_handler_t::replace) << '\n';
  }

 private:
  static constexpr const char* kRoot = "%SRCROOT%";

  /// The index of the rule, which is added at its first result.
  std::size_t rule_index(const DiagnosticInfo& info) {
    const auto [known, is_new] = rule_indices_.emplace(info.code, rules_.size());
    if (is_new) rules_.push_back(rule_of(info));
    return known->second;
  }

  Json rule_of(const DiagnosticInfo& info) const {
    Json rule = {{"id", info.code},
                 {"name", pascal_name(info)},
                 {"shortDescription", text_message(rule_title(info))}};
    const auto page = facts_.page_of ? facts_.page_of(info.code) : std::nullopt;
    if (page) {
      const std::string summary = first_paragraph(*page);
      rule["fullDescription"] = text_message(summary);
      rule["help"] = {{"text", fmt::format("{}\n\n`sdlc explain {}` shows the whole page.", summary,
                                           info.code)},
                      {"markdown", page_for_elsewhere(*page)}};
    }
    rule["defaultConfiguration"] = {{"level", severity_name(info.severity)}};
    return rule;
  }

  Json artifact_location(std::string_view name) const {
    const std::string path = report_path(name, facts_.root);
    Json location = {{"uri", report_uri(path)}};
    if (!path.starts_with('/')) location["uriBaseId"] = kRoot;
    return location;
  }

  Json physical_location(const Location& where) const {
    return {{"artifactLocation", artifact_location(where.file->name())},
            {"region", region_of(where)}};
  }

  /// The labels, then the evaluation chain.
  Json related_locations(const Diagnostic& diagnostic) const {
    Json related = Json::array();
    const auto add = [&](const Location& where, std::string_view message) {
      if (where.file == nullptr) return;
      related.push_back({{"id", related.size() + 1},
                         {"physicalLocation", physical_location(where)},
                         {"message", message_of(message)}});
    };
    for (const Label& label : diagnostic.labels) add(label.where, label.message);
    for (const ChainLink& link : diagnostic.chain) add(link.where, link.message);
    return related;
  }

  /// Includes unsafe fixes: in SARIF, a fix is a proposal.
  Json fix_of(const Diagnostic& diagnostic) const {
    Json changes = Json::array();
    bool is_safe = true;
    for (const Fix& fix : diagnostic.fixes) {
      is_safe = is_safe && fix.is_safe;
      const Json location = artifact_location(fix.where.file->name());
      if (changes.empty() || changes.back()["artifactLocation"] != location) {
        changes.push_back({{"artifactLocation", location}, {"replacements", Json::array()}});
      }
      changes.back()["replacements"].push_back(
          {{"deletedRegion", region_of(fix.where)},
           {"insertedContent", text_message(fix.replacement)}});
    }
    const std::string_view description = is_safe ? "A safe fix." : "A guess: check the result.";
    return {{"description", text_message(description)}, {"artifactChanges", std::move(changes)}};
  }

  std::ostream& out_;
  ReportFacts facts_;
  std::string entered_;
  LineFingerprints fingerprints_;
  std::unordered_map<std::string_view, std::size_t> rule_indices_;
  Json rules_ = Json::array();
  Json results_ = Json::array();
  Json failures_ = Json::array();  // notifications
};

}  // namespace

std::unique_ptr<DiagnosticWriter> make_sarif_writer(std::ostream& out, ReportFacts facts) {
  return std::make_unique<SarifWriter>(out, std::move(facts));
}

}  // namespace sdlc::lang
