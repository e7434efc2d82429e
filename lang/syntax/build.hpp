#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <utility>

#include "grammar/scene.hpp"
#include "lang/repair/recovery.hpp"
#include "lang/source/limits.hpp"
#include "lang/syntax/expected.hpp"
#include "lang/syntax/tree_builder.hpp"
#include "lang/token/lines.hpp"
#include "lang/token/name_characters.hpp"

/// How actions build nodes: the common parts of Build, which runs where a rule matches, and
/// Control, which runs where a committed rule does not match.
namespace sdlc::lang {

namespace pegtl = tao::pegtl;
using pegtl::apply_mode;
using pegtl::rewind_mode;

// Errors at commit points

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
      throw ParseAbandoned{};
    } else if constexpr (std::is_same_v<Rule, grammar::comment_block_end>) {
      const std::uint32_t begin = builder.comment_begin;
      builder.sink().report(diag::unclosed, builder.location({begin, begin + 2}), "/*");
      throw ParseAbandoned{};
    } else {
      // An added bracket was reported as missing; what it ends too soon follows from that.
      if (!builder.is_added(at)) diagnose_expected(builder, at, expected<Rule>);
      throw Reported{};
    }
  }
};

// Building

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

/// A node around the nodes built inside. If `kFirst` is given, one of these characters must come
/// first: most candidates are rejected by their first character.
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

/// A node of a lexical rule, which has no space after it.
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
    // `token_end` is after the colon.
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

/// An operand of a chain; stores the operator before it.
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

/// The content after an opening bracket or a prefix of `kLength` bytes: one level deeper.
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
        builder.sink().report(diag::too_deep, builder.location(opener), kMaxNesting);
        if (kOpener == Opener::Comment) throw ParseAbandoned{};
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
    /// After a mistake inside the bracket stays open: the search for the next statement counts it.
    void leave() noexcept {
      if (kOpener == Opener::Bracket) --builder_.brackets;
    }

   private:
    TreeBuilder& builder_;
    std::uint32_t outer_;
  };
};

}  // namespace sdlc::lang
