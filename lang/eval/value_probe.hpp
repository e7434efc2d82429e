#pragma once

#include <cstdint>
#include <memory>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/value.hpp"
#include "lang/program/program.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::lang {

/// A value that an editor asks for.
struct ProbedValue {
  Value value = {};         ///< Nothing: it has an error, or it is too expensive
  bool reads_time = false;  ///< it is the value at ValueProbe::time()
  bool is_too_expensive = false;
};

/// Evaluates single values of a program's top level, with those that they use and nothing else.
/// Errors are not reported.
class ValueProbe {
 public:
  /// About a millisecond.
  static constexpr std::uint64_t kSteps = 100'000;

  /// `max_steps`: the limit of each request (see limits.hpp). `stop` may be null.
  explicit ValueProbe(Program& program, std::uint64_t max_steps = kSteps,
                      const StopRequest* stop = nullptr);
  ~ValueProbe();

  /// The value of the index in Module::globals.
  ProbedValue global(std::uint32_t module, std::uint32_t global);
  /// The value of an expression of the module that uses no locals. Its names must be known.
  /// `property`: the one whose value it is, which may accept a word; may be null.
  ProbedValue expression(std::uint32_t module, ast::Node expression,
                         const Property* property = nullptr);
  /// The time of the first frame, in seconds.
  double time();

 private:
  std::unique_ptr<class SingleValues> values_;
};

}  // namespace sdlc::lang
