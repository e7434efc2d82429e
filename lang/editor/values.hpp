#pragma once

#include <cstdint>
#include <string_view>

#include "lang/ast/ast.hpp"
#include "lang/editor/scene_view.hpp"
#include "lang/eval/value_probe.hpp"
#include "lang/object/value.hpp"
#include "lang/resolve/symbol.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::lang {

/// The value of an expression, or the reason why it has none.
struct ComputedValue {
  enum class Status : std::uint8_t {
    Known,
    Wrong,  ///< it has an error
    Local,  ///< it depends on a parameter, a loop or a local value
    TooExpensive,
  };

  Status status = Status::Wrong;
  Value value = {};
  bool reads_time = false;      ///< the value is that at Values::time()
  std::string_view local = {};  ///< of Status::Local: the first such name
};

/// Computes values of a scene. Each takes at most about a millisecond; values that several
/// expressions use are computed once.
class Values {
 public:
  explicit Values(SceneView& view) : view_(view), probe_(view.program()) {}

  /// `property`: the one whose value it is, which may accept a word; may be null.
  ComputedValue of_expression(std::uint32_t file, ast::Node expression,
                              const Property* property = nullptr);
  /// The value of a let or param; Wrong for other symbols.
  ComputedValue of_symbol(SymbolId symbol);
  /// The time of the first frame, in seconds.
  double time() { return probe_.time(); }

 private:
  SceneView& view_;
  ValueProbe probe_;
};

/// The parameter, loop variable or local value that a name in this place reads; null if it reads
/// none, or if the name is a label.
const Symbol* local_at(const SymbolTable& table, const Occurrence& name);

}  // namespace sdlc::lang
