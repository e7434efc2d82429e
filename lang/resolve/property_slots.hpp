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

/// The properties that an object can have, and the values that it gives them.
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
    bool is_guess = false;  ///< its name is misspelt
  };

  std::string_view kind;
  SymbolId def;  ///< of an instance: what declares its parameters
  std::vector<Name> names;
  std::vector<Given> given;
  std::vector<std::uint32_t> others;  ///< expressions of no known property
  bool is_broken = false;             ///< names may be missing that could not be read

  void reset(std::string_view kind);
  void add(const Property& property) { add(property, property.name); }
  /// The property under this name; under none if it cannot be written.
  void add(const Property& property, std::string_view name);
  void add_parameter(const Parameter& parameter);
  /// names.size() if there is none.
  std::size_t index_of(std::string_view name) const;
  /// Pushes the pairs [property, expression] of the properties from `first` on, which are counted
  /// from there, and those of no known property.
  void push_to(CodeBuilder& code, std::size_t first) const;
};

}  // namespace sdlc::lang
