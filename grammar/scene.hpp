#pragma once

#include <tao/pegtl.hpp>

#include "grammar/scene_tokens.hpp"

/// The scene language as PEGTL rules, without actions: scene.ebnf, rule by rule, with the same
/// names in the same order. The lexical rules (from `literal` on) are in scene_tokens.hpp. A rule
/// that is not in the EBNF is a part of the one whose name it begins with: a token, a commit point
/// (the operand of `must`: whoever parses with this grammar owes its user the words for it), or the
/// inside of a bracket.
///
/// A syntactic rule consumes the space after it; a lexical one does not, and `token` makes a
/// syntactic one of it. All recursion goes through a rule of `nesting` at the end of this file:
/// whoever limits the depth of those has limited the depth of all.
namespace sdlc::grammar {

using tao::pegtl::eof;

struct statement;
struct import_;
struct include;
struct param;
struct let;
struct fn;
struct def;
struct assert_;
struct for_;
struct pattern;
struct if_;
struct object;
struct block;
struct type;
struct parameters;
struct parameter;
struct arguments;
struct argument;
struct expression;
struct conditional;
struct let_in;
struct binding;
struct disjunction;
struct conjunction;
struct negation;
struct comparison;
struct compare;
struct interval;
struct sum;
struct product;
struct unary;
struct power;
struct operand;
struct reference;
struct path;
struct parenthesis;
struct list;
struct for_clause;
struct if_clause;

/// A lexical rule with the space after it.
template <typename Rule>
struct token : seq<Rule, space> {};
template <char... C>
struct mark : seq<one<C>..., space> {};

// clang-format off
struct and_word     : token<word<'a', 'n', 'd'>> {};
struct as_word      : token<word<'a', 's'>> {};
struct assert_word  : token<word<'a', 's', 's', 'e', 'r', 't'>> {};
struct def_word     : token<word<'d', 'e', 'f'>> {};
struct else_word    : token<word<'e', 'l', 's', 'e'>> {};
struct fn_word      : token<word<'f', 'n'>> {};
struct for_word     : token<word<'f', 'o', 'r'>> {};
struct if_word      : token<word<'i', 'f'>> {};
struct import_word  : token<word<'i', 'm', 'p', 'o', 'r', 't'>> {};
struct in_word      : token<word<'i', 'n'>> {};
struct include_word : token<word<'i', 'n', 'c', 'l', 'u', 'd', 'e'>> {};
struct let_word     : token<word<'l', 'e', 't'>> {};
struct not_word     : token<word<'n', 'o', 't'>> {};
struct or_word      : token<word<'o', 'r'>> {};
struct param_word   : token<word<'p', 'a', 'r', 'a', 'm'>> {};
struct scene_word   : token<word<'s', 'c', 'e', 'n', 'e'>> {};
struct then_word    : token<word<'t', 'h', 'e', 'n'>> {};

// A file and its statements

struct version;
struct file_header : seq<scene_word, token<version>> {};
struct file_end    : eof {};
struct file        : seq<opt<tao::pegtl::utf8::bom>, space, must<file_header>, star<statement>,
                         must<file_end>> {};

struct version : seq<plus<digit>, not_at<sor<idchar, one<'.'>>>> {};

// A look at the first letter, here and below, settles what would take many comparisons.
struct property;
struct statement_word : seq<at<one<'a', 'd', 'f', 'i', 'l', 'p'>>,
                            sor<import_, include, param, let, fn, def, assert_, for_, if_>> {};
struct statement      : seq<sor<property, statement_word, object>, opt<mark<','>>> {};

struct property_head  : seq<token<label>, mark<':'>> {};
struct property_value : seq<expression> {};
struct property       : seq<property_head, must<property_value>> {};

struct import_file : token<string> {};
struct import_as   : seq<as_word> {};
struct import_name : token<name> {};
struct import_     : seq<import_word, must<import_file, import_as, import_name>> {};

struct include_file : token<string> {};
struct include      : seq<include_word, must<include_file>> {};

struct param_name    : token<name> {};
struct param_type    : seq<type> {};
struct param_is      : mark<'='> {};
struct param_default : seq<expression> {};
struct param         : seq<param_word, must<param_name>, opt<mark<':'>, must<param_type>>,
                           must<param_is, param_default>> {};

struct let_name  : token<name> {};
struct let_is    : mark<'='> {};
struct let_value : seq<expression> {};
struct let       : seq<let_word, must<let_name, let_is, let_value>> {};

struct fn_name       : token<name> {};
struct fn_parameters : seq<parameters> {};
struct fn_is         : mark<'='> {};
struct fn_body       : seq<expression> {};
struct fn            : seq<fn_word, must<fn_name, fn_parameters, fn_is, fn_body>> {};

struct def_name       : token<name> {};
struct def_parameters : seq<parameters> {};
struct def_block      : seq<block> {};
struct def            : seq<def_word, must<def_name, def_parameters, def_block>> {};

struct assert_condition : seq<expression> {};
struct assert_comma     : mark<','> {};
struct assert_message   : seq<expression> {};
struct assert_          : seq<assert_word, must<assert_condition, assert_comma, assert_message>> {};

struct for_pattern : seq<pattern> {};
struct for_in      : seq<in_word> {};
struct for_list    : seq<expression> {};
struct for_block   : seq<block> {};
struct for_        : seq<for_word, must<for_pattern, for_in, for_list, for_block>> {};

struct pattern_name   : token<name> {};
struct pattern_comma  : mark<','> {};
struct pattern_end    : mark<')'> {};
struct pattern_inside : seq<must<pattern_name, pattern_comma, pattern_name>,
                            star<mark<','>, pattern_name>, opt<mark<','>>, must<pattern_end>> {};
struct pattern_row    : seq<mark<'('>, pattern_inside> {};
struct pattern_second : sor<pattern_row, pattern_name> {};
struct pattern        : sor<pattern_row, seq<pattern_name, opt<mark<','>, must<pattern_second>>>> {};

struct if_condition : seq<expression> {};
struct if_block     : seq<block> {};
struct if_          : seq<if_word, must<if_condition, if_block>,
                          star<else_word, if_word, must<if_condition, if_block>>,
                          opt<else_word, must<if_block>>> {};

struct block_inside;
struct object_name  : token<name> {};
struct object_block : seq<mark<'{'>, block_inside> {};
struct object       : seq<path, opt<object_name>, object_block> {};

struct block_end    : mark<'}'> {};
struct block_inside : seq<star<statement>, must<block_end>> {};
struct block        : seq<mark<'{'>, block_inside> {};

struct type : token<name> {};

struct parameters_end    : mark<')'> {};
struct parameters_inside : seq<opt<parameter, star<mark<','>, parameter>, opt<mark<','>>>,
                               must<parameters_end>> {};
struct parameters        : seq<mark<'('>, parameters_inside> {};

struct parameter_name    : token<name> {};
struct parameter_type    : seq<type> {};
struct parameter_default : seq<expression> {};
struct parameter         : seq<parameter_name, opt<mark<':'>, must<parameter_type>>,
                               opt<mark<'='>, must<parameter_default>>> {};

struct arguments_end    : mark<')'> {};
struct arguments_inside : seq<opt<argument, star<mark<','>, argument>, opt<mark<','>>>,
                              must<arguments_end>> {};
struct arguments        : seq<mark<'('>, arguments_inside> {};

struct argument_head    : seq<token<label>, mark<':'>> {};
struct argument_value   : seq<expression> {};
struct argument_labeled : seq<argument_head, must<argument_value>> {};
struct argument         : sor<argument_labeled, expression> {};

// Expressions, loosest first. A chain is a loop, never a left-deep recursion.

struct expression : sor<conditional, let_in, disjunction> {};

struct conditional_condition : seq<expression> {};
struct conditional_then      : seq<then_word> {};
struct conditional_value     : seq<expression> {};
struct conditional_else      : seq<else_word> {};
struct conditional_inside    : seq<must<conditional_condition, conditional_then, conditional_value>,
                                   star<else_word, if_word,
                                        must<conditional_condition, conditional_then,
                                             conditional_value>>,
                                   must<conditional_else, conditional_value>> {};
struct conditional           : seq<if_word, conditional_inside> {};

struct let_in_binding : seq<binding> {};
struct let_in_in      : seq<in_word> {};
struct let_in_value   : seq<expression> {};
struct let_in_inside  : seq<must<let_in_binding>, star<mark<','>, must<let_in_binding>>,
                            must<let_in_in, let_in_value>> {};
struct let_in         : seq<let_word, let_in_inside> {};

struct binding_name  : token<name> {};
struct binding_is    : mark<'='> {};
struct binding_value : seq<expression> {};
struct binding       : seq<binding_name, must<binding_is, binding_value>> {};

struct disjunction_operand : seq<conjunction> {};
struct disjunction         : seq<conjunction, star<or_word, must<disjunction_operand>>> {};

struct conjunction_operand : seq<negation> {};
struct conjunction         : seq<negation, star<and_word, must<conjunction_operand>>> {};

struct negation_operand : seq<negation> {};
struct negation_inside  : must<negation_operand> {};
struct negation_not     : seq<not_word, negation_inside> {};
struct negation         : sor<negation_not, comparison> {};

struct comparison_operand : seq<interval> {};
struct comparison_end     : not_at<compare> {};
struct comparison         : seq<interval,
                                opt<token<compare>, must<comparison_operand, comparison_end>>> {};

struct compare : seq<at<one<'=', '!', '<', '>'>>,
                     sor<text<'=', '='>, text<'!', '='>, text<'<', '='>, text<'>', '='>, one<'<'>,
                         one<'>'>>> {};

struct interval_end : seq<sum> {};
struct interval     : seq<sum, opt<mark<'.', '.'>, must<interval_end>>> {};

struct sum_operator : one<'+', '-'> {};
struct sum_operand  : seq<product> {};
struct sum          : seq<product, star<token<sum_operator>, must<sum_operand>>> {};

struct product_operator : one<'*', '/'> {};
struct product_operand  : seq<unary> {};
struct product          : seq<unary, star<token<product_operator>, must<product_operand>>> {};

struct unary_operand : seq<unary> {};
struct unary_inside  : must<unary_operand> {};
struct unary_minus   : seq<mark<'-'>, unary_inside> {};
struct unary         : sor<unary_minus, power> {};

struct power_exponent : seq<unary> {};
struct power_inside   : must<power_exponent> {};
struct power          : seq<operand, opt<mark<'^'>, power_inside>> {};

struct operand_dot          : seq<one<'.'>, not_at<one<'.'>>, space> {};
struct operand_name         : token<name> {};
struct operand_member       : seq<operand_dot, must<operand_name>> {};
struct operand_index_value  : seq<expression> {};
struct operand_index_end    : mark<']'> {};
struct operand_index_inside : must<operand_index_value, operand_index_end> {};
struct operand_index        : seq<mark<'['>, operand_index_inside> {};
struct operand_postfix      : seq<sor<reference, parenthesis>,
                                  star<sor<operand_member, operand_index>>> {};
struct operand              : sor<token<literal>, list, operand_postfix> {};

struct reference : seq<path, not_at<one<':'>>, opt<arguments>> {};

struct path_dot  : seq<one<'.'>, not_at<one<'.'>>, space> {};
struct path_name : token<name> {};
struct path      : seq<token<name>, star<path_dot, must<path_name>>> {};

struct parenthesis_value  : seq<expression> {};
struct parenthesis_comma  : mark<','> {};
struct parenthesis_second : seq<expression> {};
struct parenthesis_third  : seq<expression> {};
struct parenthesis_end    : mark<')'> {};
struct parenthesis_inside : seq<must<parenthesis_value>,
                                opt<mark<','>,
                                    must<parenthesis_second, parenthesis_comma, parenthesis_third>,
                                    opt<mark<','>>>,
                                must<parenthesis_end>> {};
struct parenthesis        : seq<mark<'('>, parenthesis_inside> {};

struct list_end         : mark<']'> {};
struct list_clauses_end : mark<']'> {};
struct list_elements    : seq<star<mark<','>, expression>, opt<mark<','>>, must<list_end>> {};
struct list_clauses     : seq<for_clause, star<sor<for_clause, if_clause>>,
                              must<list_clauses_end>> {};
struct list_inside      : sor<seq<expression, sor<list_clauses, list_elements>>, must<list_end>> {};
struct list             : seq<mark<'['>, list_inside> {};

struct for_clause_list : seq<expression> {};
struct for_clause      : seq<for_word, must<for_pattern, for_in, for_clause_list>> {};

struct if_clause_condition : seq<expression> {};
struct if_clause           : seq<if_word, must<if_clause_condition>> {};
// clang-format on

/// Through these rules, entered behind an opening bracket or a prefix, all recursion goes.
using nesting =
    tao::pegtl::type_list<block_inside, parameters_inside, arguments_inside, conditional_inside,
                          let_in_inside, negation_inside, unary_inside, power_inside,
                          operand_index_inside, parenthesis_inside, list_inside, pattern_inside,
                          comment_block_inside>;

}  // namespace sdlc::grammar
