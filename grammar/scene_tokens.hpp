#pragma once

#include <tao/pegtl/ascii.hpp>
#include <tao/pegtl/rules.hpp>
#include <tao/pegtl/utf8.hpp>

/// The lexical rules of the scene language. The first part has the tokens of a correct text, as
/// scene.ebnf names them; the syntactic rules of scene.hpp are made of these. The second part has
/// what a lexer reads from any text.
namespace sdlc::grammar {

using tao::pegtl::any;
using tao::pegtl::at;
using tao::pegtl::digit;
using tao::pegtl::must;
using tao::pegtl::not_at;
using tao::pegtl::not_one;
using tao::pegtl::one;
using tao::pegtl::opt;
using tao::pegtl::plus;
using tao::pegtl::range;
using tao::pegtl::ranges;
using tao::pegtl::rep;
using tao::pegtl::seq;
using tao::pegtl::sor;
using tao::pegtl::star;
using tao::pegtl::xdigit;

struct reserved;
struct identifier;
struct number;
struct digits;
struct identifier_foreign;
struct unit;
struct color;
struct idchar;
struct string;
struct character;
struct escape;
struct comment;
struct doc;

/// These characters. Unlike pegtl::string this compares one by one, since nearly always the first
/// differs.
template <char... C>
struct text : seq<one<C>...> {};
/// A word that ends where no letter, digit or `_` follows.
template <char... C>
struct word : seq<one<C>..., not_at<idchar>> {};

// clang-format off
struct literal_true  : word<'t', 'r', 'u', 'e'> {};
struct literal_false : word<'f', 'a', 'l', 's', 'e'> {};
struct literal       : sor<number, string, color, literal_true, literal_false> {};

struct label : seq<identifier> {};
struct name  : seq<not_at<reserved>, identifier> {};

struct identifier : seq<ranges<'a', 'z', 'A', 'Z', '_'>, star<idchar>> {};

// The first letter decides: most names need one comparison, not sixteen.
struct reserved : seq<at<one<'a', 'd', 'e', 'f', 'i', 'l', 'n', 'o', 'p', 't'>>,
                      sor<word<'a', 'n', 'd'>, word<'a', 's', 's', 'e', 'r', 't'>,
                          word<'d', 'e', 'f'>, word<'e', 'l', 's', 'e'>,
                          word<'f', 'a', 'l', 's', 'e'>, word<'f', 'n'>,
                          word<'f', 'o', 'r'>, word<'i', 'f'>, word<'i', 'm', 'p', 'o', 'r', 't'>,
                          word<'i', 'n', 'c', 'l', 'u', 'd', 'e'>, word<'l', 'e', 't'>,
                          word<'n', 'o', 't'>, word<'o', 'r'>, word<'p', 'a', 'r', 'a', 'm'>,
                          word<'t', 'h', 'e', 'n'>, word<'t', 'r', 'u', 'e'>>> {};

struct number_fraction : seq<one<'.'>, digits> {};
struct number_exponent : seq<one<'e', 'E'>, opt<one<'+', '-'>>, digits> {};
struct number_end      : not_at<sor<idchar, one<'%'>, seq<one<'.'>, not_at<one<'.'>>>,
                                    identifier_foreign>> {};
struct number          : seq<sor<seq<digits, opt<number_fraction>>, number_fraction>,
                             opt<number_exponent>, opt<unit>, number_end> {};

struct digits : seq<plus<digit>, star<one<'_'>, plus<digit>>> {};

struct unit : seq<at<one<'%', 'd', 'r', 't', 'm', 'c', 'k', 's'>>,
                  sor<one<'%'>, text<'d', 'e', 'g'>, text<'r', 'a', 'd'>, text<'t', 'u', 'r', 'n'>,
                      text<'m', 'm'>, text<'m', 's'>, text<'c', 'm'>, text<'k', 'm'>, one<'m'>,
                      one<'s'>>> {};

struct color : seq<one<'#'>, plus<idchar>> {};

struct idchar : ranges<'a', 'z', 'A', 'Z', '0', '9', '_'> {};

// Latin letters with accents, Greek and Cyrillic, without the signs for times and divided by, and
// the micro sign. They end no number: `2π` is one mistake.
struct identifier_foreign
    : tao::pegtl::utf8::ranges<0xB5, 0xB5, 0xC0, 0xD6, 0xD8, 0xF6, 0xF8, 0x53F> {};

struct string : seq<one<'"'>, star<sor<plus<character>, escape>>, one<'"'>> {};

struct character : seq<not_at<ranges<'\0', '\x1F'>>, not_one<'"', '\\'>> {};

struct escape : seq<one<'\\'>,
                    sor<one<'"', '\\', '/', 'b', 'f', 'n', 'r', 't'>,
                        seq<one<'u'>, rep<4, xdigit>>>> {};

struct space_blank : sor<one<' ', '\n', '\t'>, text<'\r', '\n'>> {};
struct space       : seq<star<space_blank>, star<comment, star<space_blank>>> {};

struct comment_line         : seq<text<'/', '/'>, star<not_one<'\n', '\r'>>> {};
struct comment_block;
struct comment_block_text   : sor<comment_block, seq<not_at<text<'*', '/'>>, any>> {};
struct comment_block_end    : text<'*', '/'> {};
struct comment_block_inside : seq<star<comment_block_text>, must<comment_block_end>> {};
struct comment_block        : seq<text<'/', '*'>, comment_block_inside> {};
struct comment              : seq<at<one<'/'>>, sor<doc, comment_line, comment_block>> {};

struct doc : seq<text<'/', '/', '/'>, not_at<one<'/'>>, star<not_one<'\n', '\r'>>> {};

// What a lexer reads. Such a token begins like one of a correct text and goes on as long as it can
// be part of a mistake in it; for a correct token both rules give the same end.

struct string_part  : sor<seq<one<'\\'>, not_one<'\n', '\r'>>, not_one<'"', '\n', '\r'>> {};
struct string_token : seq<one<'"'>, star<string_part>, one<'"'>> {};
struct string_open  : seq<one<'"'>, star<string_part>> {};

struct number_point    : seq<one<'.'>, not_at<one<'.'>>> {};
struct number_digits   : plus<sor<digit, number_point>> {};
struct number_sign     : seq<one<'e', 'E'>, one<'+', '-'>> {};
struct number_token    : plus<sor<seq<number_digits, opt<number_sign>>, idchar, one<'%'>,
                                  identifier_foreign>> {};

struct identifier_token : seq<not_at<digit>, plus<sor<idchar, identifier_foreign>>> {};

struct space_in_line  : plus<one<' ', '\t'>> {};
struct space_line_end : sor<one<'\n'>, seq<one<'\r'>, opt<one<'\n'>>>> {};

struct compare_token : sor<seq<one<'=', '!', '<', '>'>, one<'='>>, text<'.', '.'>> {};

struct character_control : sor<ranges<'\0', '\x08', '\x0B', '\x0C', '\x0E', '\x1F'>, one<'\x7F'>> {};
struct character_bytes   : plus<sor<character_control, seq<not_at<tao::pegtl::utf8::any>, any>>> {};
struct character_other   : tao::pegtl::utf8::any {};
// clang-format on

}  // namespace sdlc::grammar
