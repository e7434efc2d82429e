#pragma once

#include "grammar/json_tokens.hpp"

/// JSON texts whose value is an object: RFC 8259, with its names; the lexical rules are in
/// json_tokens.hpp. Beside the rules of the standard are the spellings that people type from other
/// habits, so that a reader can report each one with what to write instead, and go on after it. A
/// rule named missing_… matches without consuming where something is left out.
namespace sdlc::grammar::json {

// clang-format off

struct begin_array     : one<'['> {};
struct begin_object    : one<'{'> {};
struct end_array       : one<']'> {};
struct end_object      : one<'}'> {};
struct name_separator  : one<':'> {};
struct value_separator : one<','> {};

// What a reader has reported and replaced before; see lang/repair/json_syntax.hpp.
struct repaired_value  : one<'\x1A'> {};
struct repaired_member : one<'\x1C'> {};
struct repaired_name   : seq<one<'\x1D'>, star<word_char>> {};

struct array;
struct object;
struct value_by_habit : sor<malformed_number, single_quoted, curly_quoted, word, repaired_value> {};
struct value          : sor<number, string, array, object, literal, value_by_habit> {};
struct begins_value   : at<sor<ranges<'0', '9', 'a', 'z', 'A', 'Z'>,
                               one<'"', '\'', '{', '[', '-', '+', '.', '\x1A', '\x1D'>, curly_quote>> {};

struct missing_value_separator : begins_value {};
struct trailing_separator      : at<one<']', '}'>> {};

struct missing_element : at<value_separator> {};
struct present_element : seq<value, ws> {};
struct first_element   : sor<present_element, missing_element> {};
struct element         : sor<present_element, missing_element> {};
struct next_element    : sor<seq<value_separator, ws, sor<trailing_separator, must<element>>>,
                             seq<missing_value_separator, must<present_element>>> {};
struct array_content   : sor<at<end_array>, seq<must<first_element>, star<next_element>>> {};
struct array           : seq<begin_array, ws, array_content, must<end_array>> {};

struct equals_sign            : one<'='> {};
struct missing_name_separator : begins_value {};
struct name_separation        : sor<name_separator, equals_sign, missing_name_separator> {};
struct bare_name      : seq<ranges<'a', 'z', 'A', 'Z'>, star<word_char>, opt<one<'"'>>> {};
struct member_name    : sor<string, single_quoted, curly_quoted, bare_name, repaired_name> {};
struct missing_value  : at<sor<value_separator, end_object>> {};
struct member_value   : sor<value, missing_value> {};
struct missing_member : at<value_separator> {};
struct present_member : seq<member_name, ws, must<name_separation>, ws, must<member_value>, ws> {};
struct left_member    : seq<repaired_member, ws> {};
struct first_member   : sor<present_member, missing_member, left_member> {};
struct member         : sor<present_member, missing_member, left_member> {};
struct next_member    : sor<seq<value_separator, ws, sor<trailing_separator, must<member>>>,
                            seq<missing_value_separator, must<present_member>>> {};
struct object_content : sor<at<end_object>, seq<must<first_member>, star<next_member>>> {};
struct object         : seq<begin_object, ws, object_content, must<end_object>> {};

struct text : seq<opt<utf8::bom>, ws, must<object>, ws, must<eof>> {};

// clang-format on

}  // namespace sdlc::grammar::json
