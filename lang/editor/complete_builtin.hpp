#pragma once

#include <string_view>

#include "lang/editor/completion_builder.hpp"
#include "lang/editor/expected_type.hpp"

/// The ranks of values, and the values that the language defines.
namespace sdlc::lang {

/// The ranks of values, after named arguments. A value that has the type comes before functions
/// that return it.
enum ValueFit : int { kArgument, kFits, kMakes, kUnknown, kConverts, kWords, kMismatch, kColors };
enum ValueDistance : int { kGlobal = 100, kImport = 200, kLiteral = 250, kBuiltIn = 300 };

/// How well a value of the type is accepted. An empty type is not known.
int fit_of(const ExpectedType& expected, std::string_view type);
/// The fit of a function with this result: one step after that of a value.
int fit_of_result(const ExpectedType& expected, std::string_view result);

/// The words of the property, or the cameras of the scene.
void add_words(CompletionBuilder& builder, const Property& property);
void add_literals(CompletionBuilder& builder, const ExpectedType& expected);
/// Built-in functions, constructors, values, colours, and the words of expressions.
void add_builtins(CompletionBuilder& builder, const ExpectedType& expected);

}  // namespace sdlc::lang
