#include "lang/allowances/allowances.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "lang/allowances/allowance_comments.hpp"
#include "lang/text/ascii.hpp"
#include "lang/text/nearest_name.hpp"
#include "lang/workspace/document.hpp"

namespace sdlc::lang {
namespace {

/// The code in capitals, as in the table.
std::string code_text(const SourceFile& file, Span code) { return upper_case(file.text(code)); }

/// Whether the code, or a code with this prefix, exists.
bool is_code(std::string_view code, Severity severity) {
  return std::ranges::any_of(all_diagnostics(), [&](const DiagnosticInfo* info) {
    return info->severity == severity && info->code.starts_with(code);
  });
}

/// The comment with the spaces before it, or with its line if nothing else is on it.
Span with_space(std::string_view text, Span comment) {
  Span span = comment;
  while (span.begin > 0 && (text[span.begin - 1] == ' ' || text[span.begin - 1] == '\t')) {
    --span.begin;
  }
  const bool is_alone = span.begin == 0 || text[span.begin - 1] == '\n';
  if (!is_alone) return span;
  if (span.end < text.size() && text[span.end] == '\r') ++span.end;
  if (span.end < text.size() && text[span.end] == '\n') ++span.end;
  return span;
}

}  // namespace

Allowances::FileAllowances Allowances::read(const SourceFile& file) const {
  FileAllowances result;
  const auto* document = dynamic_cast<const Document*>(&file);
  if (document == nullptr || file.format() != SourceFormat::Scene) return result;
  if (!may_have_allowances(file.text())) return result;  // without parsing
  DiagnosticSink ignored(stop_);
  std::vector<std::optional<Span>> places;  // of each allowance
  for (const AllowanceComment& comment : read_allowance_comments(document->tree(ignored), stop_)) {
    const std::vector<Span>& codes = comment.codes;
    if (codes.empty()) result.malformed.push_back(comment.comment);
    for (std::uint32_t k = 0; k < codes.size(); ++k) {
      result.list.push_back({.code = codes[k],
                             .comment = comment.comment,
                             .index = k,
                             .count = static_cast<std::uint32_t>(codes.size())});
      places.push_back(comment.statement);
    }
  }
  find_places(places, result);
  for (const Allowance& allowance : result.list) {
    if (allowance.place == kNowhere) continue;
    result.places[allowance.place].is_used.emplace(code_text(file, allowance.code), false);
  }
  return result;
}

/// Statements are nested or disjoint, so each place has at most one innermost place around it.
void Allowances::find_places(const std::vector<std::optional<Span>>& statements,
                             FileAllowances& allowances) {
  std::vector<Place>& places = allowances.places;
  for (const std::optional<Span>& statement : statements) {
    if (statement) places.push_back({.statement = *statement});
  }
  const auto order = [](const Place& place) {
    return std::pair(place.statement.begin, ~place.statement.end);
  };
  std::ranges::sort(places, {}, order);
  const auto is_same = [&](const Place& a, const Place& b) { return order(a) == order(b); };
  places.erase(std::unique(places.begin(), places.end(), is_same), places.end());

  std::uint32_t around = kNowhere;
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    while (around != kNowhere && places[around].statement.end <= places[i].statement.begin) {
      around = places[around].around;
    }
    places[i].around = around;
    around = i;
  }
  for (std::size_t i = 0; i < statements.size(); ++i) {
    if (!statements[i]) continue;
    const auto found =
        std::ranges::lower_bound(places, order({.statement = *statements[i]}), {}, order);
    allowances.list[i].place = static_cast<std::uint32_t>(found - places.begin());
  }
}

Allowances::FileAllowances& Allowances::of(const SourceFile& file) {
  const auto found = files_.find(&file);
  return found != files_.end() ? found->second : files_.emplace(&file, read(file)).first->second;
}

bool Allowances::allow(const DiagnosticInfo& info, Location where) {
  if (where.file == nullptr || info.severity == Severity::Error) return false;
  std::vector<Place>& places = of(*where.file).places;
  const std::uint32_t at = where.span.begin;
  const auto after = std::ranges::upper_bound(
      places, at, {}, [](const Place& place) { return place.statement.begin; });
  auto i =
      after == places.begin() ? kNowhere : static_cast<std::uint32_t>(after - places.begin() - 1);
  bool is_allowed = false;
  for (; i != kNowhere; i = places[i].around) {
    if (places[i].statement.end <= at) continue;
    for (auto& [code, is_used] : places[i].is_used) {
      if (info.code.starts_with(code)) is_allowed = is_used = true;
    }
  }
  return is_allowed;
}

void Allowances::diagnose_unused(const SourceFile& file, DiagnosticSink& sink) {
  const FileAllowances& allowances = of(file);
  for (const Span comment : allowances.malformed) {
    sink.report(diag::bad_allowance, {&file, comment}, "it has the wrong form")
        .help("write `// sdlc: allow(W402) reason`");
  }
  for (const Allowance& allowance : allowances.list) {
    sink.stop_if_requested();
    diagnose_unused(file, allowances, allowance, sink);
  }
}

void Allowances::diagnose_unused(const SourceFile& file, const FileAllowances& allowances,
                                 const Allowance& allowance, DiagnosticSink& sink) {
  const std::string code = code_text(file, allowance.code);
  const Location where{&file, allowance.code};
  if (!is_code(code, Severity::Warning)) {
    if (is_code(code, Severity::Error)) {
      sink.report(diag::bad_allowance, where, fmt::format("`{}` is an error", code))
          .help("errors cannot be allowed: after one there is no picture");
      return;
    }
    std::vector<std::string_view> codes;
    for (const DiagnosticInfo* info : all_diagnostics()) {
      if (info->severity != Severity::Error) codes.push_back(info->code);
    }
    sink.report(diag::bad_allowance, where, fmt::format("no warning has the code `{}`", code))
        .suggest(nearest_name(code, codes));
    return;
  }
  const bool has_place = allowance.place != kNowhere;
  const bool is_used = has_place && allowances.places[allowance.place].is_used.at(code);
  // Only `sdlc convert` reports this one, so here it always looks unused.
  if (is_used || diag::rounded_color.code.starts_with(code)) return;
  auto report = sink.report(diag::unused_allowance, where, code);
  if (!has_place) report.help("there is no statement here");
  const std::string_view text = file.text();
  const auto separates = [&](std::uint32_t at) { return is_blank(text[at]) || text[at] == ','; };
  Span removed = allowance.code;
  if (allowance.count == 1) {
    removed = with_space(text, allowance.comment);
  } else if (allowance.index == 0) {
    while (separates(removed.end)) ++removed.end;
  } else {
    while (separates(removed.begin - 1)) --removed.begin;
  }
  report.unsafe_fix({&file, removed}, "");
}

Findings select_unallowed(const DiagnosticSink& sink, FindingsFilter filter) {
  Allowances allowances(sink.stop_request());
  filter.is_allowed = [&](const DiagnosticInfo& info, Location where) {
    return allowances.allow(info, where);
  };
  return select_findings(sink, filter);
}

}  // namespace sdlc::lang
