#pragma once

#include <tao/pegtl/ascii.hpp>
#include <tao/pegtl/rules.hpp>
#include <tao/pegtl/utf8.hpp>

/// The lexical rules of JSON, RFC 8259, with its names, and of what people type instead from other
/// habits. json.hpp builds its syntax on these; the second part has what a lexer reads.
namespace sdlc::grammar::json {

namespace pegtl = tao::pegtl;
using pegtl::any, pegtl::at, pegtl::digit, pegtl::eof, pegtl::eolf, pegtl::must, pegtl::not_at,
    pegtl::not_one, pegtl::one, pegtl::opt, pegtl::plus, pegtl::range, pegtl::ranges, pegtl::rep,
    pegtl::rep_opt, pegtl::seq, pegtl::sor, pegtl::star, pegtl::until, pegtl::xdigit;
namespace utf8 = pegtl::utf8;

// clang-format off

// White space, and what is taken for it.
struct blank         : one<' ', '\t', '\n', '\r'> {};
struct line_comment  : seq<sor<one<'#'>, pegtl::string<'/', '/'>>, star<not_one<'\n', '\r'>>> {};
struct opening_comment    : pegtl::string<'/', '*'> {};
struct block_comment_rest : until<pegtl::string<'*', '/'>> {};
struct block_comment : seq<opening_comment, must<block_comment_rest>> {};
struct foreign_blank : utf8::ranges<0x0B, 0x0C, 0xA0, 0xA0, 0x2000, 0x200B, 0x202F, 0x202F, 0x205F, 0x205F,
                                    0x3000, 0x3000, 0xFEFF> {};
struct may_be_foreign : at<sor<one<'/', '#', 0x0B, 0x0C>, range<'\x80', '\xFF'>>> {};  // one test says no
struct foreign       : seq<may_be_foreign, sor<line_comment, block_comment, foreign_blank>> {};
struct ws            : seq<star<blank>, star<foreign, star<blank>>> {};

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
// Most strings are plain ASCII, which is tried first: `char_` has eight alternatives.
struct string_rest   : seq<star<char_>, must<closing_quote>> {};
struct string        : seq<opening_quote, opt<plain_ascii>, sor<closing_quote, string_rest>> {};

struct opening_single_quote : one<'\''> {};
struct closing_single_quote : one<'\''> {};
struct single_quoted_char   : sor<seq<one<'\\'>, not_at<eolf>, any>, not_one<'\'', '\n', '\r'>> {};
struct single_quoted : seq<opening_single_quote, star<single_quoted_char>, must<closing_single_quote>> {};

struct curly_quote         : utf8::one<0x201C, 0x201D> {};
struct opening_curly_quote : curly_quote {};
struct closing_curly_quote : curly_quote {};
struct curly_quoted_char   : seq<not_at<curly_quote>, not_one<'\n', '\r'>> {};
struct curly_quoted : seq<opening_curly_quote, star<curly_quoted_char>, must<closing_curly_quote>> {};

// What a lexer reads: a token of any text, whatever is wrong with it, and never over a line's end.
struct token_blank         : plus<sor<one<' ', '\t'>, foreign_blank>> {};
struct token_line_end      : sor<one<'\n'>, seq<one<'\r'>, opt<one<'\n'>>>> {};
struct token_comment       : seq<opening_comment, block_comment_rest> {};
struct token_string        : seq<opening_quote, star<char_>, closing_quote> {};
struct token_single_quoted : seq<opening_single_quote, star<single_quoted_char>, closing_single_quote> {};
struct token_curly_quoted  : seq<opening_curly_quote, star<curly_quoted_char>, closing_curly_quote> {};
struct token_open_string   : star<not_one<'\n', '\r'>> {};
struct token_bytes         : plus<sor<ranges<'\0', '\x08', '\x0E', '\x1F'>, seq<not_at<utf8::any>, any>>> {};
struct token_character     : utf8::any {};

// clang-format on

}  // namespace sdlc::grammar::json
