#pragma once

#include <algorithm>
#include <utility>

#include "lang/repair/recovery.hpp"
#include "lang/syntax/actions.hpp"
#include "lang/token/lines.hpp"

/// The actions of blocks and statements, with recovery after a mistake. Included by parse.cpp
/// alone: the grammar is compiled once.
namespace sdlc::lang {

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
  /// Whether the object is a group, the only kind that contains statements. Its node is followed by
  /// that of its name, if it has one.
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
    builder.is_foreign = true;
    throw ParseAbandoned{};
  }
};

/// A statement, or text in place of one: this matches until the block's `}` or the end of the text.
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
            builder.node(before.nodes).kind != SyntaxKind::Property && is_shallow(builder, begin)) {
          builder.misplaced.push_back(begin);
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

  /// Whether the statement at `begin`, in an object, is indented no deeper than the object.
  static bool is_shallow(const TreeBuilder& builder, std::uint32_t begin) {
    const std::string_view text = builder.text();
    return is_first_of_line(text, begin) &&
           indent_of_line(text, begin) <= indent_of_line(text, builder.opener);
  }

  /// The next statement from `from` on, at least one byte after `begin`.
  static std::uint32_t find_next(TreeBuilder& builder, std::uint32_t begin, std::uint32_t from,
                                 RecoveryOptions options) {
    constexpr std::size_t kMaxPatientErrors = 50;
    options.is_patient = builder.sink().error_count() <= kMaxPatientErrors;
    // Searching back for the line start is slow on long lines: only for the first errors.
    if (options.is_patient) options.indent = indent_of_line(builder.text(), begin);
    const std::uint32_t next = next_statement(builder.text(), from, options);
    return next > begin ? next : next_statement(builder.text(), begin + 1, {});
  }

  /// Continues at `to`. The text skipped from `wrong` on becomes an Error.
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
