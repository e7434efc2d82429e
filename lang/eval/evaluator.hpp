#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/eval/eval.hpp"
#include "lang/eval/instance_memo.hpp"
#include "lang/eval/stack_segments.hpp"
#include "lang/object/counted_bytes.hpp"
#include "lang/object/object.hpp"
#include "lang/object/value.hpp"
#include "lang/program/program.hpp"
#include "lang/schema/schema.hpp"
#include "lang/source/limits.hpp"
#include "lang/value/builtins.hpp"
#include "lang/value/constructors.hpp"

namespace sdlc::lang {

/// Runs code. Recursion is as deep as the tree, which the parser limits, times the nesting of calls
/// and instances, which Limits::calls limits. The machine's stack goes on in memory for values: see
/// StackSegments.
///
/// evaluator.cpp has the phases of an evaluation, settings.cpp the objects that only the root may
/// have, globals.cpp the values of the top level; statements.cpp, instances.cpp and includes.cpp
/// run statements; expressions.cpp, aggregates.cpp, loops.cpp and calls.cpp compute values;
/// properties.cpp checks them; evaluation_limits.cpp counts work and memory.
class Evaluator final : public ChainSource {
 public:
  Evaluator(Program& program, const EvaluationOptions& options, DiagnosticSink& sink);
  /// Evaluates nothing: for SingleValues.
  struct OnDemand {};
  Evaluator(Program& program, const EvaluationOptions& options, DiagnosticSink& sink,
            OnDemand on_demand);

  const std::optional<Animation>& animation() const { return animation_; }
  void run(ObjectSink& objects);
  /// The steps taken, less those that spheres add to the limit.
  std::uint64_t steps() const noexcept;

  std::vector<ChainLink> chain() const override;

 private:
  friend class SingleValues;
  friend struct TimeFreeValues::Content;

  /// A value at the opening of the shutter and, if it varies, at the closing.
  struct Varying {
    std::array<Value, 2> values = {};
    bool reads_time = false;
    bool varies = false;  ///< it reads the time and the shutter is open: values[1] is set
  };

  /// An entry of the call stack, which labels of diagnostics show.
  struct StackEntry {
    enum Kind : std::uint8_t { Iteration, Call, Instance, Group, Include } kind;
    const Code* code;
    NodeIndex node;               ///< the statement or call
    std::string_view name = {};   ///< of the function, kind or group
    std::size_t local = 0;        ///< of an Iteration: index of its first name in locals_
    std::uint64_t iteration = 0;  ///< from 0
  };
  class Nested;
  class Frame;
  /// The frame around that of a local fn or def, and those around it.
  struct Environment {
    std::size_t frame;
    const Environment* outer;
  };
  /// A call of a fn or an instance of a def: what is called, and from where it sees names.
  struct Callee {
    const Code& code;
    const Definition& definition;
    const Environment* environment;
  };
  /// Sets the chain of a sink for its own lifetime.
  class ChainScope {
   public:
    ChainScope(DiagnosticSink& sink, const ChainSource& chain) : sink_(sink) {
      sink_.set_chain(&chain);
    }
    ~ChainScope() { sink_.set_chain(nullptr); }
    ChainScope(const ChainScope&) = delete;
    ChainScope& operator=(const ChainScope&) = delete;

   private:
    DiagnosticSink& sink_;
  };

  /// An instance of a def that is being placed.
  struct DefInstance {
    const Code& code;  ///< of the instance statement
    NodeIndex node;
    Callee callee;
    std::span<const std::uint32_t> arguments;  ///< expressions; kNothing: the default
    std::size_t base;                          ///< first slot of its frame
  };

  /// A camera, background, render or animation of the root.
  struct Setting {
    const Kind* kind;
    ast::Object node;
  };

  ChainLink link_of(const StackEntry& entry) const;

  // Phases
  /// Collects the settings of the root; reports duplicates.
  void find_settings();
  /// Sets animation_ if the root has an animation.
  void find_animation();
  /// Sets the times of the shutter if the chosen camera has one.
  void find_shutter();
  std::optional<std::string> chosen_camera();
  /// The code of a setting, with its frame opened.
  Code resolve(const Setting& setting);
  /// The value of one property; Nothing if it is not written.
  Value setting_value(const Setting& setting, std::size_t property);
  enum class Globals : std::uint8_t { TimeFree, TimeDependent };
  /// Evaluates the globals of a module, after those of its imports, unless that is done.
  void evaluate_globals(std::uint32_t module, Globals which);
  void evaluate_all_globals(Globals which);
  /// Those that do not depend on the time, or what another frame has kept of them.
  void evaluate_or_take_time_free_globals();
  Varying evaluate_global(std::uint32_t module, std::uint32_t index);
  /// The value of --set if there is one, else `value`, that of the declaration.
  Varying with_setting(std::uint32_t index, Varying value);
  void run_settings();
  /// Runs the statements of a file other than declarations and, in the root, settings.
  void run_file(std::uint32_t module);
  static bool is_setting(const Module& file, ast::Node statement);

  // Statements
  void run(const Code& code, std::uint32_t statement);
  void run_block(const Code& code, std::span<const std::uint32_t> statements);
  void run_for(const Code& code, const Statement& statement);
  /// The loop of a For or ForClause.
  struct Loop {
    const Code& code;
    NodeIndex node;
    LoopSlots names;
    std::uint32_t list;  ///< expression
    const ListValue& opening;
    const ListValue* closing = nullptr;  ///< of the shutter; null: the elements do not vary
    bool reads_time = false;
  };
  /// Gives the names of a loop their values for element i; false if it cannot be destructured.
  bool bind_names(const Loop& loop, std::size_t i);
  bool report_wrong_parts(const Loop& loop, const Value& element);
  void run_if(const Code& code, const Statement& statement);
  void run_assert(const Code& code, const Statement& statement);
  void run_group(const Code& code, const Statement& statement);
  void report_not_a_list(const Code& code, std::uint32_t expression, const Value& value);
  void run_instance(const Code& code, const Statement& statement);
  /// Adds the contents to the sink, inside object_, the group of the instance.
  void place_instance(const DefInstance& instance);
  /// Returns the depth of calls and instances that it reached, this one included.
  std::uint64_t run_contents(const DefInstance& instance);
  /// Evaluates argument i, an expression of `from`, into the frame; false if it has failed.
  bool bind_argument(const DefInstance& instance, std::size_t i, const Code& from,
                     std::uint32_t expression);
  /// Takes the steps of rotating object_, a group.
  void take_rotation();
  /// The key of the contents of an instance among those of its def, whose arguments are in the
  /// frame. nullopt: the contents are not memoized.
  std::optional<std::string> identify_contents(const DefInstance& instance) const;
  void run_include(const Code& code, const Statement& statement);
  /// Whether the file includes itself through others, which is reported.
  bool is_include_cycle(const Code& code, const Statement& statement, std::uint32_t file);
  void run_object(const Code& code, const Statement& statement);
  /// Spheres of radius 0 take no memory: a loop of them would never reach a limit if they added
  /// steps.
  static bool is_visible_sphere(const Object& object);
  /// Fills object_ from pairs of property and expression.
  void read_object(const Code& code, const Statement& statement, const Kind& kind,
                   std::span<const std::uint32_t> pairs);
  /// Evaluates a property at the closing of the shutter too. A changed value goes to
  /// object_.closing if the property may change; otherwise this warns.
  void read_changing(const Code& code, std::size_t property, std::uint32_t expression);
  Varying evaluate_over_shutter(const Code& code, std::uint32_t expression);
  void run_action(const Code& code, const Statement& statement);
  /// Calls the function on a new segment of the stack. If there is no memory for it, this is
  /// reported, and the evaluation ends.
  template <typename Function>
  void run_on_segment(const Code& code, NodeIndex node, Function&& function, std::size_t bytes = 0);

  // Expressions
  Value evaluate(const Code& code, std::uint32_t expression);
  /// A Scalar that is no number: no value has this unit.
  static constexpr Scalar kNoNumber{0, static_cast<Unit>(0xFF)};
  static bool is_number(Scalar scalar) noexcept { return scalar.unit != kNoNumber.unit; }
  static Scalar combine_numbers(Scalar a, Operator op, Scalar b) noexcept;
  /// Fast path for numbers, which stay in registers: the value if it is a number; else kNoNumber,
  /// with the value in `other`.
  Scalar evaluate_number(const Code& code, std::uint32_t expression, Value& other);
  /// A Sum or Product; the result is as that of evaluate_number().
  Scalar evaluate_chain(const Code& code, const Expression& e, Value& other);
  Value evaluate_operation(const Code& code, const Expression& e);
  Value evaluate_power(const Code& code, const Expression& e);
  /// `left op right` of any types: arithmetic, or strings or lists joined by `+`.
  Value combine(const Code& code, const Value& left, std::uint32_t left_index, const Value& right,
                std::uint32_t right_index);
  Value join(const Code& code, const ListValue& left, const ListValue& right,
             std::uint32_t right_index);
  Value evaluate_triple(const Code& code, const Expression& e);
  Value evaluate_interval(const Code& code, const Expression& e);
  Value evaluate_list(const Code& code, const Expression& e);
  /// Reports the rows of a list that are not like those before.
  void report_uneven_rows(const Code& code, const Expression& e, const ListValue& rows);
  /// Row i, which is not like `other`.
  void report_uneven_row(const Code& code, const Expression& e, const ListValue& rows,
                         std::size_t other, std::size_t i);
  Location place_of_element(const Code& code, std::uint32_t list, std::size_t i) const;
  /// A column as written: `.name`, or `["name"]` if `member` is empty.
  struct ColumnName {
    std::string_view name;
    Span where;   ///< of the name
    Span member;  ///< of the dot and the name
  };
  /// The cell of a row of a data file.
  Value column_of(const Code& code, const ListValue& row, const ColumnName& column);
  Value evaluate_comprehension(const Code& code, const Expression& e);
  struct Comprehension;
  /// Runs the clauses from `first` on, nested in those before. False if the list has failed.
  bool run_clauses(Comprehension& list, std::size_t first);
  bool run_for_clause(Comprehension& list, std::size_t index);
  bool add_element(Comprehension& list);
  bool add_value(Comprehension& list, Value value);
  /// Reports that the value cannot be an element beside those before; false.
  bool report_mixed_element(const Comprehension& list, const Value& value);
  /// Room for `count` more elements in a vector of the list.
  template <typename T>
  bool make_room(Comprehension& list, std::vector<T>& elements, std::size_t count);
  Value evaluate_logic(const Code& code, const Expression& e);
  Value evaluate_conditional(const Code& code, const Expression& e);
  Value evaluate_let_in(const Code& code, const Expression& e);
  Value evaluate_member(const Code& code, const Expression& e);
  Value evaluate_index(const Code& code, const Expression& e);
  /// The element of a list at a position; else Nothing, which is reported at `written`.
  Value element_at(const ListValue& list, const Value& position, ast::Node written);
  Value elements_at(const Code& code, const Expression& e, const ListValue& list,
                    const ListValue& positions);
  Value evaluate_function(const Code& code, const Expression& e);
  /// `operands`: those of the call or instance. `here`: the current frame and its environment.
  Callee callee_of(const Code& code, const Expression& e, const Environment& here) const;
  Callee callee_of(const Code& code, const Statement& statement, const Environment& here) const;
  static const Environment* environment_of(const Environment& here, std::uint32_t outwards);
  Value evaluate_builtin(const Code& code, const Expression& e);
  /// Reads the options of a call; false if one is wrong.
  bool read_options(const Code& code, const Builtin& builtin,
                    std::span<const std::uint32_t> operands, std::span<Value> options);
  Value run_builtin(const Code& code, const BuiltinCall& call);
  Value evaluate_constructor(const Code& code, const Expression& e);
  /// nullopt if the value is no bool, which is reported; `word`: "if", "and", …
  std::optional<bool> evaluate_condition(const Code& code, std::uint32_t expression,
                                         std::string_view word);
  const Value& read(const Varying& variable);
  const Varying& outer_local(const Environment* environment, std::uint32_t outwards,
                             std::uint32_t slot) const;
  void check_defaults();
  void check_defaults(const Code& code);
  void check_default(const Code& code, const Parameter& parameter);
  /// The value if it has the declared type; else Nothing, which is reported.
  Value check_type(const Code& code, std::string_view name, const TypeInfo* type,
                   NodeIndex declaration, Value value, Location where);
  /// Errors and warnings so far.
  std::size_t report_count() const { return sink_.error_count() + sink_.warning_count(); }
  /// The steps of reading all of a value.
  static std::uint64_t steps_to_read(const Value& value) noexcept;
  /// The steps of comparing its type with another: those of reading a row, 0 for other values.
  static std::uint64_t steps_to_compare(const Value& value) noexcept {
    const auto* row = get_if<RowValue>(&value);
    return row != nullptr ? row->elements.weight() : 0;
  }
  /// Counts steps. If there are too many, or the values take too much memory, this is reported and
  /// the evaluation ends: false.
  bool take_steps(const Code& code, NodeIndex node, std::uint64_t count);
  /// Throws StopRequested if the sink says so.
  void poll();
  /// Ends the evaluation; false if it has ended before.
  bool give_up();
  /// Whether values may take this many more bytes; if not, this is reported and the evaluation
  /// ends.
  bool may_take_memory(const Code& code, NodeIndex node, std::uint64_t bytes);
  /// Appends a frame to locals_: the index of its first slot; nullopt if memory is exceeded.
  std::optional<std::size_t> open_frame(const Code& code, NodeIndex node, std::size_t slots);
  /// Raises the limit on steps for this many spheres or instances.
  void allow_steps(std::uint64_t spheres);
  /// Whether one more call or instance may be nested in the current ones; if not, that is reported
  /// once per outermost call.
  bool may_call(const Code& code, NodeIndex node);
  void end_call();

  // Properties
  /// The value of a property or argument, of its type and in its range; else Nothing, which is
  /// reported.
  Value property_value(const Code& code, const Property& property, std::uint32_t expression);
  /// The same for a property that must not depend on the time.
  Value timeless_value(const Code& code, const Property& property, std::uint32_t expression);

  ast::Node node(const Code& code, std::uint32_t expression) const {
    return {*code.tree, code.expressions[expression].node};
  }
  Location place(const Code& code, std::uint32_t expression) const {
    return node(code, expression).location();
  }
  static Location location(const Code& code, NodeIndex node) {
    return ast::Node(*code.tree, node).location();
  }

  Program& program_;
  const EvaluationOptions options_;
  DiagnosticSink& sink_;
  ChainScope chain_;
  ObjectSink* objects_ = nullptr;

  std::optional<Animation> animation_;
  std::vector<Setting> settings_;

  std::array<double, 2> times_{0, 0};  // at the opening and the closing, seconds
  bool is_open_ = false;               // the chosen camera has a shutter: the times may differ
  std::optional<render::Interval> shutter_;
  std::size_t moment_ = 0;          // index of the current time
  bool reads_time_ = false;         // set by every expression that depends on the time
  bool center_reads_time_ = false;  // of the current sphere

  std::vector<std::vector<Varying>> globals_;      // by module
  std::array<std::vector<bool>, 2> globals_done_;  // by Globals and module
  std::vector<Varying> locals_;
  std::size_t frame_ = 0;                     // index of the first slot of the current frame
  const Environment* environment_ = nullptr;  // of a local fn or def: what is around its frame

  InstanceMemo memo_;
  std::vector<StackEntry> stack_;
  Object object_;  // the current one; reused
  std::uint64_t calls_ = 0;
  std::uint64_t deepest_calls_ = 0;  // the maximum of calls_ in the current instance
  bool has_called_too_deep_ = false;
  std::vector<std::uint32_t> open_includes_;  // the innermost last
  std::unordered_set<std::uint32_t> included_;

  std::uint64_t steps_ = 0, allowed_steps_ = 0;
  std::uint64_t max_steps_;      // with those that spheres add
  std::uint64_t next_poll_ = 0;  // steps_ at which a requested stop is checked next
  bool has_given_up_ = false;
  /// Spheres have allowed no steps, since there are errors: broken ones, which are dropped, would
  /// never reach a limit. With too few steps the evaluation then ends in silence.
  bool is_allowance_withheld_ = false;
  CountedBytes locals_bytes_;
};

/// A frame of locals, the current one during its own lifetime.
class Evaluator::Frame {
 public:
  Frame(Evaluator& evaluator, const Code& code, NodeIndex node, std::size_t slots)
      : evaluator_(evaluator), base_(evaluator.open_frame(code, node, slots)) {
    if (base_) outer_ = std::exchange(evaluator.frame_, *base_);
  }
  ~Frame() {
    if (!base_) return;
    evaluator_.locals_.resize(*base_);
    evaluator_.frame_ = outer_;
  }
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;
  /// False if memory is exceeded, which is reported.
  bool is_open() const noexcept { return base_.has_value(); }

 private:
  Evaluator& evaluator_;
  std::optional<std::size_t> base_;
  std::size_t outer_ = 0;
};

template <typename Function>
void Evaluator::run_on_segment(const Code& code, NodeIndex node, Function&& function,
                               std::size_t bytes) {
  constexpr std::uint64_t kTooMuch = std::numeric_limits<std::uint64_t>::max();
  if (!StackSegments::run(function, bytes)) may_take_memory(code, node, kTooMuch);
}

/// Pushes an entry for its own lifetime.
class Evaluator::Nested {
 public:
  Nested(Evaluator& evaluator, const StackEntry& entry) : evaluator_(evaluator) {
    evaluator_.stack_.push_back(entry);
  }
  ~Nested() { evaluator_.stack_.pop_back(); }
  Nested(const Nested&) = delete;
  Nested& operator=(const Nested&) = delete;

 private:
  Evaluator& evaluator_;
};

struct TimeFreeValues::Content {
  std::vector<std::vector<Evaluator::Varying>> globals;  // by module
  std::vector<bool> done;
  std::uint64_t steps;
};

}  // namespace sdlc::lang
