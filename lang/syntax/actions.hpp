#pragma once

#include "lang/repair/recovery.hpp"
#include "lang/syntax/build.hpp"
#include "lang/token/name_characters.hpp"

/// The actions of expressions and literals, and the nodes of all rules.
namespace sdlc::lang {

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
template <> struct Build<grammar::for_>             : Node<SyntaxKind::For, 'f'> {};
template <> struct Build<grammar::pattern_name>     : Leaf<SyntaxKind::Name> {};
template <> struct Build<grammar::pattern_inside>   : Nest<Opener::Bracket, 1> {};
template <> struct Build<grammar::pattern_row>      : Node<SyntaxKind::RowPattern, '('> {};
template <> struct Build<grammar::pattern>          : Node<SyntaxKind::Pattern> {};
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
template <> struct Build<grammar::let_in_inside>    : Nest<Opener::Word, 3> {};
template <> struct Build<grammar::binding_name>     : Leaf<SyntaxKind::Name> {};
template <> struct Build<grammar::binding>          : Node<SyntaxKind::Binding> {};
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
template <> struct Build<grammar::for_clause>       : Node<SyntaxKind::ForClause, 'f'> {};
template <> struct Build<grammar::if_clause>        : Node<SyntaxKind::IfClause, 'i'> {};
template <> struct Build<grammar::literal_true>     : LexicalLeaf<SyntaxKind::True> {};
template <> struct Build<grammar::literal_false>    : LexicalLeaf<SyntaxKind::False> {};
template <> struct Build<grammar::comment_block_inside> : Nest<Opener::Comment, 2> {};
// clang-format on

/// The one place that all tokens pass.
template <>
struct Build<grammar::space> : pegtl::maybe_nothing {
  SDLC_SURROUND {
    builder.end_token(builder.offset(in.current()));
    // Fast path: most space is one blank or none. The grammar handles comments and CR.
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
  /// Whether the next line's statement begins here, and the value is missing.
  static bool begins_object(const TreeBuilder& builder, std::uint32_t at) {
    if (builder.in_head) return false;
    const std::string_view text = builder.text();
    const std::uint32_t end = builder.token_end();
    if (text.substr(end, at - end).find('\n') == std::string_view::npos) return false;
    return looks_like_object(text, at);
  }
};

/// `let … in …`, but not the statement of the next line if the value before it is missing.
template <>
struct Build<grammar::let_in> : Node<SyntaxKind::LetIn, 'l'> {
  SDLC_SURROUND {
    if (in.empty() || in.peek_char() != 'l') return false;
    const std::uint32_t begin = builder.offset(in.current());
    if (is_first_of_line(builder.text(), begin) && !has_in(builder.text(), begin)) return false;
    return Node::match<Rule, A, M, Action, Ctrl>(in, builder);
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

/// A list with clauses is a comprehension.
template <>
struct Build<grammar::list> : pegtl::maybe_nothing {
  SDLC_SURROUND {
    if (in.empty() || in.peek_char() != '[') return false;
    OpenNode node(builder, SyntaxKind::List, builder.offset(in.current()));
    if (!SDLC_MATCH) {
      node.discard();
      return false;
    }
    const NodeIndex second = node.index() + 1 + element_extent(builder, node.index() + 1);
    if (second < builder.size() && builder.node(second).kind == SyntaxKind::ForClause) {
      builder.node(node.index()).kind = SyntaxKind::Comprehension;
    }
    return true;
  }

 private:
  static std::uint32_t element_extent(TreeBuilder& builder, NodeIndex element) {
    return element < builder.size() ? builder.node(element).extent : 0;
  }
};

// Wrong literals are reported and skipped: the text around them is read as usual.

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

}  // namespace sdlc::lang
