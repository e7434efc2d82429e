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

/// A finding whose places are known.
struct Found {
  Finding finding;
  std::vector<ChainLink> chain;
};

/// The place of a finding. Files are told apart by their names: a text may be read twice.
auto place_of(const Finding& finding) {
  const auto& [file, span] = finding.place.where;
  return std::tuple(finding.info, file == nullptr ? std::string_view() : file->name(), span.begin,
                    span.end);
}

/// What is the same finding in another frame: a loop has many spheres of one place.
auto identity_of(const Finding& finding) {
  return std::tuple_cat(place_of(finding), std::tuple(finding.place.sphere, finding.message));
}

/// A frame while the shutter of a camera is open; nothing: of the one that the file chooses.
struct View {
  int frame;
  std::optional<std::string> camera;
};

using Rules = std::set<const DiagnosticInfo*>;

class Linter {
 public:
  Linter(Compiler& compiler, const Document& file, DiagnosticSink& sink)
      : compiler_(compiler), file_(file), sink_(sink) {}

  void run() {
    compiler_.check([&](const LoweredScene& lowered) { look(lowered); });
    if (sink_.has_errors()) return;
    confirm_held();
    compiler_.publish_dependencies();  // confirm_held() may have read fewer files
    for (const Found& found : held_) report(found);
    if (is_picture_) diagnose_unused_allowances();
  }

 private:
  void look(const LoweredScene& lowered) {
    const Program* program = compiler_.program();
    const SyntaxTree* tree = program == nullptr ? nullptr : &program->module(Program::kRoot).tree;
    LintContext context(file_, tree, compiler_, lowered);
    is_picture_ = is_picture_ || !context.is_part();
    most_spheres_ = std::max<std::uint64_t>(most_spheres_, context.spheres().size());
    const bool is_first = frames_++ == 0;
    if (is_first) remember_cameras(lowered);
    Rules held;
    for (const Rule& rule : all_rules()) {
      if (rule.scope == RuleScope::Text && (!is_first || tree == nullptr)) continue;
      if (rule.scope == RuleScope::EveryFrame) held.insert(rule.info);
      context.stop_if_requested();
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
    if (is_first) {
      held_ = std::move(kept);
    } else {
      keep(kept);
    }
  }

  void diagnose_unused_allowances() {
    if (!sink_.not_kept().empty()) return;  // one of these may need the allowance
    for (const Diagnostic& found : sink_.diagnostics()) allowances_.allow(*found.info, found.where);
    allowances_.diagnose_unused(file_, sink_);
  }

  /// Those that may be chosen, where it matters which one is: the shutter that is open is its.
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

  /// The views that have not been looked at; nothing where they are too many to look at all: each
  /// costs its spheres, 10 to 20 microseconds one, and something to begin with.
  std::optional<std::vector<View>> other_views() {
    constexpr std::uint64_t kMostSpheres = 250'000, kLeastOfView = 100;
    const Animation film = compiler_.animation().value_or(Animation{});
    const std::uint64_t frames =
        static_cast<std::uint64_t>((std::int64_t{film.last} - film.first) / film.step) + 1;
    const std::uint64_t cameras = std::max<std::size_t>(cameras_.size(), 1);
    if (frames * cameras > kMostSpheres / std::max(most_spheres_, kLeastOfView)) {
      const bool is_all_seen = frames <= 2 && cameras_.empty();
      return is_all_seen ? std::optional(std::vector<View>()) : std::nullopt;
    }
    std::vector<View> views;
    for (std::uint64_t i = 0; i < frames; ++i) {
      const int frame = film.first + static_cast<int>(i) * film.step;
      for (const std::string& camera : cameras_) views.push_back({frame, camera});
      const bool is_seen = i == 0 || i + 1 == frames;
      if (cameras_.empty() && !is_seen) views.push_back({frame, {}});
    }
    return views;
  }

  /// Of what is so in the first and the last frame as the chosen camera sees them, keeps what is so
  /// in all frames, whichever camera is chosen. What is wrong in those frames is not told.
  void confirm_held() {
    if (held_.empty()) return;
    const std::optional<std::vector<View>> views = other_views();
    if (!views) return drop_held();
    if (views->empty()) return;

    constexpr std::uint64_t kMostSteps = 200'000'000;  // of all views together: two seconds
    ProgramOptions options = compiler_.options();
    options.limits.steps = std::min(options.limits.steps, kMostSteps / views->size());
    DiagnosticSink ignored(sink_.stop_request());
    Compiler compiler(file_, options, ignored);
    const bool is_film = compiler.animation().has_value();
    for (const View& view : *views) {
      const auto frame = is_film ? std::optional(view.frame) : std::nullopt;
      const LoweredScene lowered = compiler.check_view(frame, view.camera);
      if (ignored.has_errors()) return drop_held();
      look_again(compiler, lowered);
      if (held_.empty()) return;
    }
  }

  /// Forgets what cannot be confirmed. That is no proof that a comment allows it without need.
  void drop_held() {
    for (const Found& found : held_) {
      allowances_.allow(*found.finding.info, found.finding.place.where);
    }
    held_.clear();
  }

  /// Asks the rules that found something whether it is there in another view.
  void look_again(Compiler& compiler, const LoweredScene& lowered) {
    Rules rules;
    for (const Found& found : held_) rules.insert(found.finding.info);
    const Program* program = compiler.program();
    LintContext context(file_, &program->module(Program::kRoot).tree, compiler, lowered);
    for (const Rule& rule : all_rules()) {
      if (rules.contains(rule.info)) rule.check(context);
    }
    keep(locate(context));
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

  /// Keeps what was found here too.
  void keep(const std::vector<Found>& found) {
    std::set<decltype(identity_of(std::declval<Finding>()))> now;
    for (const Found& one : found) now.insert(identity_of(one.finding));
    std::erase_if(held_, [&](const Found& one) { return !now.contains(identity_of(one.finding)); });
  }

  void report(const Found& found) {
    // Of one place and rule one finding is enough, whatever the numbers are.
    if (!told_.insert(place_of(found.finding)).second) return;
    auto report =
        sink_.report_as(*found.finding.info, found.finding.place.where, found.finding.message);
    for (const Finding::PlaceLabel& label : found.finding.labels) {
      report.label(label.place.where, label.message);
    }
    for (const std::string& help : found.finding.help) report.help(help);
    for (const Fix& fix : found.finding.fixes) {
      if (fix.is_safe) {
        report.fix(fix.where, fix.replacement);
      } else {
        report.unsafe_fix(fix.where, fix.replacement);
      }
    }
    report.chain(found.chain);
  }

  Compiler& compiler_;
  const Document& file_;
  DiagnosticSink& sink_;
  Allowances allowances_;
  std::vector<Found> held_;  // in each view looked at
  std::set<decltype(place_of(std::declval<Finding>()))> told_;
  std::vector<std::string> cameras_;  // where it matters which one is chosen
  std::uint64_t most_spheres_ = 0;    // of a frame
  int frames_ = 0;
  bool is_picture_ = false;
};

}  // namespace

void lint(Compiler& compiler, const Document& file, DiagnosticSink& sink) {
  // All warnings must be known before an allowance is found to be unused.
  constexpr std::size_t kMaxFindings = 100'000;
  sink.set_max_kept(kMaxFindings);
  Linter(compiler, file, sink).run();
}

}  // namespace sdlc::lang
