#include "lsp/diagnostics_json.hpp"

#include <utility>

#include <fmt/format.h>

namespace sdlc::lsp {
namespace {

enum DiagnosticSeverity : std::uint8_t { kError = 1, kWarning, kInformation };
constexpr int kUnnecessary = 1;  // the tag: editors show such text faded

DiagnosticSeverity severity_of(const lang::DiagnosticInfo& info) {
  if (info.severity == lang::Severity::Error) return kError;
  return info.code.starts_with('S') ? kInformation : kWarning;
}

std::string message_of(const lang::Diagnostic& diagnostic, bool has_related) {
  std::string text = diagnostic.message;
  if (!diagnostic.suggestion.empty()) {
    text += fmt::format("\ndid you mean `{}`?", diagnostic.suggestion);
  }
  for (const std::string& help : diagnostic.help) text += "\n" + help;
  if (has_related) return text;
  for (const lang::Label& label : diagnostic.labels) text += "\n" + label.message;
  for (const lang::ChainLink& link : diagnostic.chain) text += "\n" + link.message;
  return text;
}

}  // namespace

Json DiagnosticsJson::related(const lang::Diagnostic& diagnostic) {
  Json related = Json::array();
  const auto add = [&](const lang::Location& where, const std::string& message) {
    if (where.file == nullptr) return;
    related.push_back(
        {{"location",
          {{"uri", uri_of(*where.file)}, {"range", ranges.range(*where.file, where.span)}}},
         {"message", message}});
  };
  for (const lang::Label& label : diagnostic.labels) add(label.where, label.message);
  for (const lang::ChainLink& link : diagnostic.chain) add(link.where, link.message);
  return related;
}

Json DiagnosticsJson::of(const lang::Diagnostic& diagnostic) {
  const auto& [file, span] = diagnostic.where;
  Json json{{"range", file == nullptr ? first_range() : ranges.range(*file, span)},
            {"severity", severity_of(*diagnostic.info)},
            {"code", diagnostic.info->code},
            {"source", "sdlc"},
            {"message", message_of(diagnostic, has_related)}};
  if (diagnostic.info->name.starts_with("unused")) json["tags"] = Json::array({kUnnecessary});
  if (has_related) {
    if (Json places = related(diagnostic); !places.empty()) {
      json["relatedInformation"] = std::move(places);
    }
  }
  return json;
}

}  // namespace sdlc::lsp
