#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <utility>

#include "grammar/scene.hpp"
#include "lang/repair/recovery.hpp"
#include "lang/syntax/expected.hpp"
#include "lang/syntax/tree_builder.hpp"
#include "lang/token/lines.hpp"
#include "lang/token/name_characters.hpp"

/// What happens where a rule of the grammar matches (Build) and where it must and does not
/// (Control). Included by parse.cpp alone: the grammar is compiled once.
namespace sdlc::lang {

namespace pegtl = tao::pegtl;
using pegtl::apply_mode;
using pegtl::rewind_mode;

// What is reported where the grammar is committed

template <typename Rule>
struct Control : pegtl::normal<Rule> {
  template <typename Input>
  [[noreturn]] static void raise(const Input& in, TreeBuilder& builder) {
    static_assert(expected<Rule>.words != nullptr, "a committed rule needs words for its error");
    const std::uint32_t at = builder.offset(in.current());
    builder.mark_error(at);
    if constexpr (std::is_same_v<Rule, grammar::block_end>) {
      const std::uint32_t begin = builder.opener;
      builder.sink().report(diag::unclosed, builder.location({begin, begin + 1}), "{");
      throw Stopped{};
    } else if constexpr (std::is_same_v<Rule, grammar::comment_block_end>) {
      const std::uint32_t begin = builder.comment_begin;
      builder.sink().report(diag::unclosed, builder.location({begin, begin + 2}), "/*");
      throw Stopped{};
    } else {
      // That a bracket is missing has been reported; what it ends too soon follows from that.
      if (!builder.is_added(at)) diagnose_expected(builder, at, expected<Rule>);
      throw Reported{};
    }
  }
};

// What is built where a rule matches

template <typename Rule>
struct Build : pegtl::nothing<Rule> {};

/// Matches `Rule` itself inside an action that surrounds it. No lookahead of the grammar contains a
/// rule that builds, so that nothing is built twice.
template <typename Rule, apply_mode A, rewind_mode M, template <typename...> class Action,
          template <typename...> class Ctrl, typename Input>
bool match_inside(Input& in, TreeBuilder& builder) {
  static_assert(A == apply_mode::action, "nothing may be built in a lookahead");
  return pegtl::match<Rule, A, M, Action, Ctrl>(in, builder);
}

/// The same, with the input where it was if the rule does not match: for actions that then look at
/// it.
template <typename Rule, apply_mode A, template <typename...> class Action,
          template <typename...> class Ctrl, typename Input>
bool match_or_rewind(Input& in, TreeBuilder& builder) {
  auto marker = in.template mark<rewind_mode::required>();
  return marker(match_inside<Rule, A, rewind_mode::active, Action, Ctrl>(in, builder));
}

#define SDLC_SURROUND                                                                        \
  template <typename Rule, apply_mode A, rewind_mode M, template <typename...> class Action, \
            template <typename...> class Ctrl, typename Input>                               \
  static bool match(Input& in, TreeBuilder& builder)
#define SDLC_MATCH match_inside<Rule, A, M, Action, Ctrl>(in, builder)

/// A node around what is built inside, which begins with one of `kFirst` if there are any: most of
/// the places where a node might begin are settled by their first character.
template <SyntaxKind kKind, char... kFirst>
struct Node : pegtl::maybe_nothing {
  SDLC_SURROUND {
    if constexpr (sizeof...(kFirst) > 0) {
      if (in.empty() || ((in.peek_char() != kFirst) && ...)) return false;
    }
    OpenNode node(builder, kKind, builder.offset(in.current()));
    if (SDLC_MATCH) return true;
    node.discard();
    return false;
  }
};

/// A node around several operands, none around one.
template <SyntaxKind kKind>
struct Chain : pegtl::maybe_nothing {
  SDLC_SURROUND {
    OpenChain chain(builder);
    if (SDLC_MATCH) {
      chain.close(kKind);
      return true;
    }
    chain.discard();
    return false;
  }
};

/// A node of a token.
template <SyntaxKind kKind>
struct Leaf : pegtl::maybe_nothing {
  SDLC_SURROUND {
    const std::uint32_t begin = builder.offset(in.current());
    if (!SDLC_MATCH) return false;
    builder.push(kKind, {begin, builder.token_end()});
    return true;
  }
};

/// A node of a lexical rule, which has no space behind it.
template <SyntaxKind kKind>
struct LexicalLeaf : pegtl::maybe_nothing {
  SDLC_SURROUND {
    const std::uint32_t begin = builder.offset(in.current());
    if (!SDLC_MATCH) return false;
    builder.push(kKind, {begin, builder.offset(in.current())});
    return true;
  }
};

/// The beginning of the node that was pushed last.
struct Head : pegtl::maybe_nothing {
  SDLC_SURROUND {
    if (!SDLC_MATCH) return false;
    SyntaxNode& node = builder.node(builder.size() - 1);
    set_head(builder, node);
    return true;
  }

  static void set_head(TreeBuilder& builder, SyntaxNode& node) {
    const std::uint32_t size = builder.token_end() - node.begin;
    if (size > kMaxNameLength) {
      builder.sink().report(diag::name_too_long,
                            builder.location({node.begin, builder.token_end()}),
                            static_cast<int>(kMaxNameLength));
      builder.mark_error(builder.token_end());
      throw Reported{};
    }
    node.head = static_cast<std::uint16_t>(size);
  }

  static constexpr std::uint32_t kMaxNameLength = 0xFFFF;
};

/// A label, whose colon belongs to the same rule.
struct LabelHead : pegtl::maybe_nothing {
  SDLC_SURROUND {
    if (!SDLC_MATCH) return false;
    SyntaxNode& node = builder.node(builder.size() - 1);
    // `token_end` is behind the colon.
    const std::uint32_t end = builder.token_end();
    builder.end_token(builder.label_end);
    Head::set_head(builder, node);
    builder.end_token(end);
    return true;
  }
};

template <>
struct Build<grammar::label> : pegtl::maybe_nothing {
  SDLC_SURROUND {
    if (!SDLC_MATCH) return false;
    builder.label_end = builder.offset(in.current());
    return true;
  }
};

/// An operand of a chain that notes the operator in front of it.
struct Operand : pegtl::maybe_nothing {
  SDLC_SURROUND {
    const Operator op = builder.op;
    const NodeIndex first = builder.size();
    if (!SDLC_MATCH) return false;
    builder.node(first).op = op;
    return true;
  }
};

enum class Opener : std::uint8_t { Bracket, Word, Comment };

/// What lies behind an opening bracket or a prefix of `kLength` bytes: one level deeper.
template <Opener kOpener, std::uint32_t kLength>
struct Nest : pegtl::maybe_nothing {
  SDLC_SURROUND {
    const std::uint32_t end =
        kOpener == Opener::Comment ? builder.offset(in.current()) : builder.token_end();
    Level level(builder, {end - kLength, end});
    const bool matched = SDLC_MATCH;
    level.leave();
    if constexpr (kOpener == Opener::Bracket) {
      // A repaired value may not be the intended one; a repaired block may end too soon.
      const std::uint32_t last = builder.token_end(), begin = end - kLength;
      const bool is_block = builder.text()[begin] == '{';
      if (matched && builder.is_repaired({is_block ? last - 1 : begin, last})) {
        builder.push(SyntaxKind::Error, {last, last});
      }
    }
    return matched;
  }

 private:
  class Level {
   public:
    Level(TreeBuilder& builder, Span opener) : builder_(builder), outer_(builder.opener) {
      if (builder.depth == kMaxNesting) {
        builder.mark_error(opener.end);
        builder.brackets += kOpener == Opener::Bracket;
        builder.sink().report(diag::too_deep, builder.location(opener), int{kMaxNesting});
        if (kOpener == Opener::Comment) throw Stopped{};
        throw Reported{};
      }
      ++builder.depth;
      if (kOpener == Opener::Bracket) {
        ++builder.brackets;
        builder.opener = opener.begin;
      }
    }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;
    ~Level() {
      --builder_.depth;
      builder_.opener = outer_;
    }
    /// A mistake inside leaves the bracket open: whoever looks for the next statement counts it.
    void leave() noexcept {
      if (kOpener == Opener::Bracket) --builder_.brackets;
    }

   private:
    TreeBuilder& builder_;
    std::uint32_t outer_;
  };
};

// clang-format off
template <> struct Build<grammar::version>          : LexicalLeaf<SyntaxKind::Version> {};
template <> struct Build<grammar::property_head>    : LabelHead {};
template <> struct Build<grammar::property>         : Node<SyntaxKind::Property> {};
template <> struct Build<grammar::import_name>      : Leaf<SyntaxKind::Name> {};
template <> struct Build<grammar::import_>          : Node<SyntaxKind::Import, 'i'> {};
template <> struct Build<grammar::include>          : Node<SyntaxKind::Include, 'i'> {};
template <> struct Build<grammar::param_name>       : Leaf<SyntaxKind::Name> {};
template <> struct Build<grammar::param>            : Node<SyntaxKind::Param, 'p'> {};
template <> struct Build<grammar::let_name>         : Leaf<SyntaxKind::Name> {};
template <> struct Build<grammar::let>              : Node<SyntaxKind::Let, 'l'> {};
template <> struct Build<grammar::fn_name>          : Leaf<SyntaxKind::Name> {};
template <> struct Build<grammar::fn>               : Node<SyntaxKind::Fn, 'f'> {};
template <> struct Build<grammar::def_name>         : Leaf<SyntaxKind::Name> {};
template <> struct Build<grammar::def>              : Node<SyntaxKind::Def, 'd'> {};
template <> struct Build<grammar::assert_>          : Node<SyntaxKind::Assert, 'a'> {};
template <> struct Build<grammar::for_name>         : Leaf<SyntaxKind::Name> {};
template <> struct Build<grammar::for_>             : Node<SyntaxKind::For, 'f'> {};
template <> struct Build<grammar::if_>              : Node<SyntaxKind::If, 'i'> {};
template <> struct Build<grammar::object_name>      : Leaf<SyntaxKind::Name> {};
template <> struct Build<grammar::object>           : Node<SyntaxKind::Object> {};
template <> struct Build<grammar::type>             : Leaf<SyntaxKind::TypeName> {};
template <> struct Build<grammar::parameters_inside> : Nest<Opener::Bracket, 1> {};
template <> struct Build<grammar::parameter_name>   : Head {};
template <> struct Build<grammar::parameter>        : Node<SyntaxKind::Parameter> {};
template <> struct Build<grammar::argument_head>    : LabelHead {};
template <> struct Build<grammar::argument_labeled> : Node<SyntaxKind::Argument> {};
template <> struct Build<grammar::conditional_inside> : Nest<Opener::Word, 2> {};
template <> struct Build<grammar::conditional>      : Node<SyntaxKind::Conditional, 'i'> {};
template <> struct Build<grammar::conjunction>      : Chain<SyntaxKind::And> {};
template <> struct Build<grammar::negation_inside>  : Nest<Opener::Word, 3> {};
template <> struct Build<grammar::negation_not>     : Node<SyntaxKind::Not, 'n'> {};
template <> struct Build<grammar::comparison_operand> : Operand {};
template <> struct Build<grammar::comparison>       : Chain<SyntaxKind::Comparison> {};
template <> struct Build<grammar::interval>         : Chain<SyntaxKind::Interval> {};
template <> struct Build<grammar::sum_operand>      : Operand {};
template <> struct Build<grammar::sum>              : Chain<SyntaxKind::Sum> {};
template <> struct Build<grammar::product_operand>  : Operand {};
template <> struct Build<grammar::product>          : Chain<SyntaxKind::Product> {};
template <> struct Build<grammar::unary_inside>     : Nest<Opener::Word, 1> {};
template <> struct Build<grammar::unary_minus>      : Node<SyntaxKind::Negative, '-'> {};
template <> struct Build<grammar::power_inside>     : Nest<Opener::Word, 1> {};
template <> struct Build<grammar::power>            : Chain<SyntaxKind::Power> {};
template <> struct Build<grammar::operand_member>   : Leaf<SyntaxKind::Member> {};
template <> struct Build<grammar::operand_index_inside> : Nest<Opener::Bracket, 1> {};
template <> struct Build<grammar::operand_index>    : Node<SyntaxKind::Index, '['> {};
template <> struct Build<grammar::operand_postfix>  : Chain<SyntaxKind::Postfix> {};
template <> struct Build<grammar::path>             : Head {};
template <> struct Build<grammar::parenthesis_inside> : Nest<Opener::Bracket, 1> {};
template <> struct Build<grammar::list_inside>      : Nest<Opener::Bracket, 1> {};
template <> struct Build<grammar::list>             : Node<SyntaxKind::List, '['> {};
template <> struct Build<grammar::literal_true>     : LexicalLeaf<SyntaxKind::True> {};
template <> struct Build<grammar::literal_false>    : LexicalLeaf<SyntaxKind::False> {};
template <> struct Build<grammar::comment_block_inside> : Nest<Opener::Comment, 2> {};
// clang-format on

/// The one place that all tokens pass.
template <>
struct Build<grammar::space> : pegtl::maybe_nothing {
  SDLC_SURROUND {
    builder.end_token(builder.offset(in.current()));
    // Most space is one blank or none. What is not settled here goes the way of the grammar.
    while (!in.empty() && is_blank(in.peek_char())) in.bump(1);
    if (!in.empty() && (in.peek_char() == '/' || in.peek_char() == '\r')) {
      const bool matched = SDLC_MATCH;
      builder.end_space(builder.offset(in.current()));
      return matched;
    }
    builder.end_space(builder.offset(in.current()));
    return true;
  }

  static bool is_blank(char c) noexcept { return c == ' ' || c == '\n' || c == '\t'; }
};

template <>
struct Build<grammar::comment> : pegtl::maybe_nothing {
  SDLC_SURROUND {
    const std::uint32_t begin = builder.offset(in.current());
    builder.comment_begin = begin;
    if (!SDLC_MATCH) return false;
    builder.add_comment({begin, builder.offset(in.current())});
    return true;
  }
};

template <>
struct Build<grammar::compare> {
  template <typename Input>
  static void apply(const Input& in, TreeBuilder& builder) {
    const std::string_view text = in.string_view();
    builder.op = text == "=="   ? Operator::Equal
                 : text == "!=" ? Operator::NotEqual
                 : text == "<=" ? Operator::LessEqual
                 : text == ">=" ? Operator::GreaterEqual
                 : text == "<"  ? Operator::Less
                                : Operator::Greater;
  }
};

template <>
struct Build<grammar::sum_operator> {
  template <typename Input>
  static void apply(const Input& in, TreeBuilder& builder) {
    builder.op = in.peek_char() == '+' ? Operator::Add : Operator::Subtract;
  }
};

template <>
struct Build<grammar::product_operator> {
  template <typename Input>
  static void apply(const Input& in, TreeBuilder& builder) {
    builder.op = in.peek_char() == '*' ? Operator::Multiply : Operator::Divide;
  }
};

template <>
struct Build<grammar::reference> : Node<SyntaxKind::Reference> {
  SDLC_SURROUND {
    if (in.empty() || !is_letter(in.peek_char())) return false;
    if (begins_object(builder, builder.offset(in.current()))) return false;
    return Node::match<Rule, A, M, Action, Ctrl>(in, builder);
  }

 private:
  /// Whether it is rather the next line's statement, and the value is missing.
  static bool begins_object(const TreeBuilder& builder, std::uint32_t at) {
    if (builder.in_head) return false;
    const std::string_view text = builder.text();
    const std::uint32_t end = builder.token_end();
    if (text.substr(end, at - end).find('\n') == std::string_view::npos) return false;
    return looks_like_object(text, at);
  }
};

/// The head of a block, whose value a brace follows.
struct BlockHead : pegtl::maybe_nothing {
  SDLC_SURROUND {
    const bool outer = std::exchange(builder.in_head, true);
    const bool matched = SDLC_MATCH;
    builder.in_head = outer;
    return matched;
  }
};
template <>
struct Build<grammar::for_list> : BlockHead {};
template <>
struct Build<grammar::if_condition> : BlockHead {};

/// An expression. One that is just a number, as nearly all are where speed matters, skips the
/// levels of precedence in which no operator would be found (with them the parser took twice as
/// long).
template <>
struct Build<grammar::disjunction> : Chain<SyntaxKind::Or> {
  SDLC_SURROUND {
    return plain_number(in, builder) || Chain::match<Rule, A, M, Action, Ctrl>(in, builder);
  }

 private:
  /// Digits, perhaps with a minus and a point, up to what ends an expression for certain.
  template <typename Input>
  static bool plain_number(Input& in, TreeBuilder& builder) {
    const char* const begin = in.current();
    const char* const end = in.end();
    const char* at = begin;
    const auto skip_digits = [&] {
      const char* const first = at;
      while (at != end && is_digit(*at)) ++at;
      return at != first;
    };

    const bool is_negative = at != end && *at == '-';
    if (is_negative) ++at;
    const char* const number = at;
    if (!skip_digits()) return false;
    if (at != end && *at == '.' && (++at, !skip_digits())) return false;
    const char* const number_end = at;
    while (at != end && *at == ' ') ++at;
    if (at == end || (*at != ',' && *at != ')' && *at != '}' && *at != ']')) return false;

    const Span span{builder.offset(number), builder.offset(number_end)};
    if (is_negative) {
      builder.push(SyntaxKind::Negative, {span.begin - 1, span.end});
      builder.node(builder.size() - 1).extent = 2;
    }
    builder.push(SyntaxKind::Number, span);
    builder.end_token(span.end);
    builder.end_space(builder.offset(at));
    in.bump(static_cast<std::size_t>(at - begin));
    return true;
  }
};

/// A reference turns into a call when its arguments begin.
template <>
struct Build<grammar::arguments_inside> : Nest<Opener::Bracket, 1> {
  SDLC_SURROUND {
    SyntaxNode& callee = builder.node(builder.size() - 1);
    const bool has_name = !builder.is_added(callee.begin);
    callee.kind = has_name ? SyntaxKind::Call : SyntaxKind::Error;
    if (!has_name) callee.head = 0;
    return Nest::match<Rule, A, M, Action, Ctrl>(in, builder);
  }
};

template <>
struct Build<grammar::parenthesis> : pegtl::maybe_nothing {
  SDLC_SURROUND {
    if (in.empty() || in.peek_char() != '(') return false;
    OpenNode node(builder, SyntaxKind::Group, builder.offset(in.current()));
    if (!SDLC_MATCH) {
      node.discard();
      return false;
    }
    if (!builder.is_one_node(node.index() + 1))
      builder.node(node.index()).kind = SyntaxKind::Triple;
    return true;
  }
};

// Literals that are wrong are reported and passed: what surrounds them is not.

template <>
struct Build<grammar::number> : pegtl::maybe_nothing {
  SDLC_SURROUND {
    const std::uint32_t begin = builder.offset(in.current());
    if (match_or_rewind<Rule, A, Action, Ctrl>(in, builder)) {
      builder.push(SyntaxKind::Number, {begin, builder.offset(in.current())});
      return true;
    }
    const std::size_t digit = !in.empty() && in.peek_char() == '.' ? 1 : 0;
    if (in.size() <= digit || in.peek_char(digit) < '0' || in.peek_char(digit) > '9') return false;
    const std::uint32_t end = diagnose_number(builder, begin);
    builder.push(SyntaxKind::Error, {begin, end});
    in.bump(end - begin);
    return true;
  }
};

template <>
struct Build<grammar::string> : pegtl::maybe_nothing {
  SDLC_SURROUND {
    const std::uint32_t begin = builder.offset(in.current());
    if (match_or_rewind<Rule, A, Action, Ctrl>(in, builder)) {
      builder.push(SyntaxKind::String, {begin, builder.offset(in.current())});
      return true;
    }
    if (in.empty() || in.peek_char() != '"') return false;
    const std::uint32_t end = diagnose_string(builder, begin);
    builder.push(SyntaxKind::Error, {begin, end});
    in.bump(end - begin);
    return true;
  }
};

template <>
struct Build<grammar::color> : pegtl::maybe_nothing {
  SDLC_SURROUND {
    const std::uint32_t begin = builder.offset(in.current());
    if (!SDLC_MATCH) return false;
    const Span span{begin, builder.offset(in.current())};
    builder.push(check_color(builder, span) ? SyntaxKind::Color : SyntaxKind::Error, span);
    return true;
  }
};

// Blocks and statements

template <>
struct Build<grammar::block> : Node<SyntaxKind::Block, '{'> {
  SDLC_SURROUND {
    const bool outer = std::exchange(builder.in_object, false);
    const bool matched = Node::match<Rule, A, M, Action, Ctrl>(in, builder);
    builder.in_object = outer;
    return matched;
  }
};

template <>
struct Build<grammar::object_block> : pegtl::maybe_nothing {
  SDLC_SURROUND {
    const bool outer = std::exchange(builder.in_object, true);
    const bool was_group = std::exchange(builder.in_group, is_group(builder));
    const std::uint32_t begin = builder.offset(in.current());
    const bool matched = SDLC_MATCH;
    const std::uint32_t end = builder.token_end();
    // Properties may be missing because of another mistake.
    if (matched && !builder.in_group && builder.is_repaired({begin, end})) {
      builder.push(SyntaxKind::Error, {end, end});
    }
    builder.in_object = outer;
    builder.in_group = was_group;
    return matched;
  }

 private:
  /// Whether the object is of the one kind that holds statements. Behind its node stands that of
  /// its name, if it has one.
  static bool is_group(TreeBuilder& builder) {
    const NodeIndex last = builder.size() - 1;
    const bool has_name = builder.node(last).kind == SyntaxKind::Name;
    const SyntaxNode& object = builder.node(has_name ? last - 1 : last);
    return builder.text().substr(object.begin, object.head) == "group";
  }
};

template <>
struct Build<grammar::block_inside> : Nest<Opener::Bracket, 1> {
  SDLC_SURROUND {
    ++builder.blocks;
    const bool matched = Nest::match<Rule, A, M, Action, Ctrl>(in, builder);
    --builder.blocks;
    return matched;
  }
};

template <>
struct Build<grammar::file_header> : pegtl::maybe_nothing {
  SDLC_SURROUND {
    const std::uint32_t begin = builder.offset(in.current());
    if (!match_or_rewind<Rule, A, Action, Ctrl>(in, builder)) {
      in.bump(diagnose_header(builder, begin) - begin);
      return true;
    }
    const SyntaxNode& version = builder.node(builder.size() - 1);
    const std::string_view text = builder.text().substr(version.begin, version.span().size());
    builder.has_version = true;
    if (text == "1") return true;
    builder.sink().report(diag::unsupported_version, builder.location(version.span()), text);
    throw Stopped{};
  }
};

/// A statement, or what stands in the place of one: this matches until the block's `}` or the end
/// of the text.
template <>
struct Build<grammar::statement> : pegtl::maybe_nothing {
  SDLC_SURROUND {
    builder.sink().stop_if_requested();
    const Surroundings before(builder);
    const std::uint32_t begin = builder.offset(in.current());
    try {
      if (match_or_rewind<Rule, A, Action, Ctrl>(in, builder)) {
        builder.set_last_statement(before.nodes);
        if (before.in_object && !before.in_group &&
            builder.node(before.nodes).kind != SyntaxKind::Property) {
          builder.has_misplaced = builder.has_misplaced || is_shallow(builder, begin);
        }
        return true;
      }
    } catch (const Reported&) {
      const RecoveryOptions options{.open = builder.brackets - before.brackets,
                                    .open_block = builder.blocks > before.blocks};
      before.restore(builder);
      builder.poison_last_part(before.nodes);
      const std::uint32_t wrong = builder.error_at();
      skip_to(in, builder, wrong, find_next(builder, begin, wrong, options));
      return true;
    }
    builder.end_token(before.token_end);
    const std::uint32_t at = builder.offset(in.current());
    if (in.empty() || (in.peek_char() == '}' && builder.blocks > 0)) return false;
    const bool open_block = in.peek_char() == '{';
    const Resumption next = diagnose_statement(builder, at);
    skip_to(in, builder, at,
            next.is_statement ? next.from
                              : find_next(builder, at, next.from, {.open_block = open_block}));
    return true;
  }

 private:
  struct Surroundings {
    explicit Surroundings(const TreeBuilder& b)
        : nodes(b.size()),
          token_end(b.token_end()),
          brackets(b.brackets),
          blocks(b.blocks),
          in_object(b.in_object),
          in_group(b.in_group),
          in_head(b.in_head) {}
    void restore(TreeBuilder& b) const noexcept {
      b.brackets = brackets;
      b.blocks = blocks;
      b.in_object = in_object;
      b.in_group = in_group;
      b.in_head = in_head;
    }

    NodeIndex nodes;
    std::uint32_t token_end, brackets, blocks;
    bool in_object, in_group, in_head;
  };

  /// Whether the statement at `begin`, in an object, stands where the object should have ended.
  static bool is_shallow(const TreeBuilder& builder, std::uint32_t begin) {
    const std::string_view text = builder.text();
    return is_first_of_line(text, begin) &&
           indent_of_line(text, begin) <= indent_of_line(text, builder.opener);
  }

  /// The next statement from `from` on, and at least one byte behind `begin`.
  static std::uint32_t find_next(TreeBuilder& builder, std::uint32_t begin, std::uint32_t from,
                                 RecoveryOptions options) {
    constexpr std::size_t kMaxPatientErrors = 50;
    options.is_patient = builder.sink().error_count() <= kMaxPatientErrors;
    // Looking back along a line at every mistake takes long, which is worth it for those that are
    // shown.
    if (options.is_patient) options.indent = indent_of_line(builder.text(), begin);
    const std::uint32_t next = next_statement(builder.text(), from, options);
    return next > begin ? next : next_statement(builder.text(), begin + 1, {});
  }

  /// Goes on at `to`. What is left out, from `wrong` on, becomes an Error.
  template <typename Input>
  static void skip_to(Input& in, TreeBuilder& builder, std::uint32_t wrong, std::uint32_t to) {
    to = std::max(to, builder.offset(in.current()));
    const Span span = trim(builder.text(), {wrong, to});
    if (span.size() > 0) builder.push(SyntaxKind::Error, span);
    const std::uint32_t token_end = span.size() > 0 ? span.end : builder.token_end();
    builder.set_last_statement(TreeBuilder::kNone);
    in.bump(to - builder.offset(in.current()));
    static_cast<void>(
        Control<grammar::space>::template match<apply_mode::action, rewind_mode::dontcare, Build,
                                                Control>(in, builder));
    builder.end_token(token_end);
  }
};

#undef SDLC_SURROUND
#undef SDLC_MATCH

}  // namespace sdlc::lang
