#pragma once

#include "grammar/scene.hpp"
#include "lang/syntax/expectation.hpp"

namespace sdlc::lang {

/// What a user is told to have been expected where a committed rule does not match. A rule that is
/// committed to and has no words here does not compile.
template <typename Rule>
inline constexpr Expectation expected = {};

// clang-format off
template <> inline constexpr Expectation expected<grammar::file_header>{"`scene 1`"};
template <> inline constexpr Expectation expected<grammar::file_end>{"a statement"};
template <> inline constexpr Expectation expected<grammar::property_value>{
    "a value after `:`", Wanted::LabeledValue};
template <> inline constexpr Expectation expected<grammar::import_file>{
    "a file name in quotes after `import`", Wanted::FileName};
template <> inline constexpr Expectation expected<grammar::import_as>{"`as` and a name"};
template <> inline constexpr Expectation expected<grammar::import_name>{
    "a name after `as`", Wanted::Name};
template <> inline constexpr Expectation expected<grammar::include_file>{
    "a file name in quotes after `include`", Wanted::FileName};
template <> inline constexpr Expectation expected<grammar::param_name>{
    "a name after `param`", Wanted::Name};
template <> inline constexpr Expectation expected<grammar::param_type>{
    "a type after `:`", Wanted::Type};
template <> inline constexpr Expectation expected<grammar::param_is>{
    "`=` and a default", Wanted::Is};
template <> inline constexpr Expectation expected<grammar::param_default>{"a value after `=`"};
template <> inline constexpr Expectation expected<grammar::let_name>{
    "a name after `let`", Wanted::Name};
template <> inline constexpr Expectation expected<grammar::let_is>{"`=` and a value", Wanted::Is};
template <> inline constexpr Expectation expected<grammar::let_value>{"a value after `=`"};
template <> inline constexpr Expectation expected<grammar::fn_name>{
    "a name after `fn`", Wanted::Name};
template <> inline constexpr Expectation expected<grammar::fn_parameters>{
    "parameters in parentheses"};
template <> inline constexpr Expectation expected<grammar::fn_is>{
    "`=` and an expression", Wanted::FunctionIs};
template <> inline constexpr Expectation expected<grammar::fn_body>{"an expression after `=`"};
template <> inline constexpr Expectation expected<grammar::def_name>{
    "a name after `def`", Wanted::Name};
template <> inline constexpr Expectation expected<grammar::def_parameters>{
    "parameters in parentheses"};
template <> inline constexpr Expectation expected<grammar::def_block>{
    "a block in braces", Wanted::Block};
template <> inline constexpr Expectation expected<grammar::assert_condition>{
    "a condition after `assert`"};
template <> inline constexpr Expectation expected<grammar::assert_comma>{
    "`,` and a message", Wanted::Message};
template <> inline constexpr Expectation expected<grammar::assert_message>{"a message after `,`"};
template <> inline constexpr Expectation expected<grammar::for_name>{
    "a name after `for`", Wanted::Name};
template <> inline constexpr Expectation expected<grammar::for_in>{"`in`", Wanted::In};
template <> inline constexpr Expectation expected<grammar::for_list>{"a list after `in`"};
template <> inline constexpr Expectation expected<grammar::for_block>{
    "a block in braces", Wanted::Block};
template <> inline constexpr Expectation expected<grammar::if_condition>{"a condition after `if`"};
template <> inline constexpr Expectation expected<grammar::if_block>{
    "a block in braces", Wanted::Block};
template <> inline constexpr Expectation expected<grammar::block_end>{"`}`"};
template <> inline constexpr Expectation expected<grammar::parameters_end>{
    "`,` or `)`", Wanted::ParametersEnd};
template <> inline constexpr Expectation expected<grammar::parameter_type>{
    "a type after `:`", Wanted::Type};
template <> inline constexpr Expectation expected<grammar::parameter_default>{"a value after `=`"};
template <> inline constexpr Expectation expected<grammar::arguments_end>{
    "`,` or `)`", Wanted::ArgumentsEnd};
template <> inline constexpr Expectation expected<grammar::argument_value>{
    "a value after `:`", Wanted::LabeledValue};
template <> inline constexpr Expectation expected<grammar::conditional_condition>{
    "a condition after `if`"};
template <> inline constexpr Expectation expected<grammar::conditional_then>{
    "`then` and a value", Wanted::Then};
template <> inline constexpr Expectation expected<grammar::conditional_value>{"a value"};
template <> inline constexpr Expectation expected<grammar::conditional_else>{"`else` and a value"};
template <> inline constexpr Expectation expected<grammar::disjunction_operand>{
    "a value after `or`"};
template <> inline constexpr Expectation expected<grammar::conjunction_operand>{
    "a value after `and`"};
template <> inline constexpr Expectation expected<grammar::negation_operand>{"a value after `not`"};
template <> inline constexpr Expectation expected<grammar::comparison_operand>{
    "a value to compare with"};
template <> inline constexpr Expectation expected<grammar::comparison_end>{
    "one comparison, not a chain", Wanted::SecondOperand};
template <> inline constexpr Expectation expected<grammar::interval_end>{"a value after `..`"};
template <> inline constexpr Expectation expected<grammar::sum_operand>{
    "a value after the operator"};
template <> inline constexpr Expectation expected<grammar::product_operand>{
    "a value after the operator"};
template <> inline constexpr Expectation expected<grammar::unary_operand>{"a value after `-`"};
template <> inline constexpr Expectation expected<grammar::power_exponent>{"a value after `^`"};
template <> inline constexpr Expectation expected<grammar::operand_name>{"a name after `.`"};
template <> inline constexpr Expectation expected<grammar::operand_index_value>{
    "an index after `[`"};
template <> inline constexpr Expectation expected<grammar::operand_index_end>{
    "`]`", Wanted::IndexEnd};
template <> inline constexpr Expectation expected<grammar::path_name>{"a name after `.`"};
template <> inline constexpr Expectation expected<grammar::parenthesis_value>{"a value after `(`"};
template <> inline constexpr Expectation expected<grammar::parenthesis_second>{"a value after `,`"};
template <> inline constexpr Expectation expected<grammar::parenthesis_comma>{
    "`,` and a third value: a point has three"};
template <> inline constexpr Expectation expected<grammar::parenthesis_third>{
    "a third value: a point has three"};
template <> inline constexpr Expectation expected<grammar::parenthesis_end>{
    "`)`", Wanted::GroupEnd};
template <> inline constexpr Expectation expected<grammar::list_end>{"`,` or `]`", Wanted::ListEnd};
template <> inline constexpr Expectation expected<grammar::comment_block_end>{"`*/`"};
// clang-format on

}  // namespace sdlc::lang
