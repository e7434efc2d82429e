#pragma once

#include "grammar/scene.hpp"

namespace sdlc::lang {

/// What a user is told to have been expected where a committed rule does not match. A rule that is
/// committed to and has no words here does not compile.
template <typename Rule>
inline constexpr const char* expected = nullptr;

// clang-format off
template <> inline constexpr auto expected<grammar::file_header> = "`scene 1`";
template <> inline constexpr auto expected<grammar::file_end> = "a statement";
template <> inline constexpr auto expected<grammar::property_value> = "a value after `:`";
template <> inline constexpr auto expected<grammar::import_file> =
    "a file name in quotes after `import`";
template <> inline constexpr auto expected<grammar::import_as> = "`as` and a name";
template <> inline constexpr auto expected<grammar::import_name> = "a name after `as`";
template <> inline constexpr auto expected<grammar::include_file> =
    "a file name in quotes after `include`";
template <> inline constexpr auto expected<grammar::param_name> = "a name after `param`";
template <> inline constexpr auto expected<grammar::param_type> = "a type after `:`";
template <> inline constexpr auto expected<grammar::param_is> = "`=` and a default";
template <> inline constexpr auto expected<grammar::param_default> = "a value after `=`";
template <> inline constexpr auto expected<grammar::let_name> = "a name after `let`";
template <> inline constexpr auto expected<grammar::let_is> = "`=` and a value";
template <> inline constexpr auto expected<grammar::let_value> = "a value after `=`";
template <> inline constexpr auto expected<grammar::fn_name> = "a name after `fn`";
template <> inline constexpr auto expected<grammar::fn_parameters> = "parameters in parentheses";
template <> inline constexpr auto expected<grammar::fn_is> = "`=` and an expression";
template <> inline constexpr auto expected<grammar::fn_body> = "an expression after `=`";
template <> inline constexpr auto expected<grammar::def_name> = "a name after `def`";
template <> inline constexpr auto expected<grammar::def_parameters> = "parameters in parentheses";
template <> inline constexpr auto expected<grammar::def_block> = "a block in braces";
template <> inline constexpr auto expected<grammar::assert_condition> =
    "a condition after `assert`";
template <> inline constexpr auto expected<grammar::assert_comma> = "`,` and a message";
template <> inline constexpr auto expected<grammar::assert_message> = "a message after `,`";
template <> inline constexpr auto expected<grammar::for_name> = "a name after `for`";
template <> inline constexpr auto expected<grammar::for_in> = "`in`";
template <> inline constexpr auto expected<grammar::for_list> = "a list after `in`";
template <> inline constexpr auto expected<grammar::for_block> = "a block in braces";
template <> inline constexpr auto expected<grammar::if_condition> = "a condition after `if`";
template <> inline constexpr auto expected<grammar::if_block> = "a block in braces";
template <> inline constexpr auto expected<grammar::block_end> = "`}`";
template <> inline constexpr auto expected<grammar::parameters_end> = "`,` or `)`";
template <> inline constexpr auto expected<grammar::parameter_type> = "a type after `:`";
template <> inline constexpr auto expected<grammar::parameter_default> = "a value after `=`";
template <> inline constexpr auto expected<grammar::arguments_end> = "`,` or `)`";
template <> inline constexpr auto expected<grammar::argument_value> = "a value after `:`";
template <> inline constexpr auto expected<grammar::conditional_condition> =
    "a condition after `if`";
template <> inline constexpr auto expected<grammar::conditional_then> = "`then` and a value";
template <> inline constexpr auto expected<grammar::conditional_value> = "a value";
template <> inline constexpr auto expected<grammar::conditional_else> = "`else` and a value";
template <> inline constexpr auto expected<grammar::disjunction_operand> = "a value after `or`";
template <> inline constexpr auto expected<grammar::conjunction_operand> = "a value after `and`";
template <> inline constexpr auto expected<grammar::negation_operand> = "a value after `not`";
template <> inline constexpr auto expected<grammar::comparison_operand> = "a value to compare with";
template <> inline constexpr auto expected<grammar::comparison_end> = "one comparison, not a chain";
template <> inline constexpr auto expected<grammar::interval_end> = "a value after `..`";
template <> inline constexpr auto expected<grammar::sum_operand> = "a value after the operator";
template <> inline constexpr auto expected<grammar::product_operand> = "a value after the operator";
template <> inline constexpr auto expected<grammar::unary_operand> = "a value after `-`";
template <> inline constexpr auto expected<grammar::power_exponent> = "a value after `^`";
template <> inline constexpr auto expected<grammar::operand_name> = "a name after `.`";
template <> inline constexpr auto expected<grammar::operand_index_value> = "an index after `[`";
template <> inline constexpr auto expected<grammar::operand_index_end> = "`]`";
template <> inline constexpr auto expected<grammar::path_name> = "a name after `.`";
template <> inline constexpr auto expected<grammar::parenthesis_value> = "a value after `(`";
template <> inline constexpr auto expected<grammar::parenthesis_second> = "a value after `,`";
template <> inline constexpr auto expected<grammar::parenthesis_comma> =
    "`,` and a third value: a point has three";
template <> inline constexpr auto expected<grammar::parenthesis_third> =
    "a third value: a point has three";
template <> inline constexpr auto expected<grammar::parenthesis_end> = "`)`";
template <> inline constexpr auto expected<grammar::list_end> = "`,` or `]`";
template <> inline constexpr auto expected<grammar::comment_block_end> = "`*/`";
// clang-format on

}  // namespace sdlc::lang
