#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/object.hpp"
#include "lang/program/program.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// The `animation` of the root: frames first, first + step, … up to last.
struct Animation {
  int first = 0, last = 0, step = 1;
  double fps = 24;
  Location where;  ///< of the word `animation`
};

/// The values of the top level that do not depend on the time, for the other frames of a program
/// with the same settings. Empty until an evaluation has found them without a diagnostic.
class TimeFreeValues {
 public:
  TimeFreeValues();
  ~TimeFreeValues();
  TimeFreeValues(const TimeFreeValues&) = delete;
  TimeFreeValues& operator=(const TimeFreeValues&) = delete;

 private:
  friend class Evaluator;
  struct Content;
  std::unique_ptr<Content> content_;
};

struct EvaluationOptions {
  std::optional<int> frame = {};            ///< default: the first of the animation
  std::optional<std::string> camera = {};   ///< overrides `camera` of `render`
  std::optional<std::uint64_t> steps = {};  ///< overrides the program's limit
  TimeFreeValues* time_free = nullptr;      ///< used and filled; may be null
};

/// The evaluation of a program at one frame, with the shutter of one camera. It passes checked
/// objects to an ObjectSink: first those that only the root may have (cameras, background, render,
/// animation), then all others in the order of execution. Errors are reported; an object with
/// errors is passed with its correct properties. The shutter of a camera is passed in absolute
/// times. The sink must outlive the evaluation; its chain is that of the evaluation until then.
class Evaluation {
 public:
  Evaluation(Program& program, const EvaluationOptions& options, DiagnosticSink& sink);
  ~Evaluation();

  const std::optional<Animation>& animation() const;
  void run(ObjectSink& objects);
  /// The steps taken (see limits.hpp), less those that spheres add to the limit.
  std::uint64_t steps() const noexcept;

 private:
  std::unique_ptr<class Evaluator> evaluator_;
};

/// Parses and evaluates a file without imports and includes.
void evaluate(const Document& file, ObjectSink& objects, DiagnosticSink& sink);

}  // namespace sdlc::lang
