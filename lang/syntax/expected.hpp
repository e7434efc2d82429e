#pragma once

#include "grammar/scene.hpp"
#include "lang/syntax/expectation.hpp"

namespace sdlc::lang {

/// The words for what a committed rule expected, and their kind. A committed rule without words
/// does not compile.
template <typename Rule>
inline constexpr Expectation expected = {};

#define SDLC_EXPECTED(rule, ...) \
  template <>                    \
  inline constexpr Expectation expected<grammar::rule>{__VA_ARGS__};

// clang-format off
SDLC_EXPECTED(file_header, "`scene 1`")
SDLC_EXPECTED(file_end, "a statement")
SDLC_EXPECTED(property_value, "a value after `:`", Wanted::LabeledValue)
SDLC_EXPECTED(import_file, "a file name in quotes after `import`", Wanted::FileName)
SDLC_EXPECTED(import_as, "`as` and a name")
SDLC_EXPECTED(import_name, "a name after `as`", Wanted::Name)
SDLC_EXPECTED(include_file, "a file name in quotes after `include`", Wanted::FileName)
SDLC_EXPECTED(param_name, "a name after `param`", Wanted::Name)
SDLC_EXPECTED(param_type, "a type after `:`", Wanted::Type)
SDLC_EXPECTED(param_is, "`=` and a default", Wanted::Is)
SDLC_EXPECTED(param_default, "a value after `=`")
SDLC_EXPECTED(let_name, "a name after `let`", Wanted::Name)
SDLC_EXPECTED(let_is, "`=` and a value", Wanted::Is)
SDLC_EXPECTED(let_value, "a value after `=`")
SDLC_EXPECTED(fn_name, "a name after `fn`", Wanted::Name)
SDLC_EXPECTED(fn_parameters, "parameters in parentheses")
SDLC_EXPECTED(fn_is, "`=` and an expression", Wanted::FunctionIs)
SDLC_EXPECTED(fn_body, "an expression after `=`")
SDLC_EXPECTED(def_name, "a name after `def`", Wanted::Name)
SDLC_EXPECTED(def_parameters, "parameters in parentheses")
SDLC_EXPECTED(def_block, "a block in braces", Wanted::Block)
SDLC_EXPECTED(assert_condition, "a condition after `assert`")
SDLC_EXPECTED(assert_comma, "`,` and a message", Wanted::Message)
SDLC_EXPECTED(assert_message, "a message after `,`")
SDLC_EXPECTED(for_pattern, "a name after `for`", Wanted::Name)
SDLC_EXPECTED(for_in, "`in`", Wanted::In)
SDLC_EXPECTED(for_list, "a list after `in`")
SDLC_EXPECTED(for_block, "a block in braces", Wanted::LoopBlock)
SDLC_EXPECTED(pattern_name, "a name", Wanted::Name)
SDLC_EXPECTED(pattern_comma, "`,` and a second name", Wanted::SecondName)
SDLC_EXPECTED(pattern_end, "`,` or `)`", Wanted::PatternEnd)
SDLC_EXPECTED(pattern_second, "a name after `,`", Wanted::Name)
SDLC_EXPECTED(if_condition, "a condition after `if`")
SDLC_EXPECTED(if_block, "a block in braces", Wanted::Block)
SDLC_EXPECTED(block_end, "`}`")
SDLC_EXPECTED(parameters_end, "`,` or `)`", Wanted::ParametersEnd)
SDLC_EXPECTED(parameter_type, "a type after `:`", Wanted::Type)
SDLC_EXPECTED(parameter_default, "a value after `=`")
SDLC_EXPECTED(arguments_end, "`,` or `)`", Wanted::ArgumentsEnd)
SDLC_EXPECTED(argument_value, "a value after `:`", Wanted::LabeledValue)
SDLC_EXPECTED(conditional_condition, "a condition after `if`")
SDLC_EXPECTED(conditional_then, "`then` and a value", Wanted::Then)
SDLC_EXPECTED(conditional_value, "a value")
SDLC_EXPECTED(conditional_else, "`else` and a value")
SDLC_EXPECTED(let_in_binding, "a name and its value", Wanted::Name)
SDLC_EXPECTED(let_in_in, "`in` and a value", Wanted::LetIn)
SDLC_EXPECTED(let_in_value, "a value after `in`")
SDLC_EXPECTED(binding_is, "`=` and a value", Wanted::Is)
SDLC_EXPECTED(binding_value, "a value after `=`")
SDLC_EXPECTED(disjunction_operand, "a value after `or`")
SDLC_EXPECTED(conjunction_operand, "a value after `and`")
SDLC_EXPECTED(negation_operand, "a value after `not`")
SDLC_EXPECTED(comparison_operand, "a value to compare with")
SDLC_EXPECTED(comparison_end, "one comparison, not a chain", Wanted::SecondOperand)
SDLC_EXPECTED(interval_end, "a value after `..`")
SDLC_EXPECTED(sum_operand, "a value after the operator")
SDLC_EXPECTED(product_operand, "a value after the operator")
SDLC_EXPECTED(unary_operand, "a value after `-`")
SDLC_EXPECTED(power_exponent, "a value after `^`")
SDLC_EXPECTED(operand_name, "a name after `.`")
SDLC_EXPECTED(operand_index_value, "an index after `[`")
SDLC_EXPECTED(operand_index_end, "`]`", Wanted::IndexEnd)
SDLC_EXPECTED(path_name, "a name after `.`")
SDLC_EXPECTED(parenthesis_value, "a value after `(`")
SDLC_EXPECTED(parenthesis_second, "a value after `,`")
SDLC_EXPECTED(parenthesis_comma, "`,` and a third value: a point has three")
SDLC_EXPECTED(parenthesis_third, "a third value: a point has three")
SDLC_EXPECTED(parenthesis_end, "`)`", Wanted::GroupEnd)
SDLC_EXPECTED(list_end, "`,` or `]`", Wanted::ListEnd)
SDLC_EXPECTED(list_clauses_end, "`for`, `if` or `]`", Wanted::ClausesEnd)
SDLC_EXPECTED(for_clause_list, "a list after `in`")
SDLC_EXPECTED(if_clause_condition, "a condition after `if`")
SDLC_EXPECTED(comment_block_end, "`*/`")
// clang-format on

#undef SDLC_EXPECTED

}  // namespace sdlc::lang
