#include "lang/lint/lint.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "lang/allowances/allowances.hpp"
#include "lang/lint/context.hpp"
#include "lang/lint/rules.hpp"

namespace sdlc::lang {
namespace {

/// The rule and the place of a finding. Files are compared by name, because a text may be read
/// twice.
auto place_of(const Finding& finding) {
  const auto& [file, span] = finding.place.where;
  return std::tuple(finding.info, file == nullptr ? std::string_view() : file->name(), span.begin,
                    span.end);
}

/// Identifies a finding across frames. The place is not enough: a loop makes many spheres.
auto identity_of(const Finding& finding) {
  return std::tuple_cat(place_of(finding), std::tuple(finding.place.sphere, finding.message));
}

/// A frame during the shutter interval of a camera.
struct View {
  int frame;
  std::optional<std::string> camera;  ///< nullopt for the one that the file chooses
};

using Rules = std::set<const DiagnosticInfo*>;

class Linter {
 public:
  Linter(Compiler& compiler, const Document& file, DiagnosticSink& sink)
      : compiler_(compiler), file_(file), sink_(sink) {}

  void run() {
    compiler_.check([&](const LoweredScene& lowered) { check_frame(lowered); });
    if (sink_.has_errors()) return;
    confirm_pending();
    for (const Finding& found : pending_) report(found);
    if (is_picture_) diagnose_unused_allowances();
  }

 private:
  void check_frame(const LoweredScene& lowered) {
    const Program* program = compiler_.program();
    const SyntaxTree* tree = program == nullptr ? nullptr : &program->module(Program::kRoot).tree;
    LintContext context(file_, tree, compiler_, lowered);
    is_picture_ = is_picture_ || !context.is_part();
    max_spheres_ = std::max<std::uint64_t>(max_spheres_, context.spheres().size());
    const bool is_first = frames_++ == 0;
    if (is_first) remember_cameras(lowered);
    Rules of_every_frame;
    for (const Rule& rule : all_rules()) {
      if (rule.scope == RuleScope::Text && (!is_first || tree == nullptr)) continue;
      if (rule.scope == RuleScope::EveryFrame) of_every_frame.insert(rule.info);
      context.stop_if_requested();
      rule.check(context);
    }
    std::vector<Finding> to_confirm;
    for (Finding& found : locate(context)) {
      if (of_every_frame.contains(found.info)) {
        to_confirm.push_back(std::move(found));
      } else {
        report(found);
      }
    }
    if (is_first) {
      pending_ = std::move(to_confirm);
    } else {
      keep_pending(to_confirm);
    }
  }

  void diagnose_unused_allowances() {
    if (!sink_.not_kept().empty()) return;  // one of them may need the allowance
    for (const Diagnostic& found : sink_.diagnostics()) allowances_.allow(*found.info, found.where);
    allowances_.diagnose_unused(file_, sink_);
  }

  /// Remembers the cameras that may be chosen, if their shutters differ.
  void remember_cameras(const LoweredScene& lowered) {
    const auto& cameras = lowered.checked_cameras;
    const bool is_one_shutter =
        cameras.size() < 2 || std::ranges::none_of(cameras, [](const CheckedCamera& camera) {
          return camera.shutter.has_value();
        });
    if (is_one_shutter) return;
    for (const CheckedCamera& camera : cameras) {
      if (!camera.name.empty()) cameras_.emplace_back(camera.name);
    }
  }

  /// The views that have not been checked; nullopt if there are too many. A view costs 10 to 20
  /// microseconds per sphere, and at least as much as kMinCost spheres.
  std::optional<std::vector<View>> other_views() {
    constexpr std::uint64_t kMaxSpheres = 250'000, kMinCost = 100;
    const Animation film = compiler_.animation().value_or(Animation{});
    const std::uint64_t frames =
        static_cast<std::uint64_t>((std::int64_t{film.last} - film.first) / film.step) + 1;
    const std::uint64_t cameras = std::max<std::size_t>(cameras_.size(), 1);
    if (frames * cameras > kMaxSpheres / std::max(max_spheres_, kMinCost)) {
      const bool is_complete = frames <= 2 && cameras_.empty();
      return is_complete ? std::optional(std::vector<View>()) : std::nullopt;
    }
    std::vector<View> views;
    for (std::uint64_t i = 0; i < frames; ++i) {
      const int frame = film.first + static_cast<int>(i) * film.step;
      for (const std::string& camera : cameras_) views.push_back({frame, camera});
      const bool is_checked = i == 0 || i + 1 == frames;
      if (cameras_.empty() && !is_checked) views.push_back({frame, {}});
    }
    return views;
  }

  /// The pending findings hold in the first and the last frame for the chosen camera. Keeps those
  /// that hold in all frames and for every camera. Errors in those frames are not reported.
  void confirm_pending() {
    if (pending_.empty()) return;
    const std::optional<std::vector<View>> views = other_views();
    if (!views) return drop_pending();
    if (views->empty()) return;

    constexpr std::uint64_t kMaxSteps = 200'000'000;  // of all views together: two seconds
    ProgramOptions options = compiler_.options();
    options.limits.steps = std::min(options.limits.steps, kMaxSteps / views->size());
    DiagnosticSink ignored(sink_.stop_request());
    Compiler compiler(file_, options, ignored);
    const bool is_film = compiler.animation().has_value();
    for (const View& view : *views) {
      const auto frame = is_film ? std::optional(view.frame) : std::nullopt;
      const LoweredScene lowered = compiler.check_view(frame, view.camera);
      if (ignored.has_errors()) return drop_pending();
      recheck_pending(compiler, lowered);
      if (pending_.empty()) return;
    }
  }

  /// Drops findings that cannot be confirmed. Their allowances count as used, because the findings
  /// may be correct.
  void drop_pending() {
    for (const Finding& found : pending_) {
      allowances_.allow(*found.info, found.place.where);
    }
    pending_.clear();
  }

  /// Runs the rules of the pending findings in another view.
  void recheck_pending(Compiler& compiler, const LoweredScene& lowered) {
    Rules rules;
    for (const Finding& found : pending_) rules.insert(found.info);
    const Program* program = compiler.program();
    LintContext context(file_, &program->module(Program::kRoot).tree, compiler, lowered);
    for (const Rule& rule : all_rules()) {
      if (rules.contains(rule.info)) rule.check(context);
    }
    keep_pending(locate(context));
  }

  /// Locates the spheres of all findings in one evaluation.
  static std::vector<Finding> locate(LintContext& context) {
    std::vector<Finding> findings = context.take_findings();
    std::vector<std::uint32_t> spheres;
    const auto for_each_place = [](Finding& finding, auto function) {
      function(finding.place);
      for (Finding::PlaceLabel& label : finding.labels) function(label.place);
    };
    for (Finding& finding : findings) {
      for_each_place(finding, [&](const LintPlace& place) {
        if (place.part != LintPlace::Text) spheres.push_back(place.sphere);
      });
    }
    const SphereOrigins origins(context, std::move(spheres));

    for (Finding& finding : findings) {
      if (finding.place.part != LintPlace::Text) {
        finding.chain = origins.of(finding.place.sphere).chain;
      }
      for_each_place(finding, [&](LintPlace& place) {
        if (place.part == LintPlace::Sphere) place.where = origins.of(place.sphere).where;
        if (place.part == LintPlace::Material) place.where = origins.of(place.sphere).material;
      });
    }
    return findings;
  }

  /// Keeps the pending findings that are in `found`.
  void keep_pending(const std::vector<Finding>& found) {
    std::set<decltype(identity_of(std::declval<Finding>()))> identities;
    for (const Finding& one : found) identities.insert(identity_of(one));
    std::erase_if(pending_,
                  [&](const Finding& one) { return !identities.contains(identity_of(one)); });
  }

  void report(const Finding& found) {
    // Report each rule once per place, even if the numbers differ.
    if (!reported_.insert(place_of(found)).second) return;
    Diagnostic diagnostic{.info = found.info,
                          .where = found.place.where,
                          .message = found.message,
                          .labels = {},
                          .help = found.help,
                          .fixes = found.fixes,
                          .suggestion = {},
                          .chain = found.chain};
    for (const Finding::PlaceLabel& label : found.labels) {
      diagnostic.labels.push_back({label.place.where, label.message});
    }
    sink_.add(diagnostic);
  }

  Compiler& compiler_;
  const Document& file_;
  DiagnosticSink& sink_;
  Allowances allowances_{sink_.stop_request()};
  std::vector<Finding> pending_;  // of rules that must hold in every frame
  std::set<decltype(place_of(std::declval<Finding>()))> reported_;
  std::vector<std::string> cameras_;  // see remember_cameras()
  std::uint64_t max_spheres_ = 0;     // of a frame
  int frames_ = 0;
  bool is_picture_ = false;
};

}  // namespace

void lint(Compiler& compiler, const Document& file, DiagnosticSink& sink) {
  Linter(compiler, file, sink).run();
}

}  // namespace sdlc::lang
