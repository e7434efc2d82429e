#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "lang/code/code.hpp"
#include "lang/code/code_builder.hpp"
#include "lang/resolve/module.hpp"
#include "lang/resolve/symbol.hpp"
#include "lang/schema/schema.hpp"
#include "lang/source/source.hpp"
#include "lang/value/types.hpp"

namespace sdlc::lang {

/// The properties that an object accepts, and the values that it has.
struct PropertySlots {
  struct Name {
    std::string_view name;
    const Property* property;  ///< of a built-in kind
    const TypeInfo* type;      ///< of a parameter that declares one
    NodeIndex parameter;       ///< of a def: its declaration
  };
  struct Given {
    std::uint32_t value = kNothing;  ///< expression
    Span span = {};                  ///< of the value
    bool is_written = false;
    bool is_guess = false;  ///< given under a misspelt name or by a misplaced statement
  };

  std::string_view kind;
  SymbolId def;  ///< of an instance
  std::vector<Name> names;
  std::vector<Given> given;
  std::vector<std::uint32_t> others;  ///< expressions of unknown properties
  bool is_broken = false;             ///< names may be missing because of an error

  void reset(std::string_view kind);
  void add(const Property& property) { add(property, property.name); }
  /// The property under this name; empty: it cannot be written.
  void add(const Property& property, std::string_view name);
  void add_parameter(const Parameter& parameter);
  /// names.size() if there is none.
  std::size_t index_of(std::string_view name) const;
  /// Pushes a pair [property, expression] for each value from property `first` on, numbered from
  /// there, and [kNothing, expression] for each unknown property.
  void push_to(CodeBuilder& code, std::size_t first) const;
};

}  // namespace sdlc::lang
