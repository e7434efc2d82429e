#pragma once

#include <tao/pegtl/ascii.hpp>
#include <tao/pegtl/rules.hpp>
#include <tao/pegtl/utf8.hpp>

/// JSON texts whose value is an object: RFC 8259, with its names. Beside the rules of the standard
/// stand the spellings that people type from other habits, so that a reader can report each one
/// with what to write instead, and go on behind it. A rule named missing_… matches without
/// consuming where something is left out.
namespace sdlc::grammar::json {

namespace pegtl = tao::pegtl;
using pegtl::any, pegtl::at, pegtl::digit, pegtl::eof, pegtl::eolf, pegtl::must, pegtl::not_at,
    pegtl::not_one, pegtl::one, pegtl::opt, pegtl::plus, pegtl::range, pegtl::ranges, pegtl::rep,
    pegtl::rep_opt, pegtl::seq, pegtl::sor, pegtl::star, pegtl::until, pegtl::xdigit;
namespace utf8 = pegtl::utf8;

// clang-format off

// White space, and what is taken for it.
struct blank         : one<' ', '\t', '\n', '\r'> {};
struct line_comment  : seq<sor<one<'#'>, pegtl::string<'/', '/'>>, until<at<eolf>>> {};
struct opening_comment    : pegtl::string<'/', '*'> {};
struct block_comment_rest : until<pegtl::string<'*', '/'>> {};
struct block_comment : seq<opening_comment, must<block_comment_rest>> {};
struct foreign_blank : utf8::ranges<0x0B, 0x0C, 0xA0, 0xA0, 0x2000, 0x200B, 0x202F, 0x202F, 0x205F, 0x205F,
                                    0x3000, 0x3000, 0xFEFF> {};
struct may_be_foreign : at<sor<one<'/', '#', 0x0B, 0x0C>, range<'\x80', '\xFF'>>> {};  // one test says no
struct foreign       : seq<may_be_foreign, sor<line_comment, block_comment, foreign_blank>> {};
struct ws            : seq<star<blank>, star<foreign, star<blank>>> {};

struct begin_array     : one<'['> {};
struct begin_object    : one<'{'> {};
struct end_array       : one<']'> {};
struct end_object      : one<'}'> {};
struct name_separator  : one<':'> {};
struct value_separator : one<','> {};

// Words: no character of one may follow a number or a literal.
struct word_char : sor<ranges<'a', 'z', 'A', 'Z', '0', '9'>, one<'_', '.', '+', '-', '$'>> {};
struct word      : seq<ranges<'a', 'z', 'A', 'Z'>, star<word_char>> {};

struct false_  : seq<pegtl::string<'f', 'a', 'l', 's', 'e'>, not_at<word_char>> {};
struct null    : seq<pegtl::string<'n', 'u', 'l', 'l'>, not_at<word_char>> {};
struct true_   : seq<pegtl::string<'t', 'r', 'u', 'e'>, not_at<word_char>> {};
struct literal : sor<false_, null, true_> {};

struct digits : plus<digit> {};
struct int_   : sor<one<'0'>, digits> {};
struct frac   : seq<one<'.'>, digits> {};
struct exp    : seq<one<'e', 'E'>, opt<one<'-', '+'>>, digits> {};
struct operation : seq<one<'/', '*'>, digit> {};
struct number : seq<opt<one<'-'>>, int_, opt<frac>, opt<exp>, not_at<sor<word_char, operation>>> {};
struct malformed_number : seq<sor<digit, one<'-', '+', '.'>>, star<sor<word_char, operation>>> {};

// Escapes. A code point beyond U+FFFF is written as a pair of surrogates; one alone is nothing.
struct escaped_char   : one<'"', '\\', '/', 'b', 'f', 'n', 'r', 't'> {};
struct high_surrogate : seq<one<'u'>, one<'d', 'D'>, one<'8', '9', 'a', 'b', 'A', 'B'>, xdigit, xdigit> {};
struct low_surrogate  : seq<one<'u'>, one<'d', 'D'>, ranges<'c', 'f', 'C', 'F'>, xdigit, xdigit> {};
struct surrogate_pair : seq<high_surrogate, one<'\\'>, low_surrogate> {};
struct code_unit      : seq<one<'u'>, rep<4, xdigit>> {};
struct code_point     : seq<not_at<sor<high_surrogate, low_surrogate>>, code_unit> {};
struct escape         : seq<one<'\\'>, sor<escaped_char, surrogate_pair, code_point>> {};
struct lone_surrogate : seq<one<'\\'>, code_unit> {};
struct short_escape   : seq<one<'\\'>, one<'u'>, rep_opt<3, xdigit>> {};
struct unknown_escape : seq<one<'\\'>, sor<utf8::range<' ', 0x10FFFF>, not_one<'\n', '\r'>>> {};

struct plain_ascii  : plus<ranges<' ', '!', '#', '[', ']', '~'>> {};
struct beyond_ascii : utf8::range<0x7F, 0x10FFFF> {};
struct raw_control  : ranges<'\x00', '\x09', '\x0B', '\x0C', '\x0E', '\x1F'> {};
struct invalid_utf8 : range<'\x80', '\xFF'> {};
struct char_ : sor<plain_ascii, escape, beyond_ascii,
                   lone_surrogate, short_escape, unknown_escape, raw_control, invalid_utf8> {};

struct opening_quote : one<'"'> {};
struct closing_quote : one<'"'> {};
struct string        : seq<opening_quote, star<char_>, must<closing_quote>> {};

struct opening_single_quote : one<'\''> {};
struct closing_single_quote : one<'\''> {};
struct single_quoted_char   : sor<seq<one<'\\'>, not_at<eolf>, any>, not_one<'\'', '\n', '\r'>> {};
struct single_quoted : seq<opening_single_quote, star<single_quoted_char>, must<closing_single_quote>> {};

struct curly_quote         : utf8::one<0x201C, 0x201D> {};
struct opening_curly_quote : curly_quote {};
struct closing_curly_quote : curly_quote {};
struct curly_quoted_char   : seq<not_at<curly_quote>, not_one<'\n', '\r'>> {};
struct curly_quoted : seq<opening_curly_quote, star<curly_quoted_char>, must<closing_curly_quote>> {};

// What a reader has reported and replaced before; see lang/json/mend_syntax.hpp.
struct mended_value  : one<'\x1A'> {};
struct mended_member : one<'\x1C'> {};
struct mended_name   : seq<one<'\x1D'>, star<word_char>> {};

struct array;
struct object;
struct value_by_habit : sor<malformed_number, single_quoted, curly_quoted, word, mended_value> {};
struct value          : sor<string, number, array, object, literal, value_by_habit> {};
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
struct member_name    : sor<string, single_quoted, curly_quoted, bare_name, mended_name> {};
struct missing_value  : at<sor<value_separator, end_object>> {};
struct member_value   : sor<value, missing_value> {};
struct missing_member : at<value_separator> {};
struct present_member : seq<member_name, ws, must<name_separation>, ws, must<member_value>, ws> {};
struct left_member    : seq<mended_member, ws> {};
struct first_member   : sor<present_member, missing_member, left_member> {};
struct member         : sor<present_member, missing_member, left_member> {};
struct next_member    : sor<seq<value_separator, ws, sor<trailing_separator, must<member>>>,
                            seq<missing_value_separator, must<present_member>>> {};
struct object_content : sor<at<end_object>, seq<must<first_member>, star<next_member>>> {};
struct object         : seq<begin_object, ws, object_content, must<end_object>> {};

struct text : seq<opt<utf8::bom>, ws, must<object>, ws, must<eof>> {};

// clang-format on

}  // namespace sdlc::grammar::json
