#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/eval/eval.hpp"
#include "lang/eval/instance_memo.hpp"
#include "lang/object/counted_bytes.hpp"
#include "lang/object/object.hpp"
#include "lang/object/value.hpp"
#include "lang/program/program.hpp"
#include "lang/schema/schema.hpp"
#include "lang/value/constructors.hpp"

namespace sdlc::lang {

/// Runs code. Expressions recur as deep as the tree, which the parser limits, and into user-defined
/// functions and kinds, which kMaxCalls limits.
class Evaluator final : public ChainSource {
 public:
  Evaluator(Program& program, const EvaluationOptions& options, DiagnosticSink& sink);
  ~Evaluator() override;

  const std::optional<Animation>& animation() const { return animation_; }
  void run(ObjectSink& objects);
  /// Steps beyond those that spheres allow for.
  std::uint64_t steps() const noexcept;

  std::vector<ChainLink> chain() const override;

 private:
  /// A value at the opening and, where the time matters and the shutter is open, at the closing.
  struct Varying {
    std::array<Value, 2> values = {};
    bool reads_time = false;  ///< depends on the time
    bool varies = false;      ///< and the shutter is open: the second value is set
  };

  /// A step into what is being evaluated.
  struct Step {
    enum Kind : std::uint8_t { Turn, Call, Instance, Group, Include } kind;
    const Code* code;
    NodeIndex node;          ///< the statement or call
    std::string_view name;   ///< of the function or kind, or the loop's variable
    std::size_t local = 0;   ///< of a Turn: index of the variable
    std::uint64_t turn = 0;  ///< from 0
  };
  class Nested;

  /// A camera, background, render or animation of the root.
  struct Setting {
    const Kind* kind;
    ast::Object node;
  };

  // Phases
  void find_settings();
  void find_animation();
  void find_shutter();
  std::optional<std::string> chosen_camera();
  Code resolve(const Setting& setting);
  Value setting_value(const Setting& setting, std::size_t property);
  enum class Globals : std::uint8_t { TimeFree, TimeDependent };
  void evaluate_globals(std::uint32_t module, Globals which);
  void evaluate_all_globals(Globals which);
  Varying evaluate_global(std::uint32_t module, std::uint32_t index);
  /// The value of --set if there is one, else the param's.
  Varying with_setting(std::uint32_t index, Varying value);
  void run_settings();
  void run_file(std::uint32_t module);

  // Statements
  void run(const Code& code, std::uint32_t statement);
  void run_block(const Code& code, std::span<const std::uint32_t> statements);
  void run_for(const Code& code, const Statement& statement);
  void run_if(const Code& code, const Statement& statement);
  void run_assert(const Code& code, const Statement& statement);
  void run_group(const Code& code, const Statement& statement);
  void run_instance(const Code& code, const Statement& statement);
  /// Takes the steps of placing object_, a group.
  void take_rotation();
  /// The key of the contents of an instance among those of its def. Its arguments are in the frame
  /// from `base`. nullopt: the contents are not memoized.
  std::optional<std::string> identify_contents(InstanceMemo::Def def, std::size_t base,
                                               std::span<const std::uint32_t> arguments) const;
  void run_include(const Code& code, const Statement& statement);
  /// Whether the file includes itself through others, which is reported.
  bool is_in_circle(const Code& code, const Statement& statement, std::uint32_t file);
  void run_object(const Code& code, const Statement& statement);
  /// Fills object_ from pairs of property and expression.
  void read_object(const Code& code, const Statement& statement, const Kind& kind,
                   std::span<const std::uint32_t> pairs);
  void read_changing(const Code& code, std::size_t property, std::uint32_t expression);
  Varying evaluate_over_shutter(const Code& code, std::uint32_t expression);
  /// Limits the use of the stack by nested expressions and statements; false, once reported, if it
  /// is exceeded.
  bool may_nest(const Code& code, NodeIndex node);

  // Expressions
  Value evaluate(const Code& code, std::uint32_t expression);
  /// Fast path for numbers, which stay in registers: the value if it is a number; else kNoNumber,
  /// with the value in `other`.
  Scalar evaluate_number(const Code& code, std::uint32_t expression, Value& other);
  Scalar evaluate_chain(const Code& code, const Expression& e, Value& other);
  Value evaluate_operation(const Code& code, const Expression& e);
  Value evaluate_power(const Code& code, const Expression& e);
  Value combine(const Code& code, const Value& left, std::uint32_t left_index, const Value& right,
                std::uint32_t right_index);
  Value evaluate_triple(const Code& code, const Expression& e);
  Value evaluate_interval(const Code& code, const Expression& e);
  Value evaluate_list(const Code& code, const Expression& e);
  Value evaluate_logic(const Code& code, const Expression& e);
  Value evaluate_conditional(const Code& code, const Expression& e);
  Value evaluate_member(const Code& code, const Expression& e);
  Value evaluate_index(const Code& code, const Expression& e);
  Value evaluate_function(const Code& code, const Expression& e);
  Value evaluate_builtin(const Code& code, const Expression& e);
  Value evaluate_constructor(const Code& code, const Expression& e);
  std::optional<bool> evaluate_condition(const Code& code, std::uint32_t expression,
                                         std::string_view word);
  const Value& read(const Varying& variable);
  void check_defaults();
  void check_default(const Module& file, const Parameter& parameter);
  /// The value if it has the declared type; else Nothing, once reported.
  Value check_type(const Module& module, std::string_view name, const TypeInfo* type,
                   NodeIndex declaration, Value value, Location where);
  /// Errors and warnings that have been told so far.
  std::size_t report_count() const { return sink_.error_count() + sink_.warning_count(); }
  /// Counts steps; false, once reported, when there are too many, or the values take too much
  /// memory. Then nothing more is evaluated.
  bool take_steps(const Code& code, NodeIndex node, std::uint64_t count);
  /// Throws StopRequested if the sink says so.
  void poll();
  /// Ends the evaluation; false if it has ended before.
  bool give_up();
  /// Whether values may take this many more bytes; if not, that is reported.
  bool may_take_memory(const Code& code, NodeIndex node, std::uint64_t bytes);
  /// Appends a frame: the index of its first slot, or nullopt, once reported.
  std::optional<std::size_t> open_frame(const Code& code, NodeIndex node, std::size_t slots);
  /// Allows the steps of so many spheres or instances.
  void allow_steps(std::uint64_t spheres);
  /// Whether one more call or instance may be nested in the current ones; if not, that has been
  /// reported.
  bool may_call(const Code& code, NodeIndex node);
  void end_call();

  // Properties
  /// The value in the place of a property or argument: of its type and in its range, or Nothing.
  Value property_value(const Code& code, const Property& property, std::uint32_t expression);
  /// The same of a property that must not depend on the time.
  Value timeless_value(const Code& code, const Property& property, std::uint32_t expression);

  ast::Node node(const Code& code, std::uint32_t expression) const {
    return {*code.tree, code.expressions[expression].node};
  }
  Location place(const Code& code, std::uint32_t expression) const {
    return node(code, expression).location();
  }

  Program& program_;
  const EvaluationOptions options_;
  DiagnosticSink& sink_;
  ObjectSink* objects_ = nullptr;

  std::optional<Animation> animation_;
  std::vector<Setting> settings_;
  std::map<std::string_view, Location> unique_, cameras_;

  std::array<double, 2> times_{0, 0};  // at the opening and the closing, seconds
  bool is_open_ = false;               // the shutter is: they may differ
  std::optional<render::Interval> shutter_;
  std::size_t moment_ = 0;          // index of the current one
  bool reads_time_ = false;         // set by whatever depends on the time
  bool center_reads_time_ = false;  // of the sphere being read

  std::vector<std::vector<Varying>> globals_;      // by module
  std::array<std::vector<bool>, 2> globals_done_;  // by Globals and module
  std::vector<Varying> locals_;
  std::size_t frame_ = 0;  // index of the first slot of the current frame

  InstanceMemo memo_;
  std::vector<Step> steps_inside_;
  Object object_;  // the one being read
  int depth_ = 0;
  int calls_ = 0;
  int deepest_calls_ = 0;  // the maximum of calls_ in the current instance
  bool has_called_too_deep_ = false;
  std::vector<std::uint32_t> files_inside_;  // includes being run, the innermost last
  std::unordered_set<std::uint32_t> included_;

  std::uint64_t steps_ = 0, allowed_steps_ = 0;
  std::uint64_t max_steps_;      // with those allowed for spheres
  std::uint64_t next_poll_ = 0;  // when steps_ is so many, look whether a stop was requested
  bool has_given_up_ = false;
  CountedBytes locals_bytes_;
};

/// Pushes a step for its own lifetime.
class Evaluator::Nested {
 public:
  Nested(Evaluator& evaluator, const Step& step) : evaluator_(evaluator) {
    evaluator_.steps_inside_.push_back(step);
  }
  ~Nested() { evaluator_.steps_inside_.pop_back(); }
  Nested(const Nested&) = delete;
  Nested& operator=(const Nested&) = delete;

 private:
  Evaluator& evaluator_;
};

}  // namespace sdlc::lang
