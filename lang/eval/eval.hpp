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

/// The frames of a film, as the root's `animation` gives them.
struct Animation {
  int first = 0, last = 0, step = 1;
  double fps = 24;
  Location where;  ///< of the statement
};

struct EvaluationOptions {
  std::optional<int> frame = {};            ///< default: the first of the animation
  std::optional<std::string> camera = {};   ///< overrides the choice of the file
  std::optional<std::uint64_t> steps = {};  ///< overrides the program's limit
};

/// One evaluation of a program: at one frame, with one shutter. Every object goes to an ObjectSink,
/// its properties checked: first the cameras, the background and the settings, then the rest in the
/// order of the file. What is wrong is reported; an object with a mistake in it is passed too, with
/// its correct properties. A camera's shutter is passed in absolute times.
class Evaluation {
 public:
  Evaluation(Program& program, const EvaluationOptions& options, DiagnosticSink& sink);
  ~Evaluation();

  const std::optional<Animation>& animation() const;
  void run(ObjectSink& objects);
  /// Steps taken beyond those that spheres allow for.
  std::uint64_t steps() const noexcept;

 private:
  std::unique_ptr<class Evaluator> evaluator_;
};

/// Reads and evaluates a file that needs no other files.
void evaluate(const Document& file, ObjectSink& objects, DiagnosticSink& sink);

}  // namespace sdlc::lang
