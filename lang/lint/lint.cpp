#include "lang/lint/lint.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "lang/lint/context.hpp"
#include "lang/lint/rules.hpp"

namespace sdlc::lang {
namespace {

/// A finding whose places are known.
struct Found {
  Finding finding;
  std::vector<ChainLink> chain;
};

/// What tells one finding from another.
auto key_of(const Finding& finding) {
  const Location& where = finding.place.where;
  return std::tuple(finding.info, where.file, where.span.begin, where.span.end);
}

class Linter {
 public:
  Linter(Compiler& compiler, const SourceFile& file, DiagnosticSink& sink)
      : compiler_(compiler), file_(file), sink_(sink) {}

  void run() {
    compiler_.check([&](const LoweredScene& lowered) { look(lowered); });
    if (sink_.has_errors()) return;
    report_held();
    if (is_picture_) compiler_.allowances().diagnose_unused(file_, sink_);
  }

 private:
  void look(const LoweredScene& lowered) {
    const Program* program = compiler_.program();
    const SyntaxTree* tree = program == nullptr ? nullptr : &program->module(Program::kRoot).tree;
    LintContext context(file_, tree, compiler_, lowered);
    is_picture_ = is_picture_ || !context.is_part();
    const bool is_first = frames_++ == 0;
    std::set<const DiagnosticInfo*> held;
    for (const Rule& rule : all_rules()) {
      if (rule.scope == RuleScope::Text && (!is_first || tree == nullptr)) continue;
      if (rule.scope == RuleScope::EveryFrame) held.insert(rule.info);
      rule.check(context);
    }
    std::vector<Found> kept;
    for (Found& found : locate(context)) {
      if (held.contains(found.finding.info)) {
        kept.push_back(std::move(found));
      } else {
        report(found);
      }
    }
    keep(std::move(kept), is_first);
  }

  /// Finds where the spheres of all findings come from, at once.
  static std::vector<Found> locate(LintContext& context) {
    std::vector<Finding> findings = context.take_findings();
    std::vector<std::uint32_t> wanted;
    const auto for_each_place = [](Finding& finding, auto function) {
      function(finding.place);
      for (Finding::PlaceLabel& label : finding.labels) function(label.place);
    };
    for (Finding& finding : findings) {
      for_each_place(finding, [&](const LintPlace& place) {
        if (place.part != LintPlace::Text) wanted.push_back(place.sphere);
      });
    }
    std::ranges::sort(wanted);
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    const std::vector<Origin> origins =
        wanted.empty() ? std::vector<Origin>() : context.trace(wanted);
    const auto origin = [&](std::uint32_t sphere) -> const Origin& {
      return origins[static_cast<std::size_t>(std::ranges::lower_bound(wanted, sphere) -
                                              wanted.begin())];
    };

    std::vector<Found> all;
    for (Finding& finding : findings) {
      std::vector<ChainLink> chain;
      if (finding.place.part != LintPlace::Text) chain = origin(finding.place.sphere).chain;
      for_each_place(finding, [&](LintPlace& place) {
        if (place.part == LintPlace::Sphere) place.where = origin(place.sphere).where;
        if (place.part == LintPlace::Material) place.where = origin(place.sphere).material;
      });
      all.push_back({std::move(finding), std::move(chain)});
    }
    return all;
  }

  /// Keeps what was found in each frame so far.
  void keep(std::vector<Found> found, bool is_first) {
    if (is_first) {
      held_ = std::move(found);
      return;
    }
    std::set<decltype(key_of(std::declval<Finding>()))> now;
    for (const Found& one : found) now.insert(key_of(one.finding));
    std::erase_if(held_, [&](const Found& one) { return !now.contains(key_of(one.finding)); });
  }

  void report_held() {
    for (const Found& found : held_) report(found);
  }

  void report(const Found& found) {
    // Of one place and rule one finding is enough, whatever the numbers are.
    if (!told_.insert(key_of(found.finding)).second) return;
    auto report =
        sink_.report_as(*found.finding.info, found.finding.place.where, found.finding.message);
    for (const Finding::PlaceLabel& label : found.finding.labels) {
      report.label(label.place.where, label.message);
    }
    for (const std::string& help : found.finding.help) report.help(help);
    for (const Fix& fix : found.finding.fixes) {
      fix.is_safe ? report.fix(fix.where, fix.replacement)
                  : report.unsafe_fix(fix.where, fix.replacement);
    }
    report.chain(found.chain);
  }

  Compiler& compiler_;
  const SourceFile& file_;
  DiagnosticSink& sink_;
  std::vector<Found> held_;  // in each frame looked at
  std::set<decltype(key_of(std::declval<Finding>()))> told_;
  int frames_ = 0;
  bool is_picture_ = false;
};

}  // namespace

void lint(Compiler& compiler, const SourceFile& file, DiagnosticSink& sink) {
  Linter(compiler, file, sink).run();
}

}  // namespace sdlc::lang
