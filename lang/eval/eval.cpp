#include "lang/eval/eval.hpp"

#include "lang/eval/evaluator.hpp"

namespace sdlc::lang {

TimeFreeValues::TimeFreeValues() = default;
TimeFreeValues::~TimeFreeValues() = default;

Evaluation::Evaluation(Program& program, const EvaluationOptions& options, DiagnosticSink& sink)
    : evaluator_(std::make_unique<Evaluator>(program, options, sink)) {}

Evaluation::~Evaluation() = default;

const std::optional<Animation>& Evaluation::animation() const { return evaluator_->animation(); }

void Evaluation::run(ObjectSink& objects) { evaluator_->run(objects); }

std::uint64_t Evaluation::steps() const noexcept { return evaluator_->steps(); }

void evaluate(const Document& file, ObjectSink& objects, DiagnosticSink& sink) {
  Program program(file, {}, sink);
  Evaluation(program, {}, sink).run(objects);
}

}  // namespace sdlc::lang
