#include "lang/eval/evaluator.hpp"

#include <algorithm>
#include <tuple>

#include "lang/resolve/resolver.hpp"
#include "lang/schema/find_kind.hpp"

// The phases of an evaluation. The animation gives `time` and the chosen camera the times of the
// shutter, so both are evaluated first, with the globals that they may use.
namespace sdlc::lang {
namespace {

constexpr std::uint64_t kMaxSteps = std::uint64_t{1} << 62;

bool is_declaration(SyntaxKind kind) noexcept {
  return kind == SyntaxKind::Let || kind == SyntaxKind::Param || kind == SyntaxKind::Fn ||
         kind == SyntaxKind::Def || kind == SyntaxKind::Import || kind == SyntaxKind::Version ||
         kind == SyntaxKind::Error;
}

/// Mutes a sink for its own lifetime.
class MuteScope {
 public:
  explicit MuteScope(DiagnosticSink& sink) : sink_(sink) { sink_.set_muted(true); }
  ~MuteScope() { sink_.set_muted(false); }
  MuteScope(const MuteScope&) = delete;
  MuteScope& operator=(const MuteScope&) = delete;

 private:
  DiagnosticSink& sink_;
};

}  // namespace

Evaluator::Evaluator(Program& program, const EvaluationOptions& options, DiagnosticSink& sink,
                     OnDemand /*on_demand*/)
    : program_(program),
      options_(options),
      sink_(sink),
      chain_(sink, *this),
      max_steps_(std::min(options.steps.value_or(program.limits().steps), kMaxSteps)) {}

Evaluator::Evaluator(Program& program, const EvaluationOptions& options, DiagnosticSink& sink)
    : Evaluator(program, options, sink, OnDemand{}) {
  find_settings();
  evaluate_or_take_time_free_globals();
  find_animation();
  if (animation_) {
    const double time = options_.frame.value_or(animation_->first) / animation_->fps;
    times_ = {time, time};
  }
  // The shutter is evaluated at the frame's own time, for which other globals may be undefined:
  // mute their errors.
  const auto before = std::tuple(steps_, max_steps_, has_given_up_);
  {
    const MuteScope muted(sink_);
    evaluate_all_globals(Globals::TimeDependent);
  }
  std::tie(steps_, max_steps_, has_given_up_) = before;  // the second run reports exceeded limits
  find_shutter();
  evaluate_all_globals(Globals::TimeDependent);
  check_defaults();
}

void Evaluator::run(ObjectSink& objects) {
  objects_ = &objects;
  run_settings();
  run_file(Program::kRoot);
}

/// Whether the statement is an object that only the top level of the root may have.
bool Evaluator::is_setting(const Module& file, ast::Node statement) {
  if (!statement.is(SyntaxKind::Object)) return false;
  const std::string_view name = ast::Object{statement}.kind();
  const Kind* kind = find_kind(name);
  return !file.def_names.contains(name) && kind != nullptr && kind->is_setting;
}

void Evaluator::run_file(std::uint32_t module) {
  Module& file = program_.module_at(module);
  Code code(file.tree);
  Resolver resolver(program_, module, sink_);
  for (const ast::Node statement : ast::Node(file.tree, 0).children()) {
    if (is_declaration(statement.kind())) continue;
    const bool is_ignored = is_setting(file, statement);
    if (is_ignored && module == Program::kRoot) continue;  // see run_settings()
    code.clear();
    const std::uint32_t index = resolver.resolve_statement(statement, code);
    if (index == kNothing || is_ignored) continue;  // settings of included files are only checked
    check_defaults(code);
    const Frame frame(*this, code, statement.index(), code.frame_size);
    if (!frame.is_open()) return;
    run(code, index);
  }
  file.is_resolved = true;
}

}  // namespace sdlc::lang
