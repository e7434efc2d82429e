#include "lang/editor/cursor_place.hpp"

#include <algorithm>
#include <string>
#include <unordered_set>

#include "lang/ast/ast.hpp"
#include "lang/editor/cursor.hpp"
#include "lang/editor/place_reader.hpp"
#include "lang/text/brackets.hpp"
#include "lang/token/lines.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

using PlaceKind = CursorPlace::Kind;
using Role = OpenBracket::Role;
using Step = PlaceStep;

/// The top-level statements around the cursor: from the last one that surely begins before it, to
/// the next one.
Span find_surroundings(const SyntaxTree& tree, std::uint32_t offset) {
  const std::string_view text = tree.file().text();
  Span found{0, static_cast<std::uint32_t>(text.size())};
  for (const ast::Node child : ast::Node(tree, 0).children()) {
    const bool is_statement =
        child.kind() >= SyntaxKind::Import && child.kind() <= SyntaxKind::Object;
    const std::uint32_t begin = child.span().begin;
    // A repair can end a statement too early; the rest of it is then indented.
    const bool begins_line = begin == 0 || text[begin - 1] == '\n';
    if (!is_statement || !begins_line) continue;
    if (begin >= offset) return {found.begin, begin};
    found.begin = begin;
  }
  return found;
}

bool are_brackets_paired(std::string_view text, Span span) {
  std::string open;
  TokenReader tokens(text.substr(0, span.end), span.begin);
  for (Token token = tokens.next_solid(); token.kind != TokenKind::End;
       token = tokens.next_solid()) {
    const char c = text[token.span.begin];
    if (token.kind == TokenKind::Open) open += c;
    if (token.kind != TokenKind::Close) continue;
    if (open.empty() || !is_bracket_pair(open.back(), c)) return false;
    open.pop_back();
  }
  return open.empty();
}

/// The kind of place by what comes next; `has_colon`: a colon follows the word.
PlaceKind kind_in_block(const CursorPlace& place, bool has_colon) {
  const OpenBracket& f = place.inner();
  const bool is_head = f.word == "for" || f.word == "if" || f.word == "else" || f.word == "assert";
  switch (f.step) {
    case Step::Start: return PlaceKind::Statement;
    case Step::Path:
    case Step::ObjectName:
    case Step::AfterType: return place.is_first_of_line ? PlaceKind::Statement : PlaceKind::Nothing;
    case Step::PathDot:
    case Step::Dot: return PlaceKind::Member;
    case Step::AfterName: return f.word == "for" ? PlaceKind::In : PlaceKind::Nothing;
    case Step::Type: return PlaceKind::Type;
    case Step::AfterFile: return PlaceKind::As;
    case Step::ImportName: return PlaceKind::ImportName;
    case Step::Operand: return has_colon ? PlaceKind::Statement : PlaceKind::Expression;
    case Step::AfterOperand: {
      const bool is_open =
          !f.conditionals.empty() && f.conditionals.back() != ConditionalPart::Else;
      return is_head || is_open ? PlaceKind::Operator : PlaceKind::Statement;
    }
    case Step::Done: return place.is_first_of_line ? PlaceKind::Statement : PlaceKind::Nothing;
    default: return PlaceKind::Nothing;
  }
}

PlaceKind kind_in_brackets(const CursorPlace& place) {
  const OpenBracket& f = place.inner();
  switch (f.step) {
    case Step::Start:
      if (f.role == Role::Parameters) return PlaceKind::Nothing;
      return f.role == Role::Arguments ? PlaceKind::Argument : PlaceKind::Expression;
    case Step::Operand: return PlaceKind::Expression;
    case Step::AfterOperand: return PlaceKind::Operator;
    case Step::AfterName: return f.word == "for" ? PlaceKind::In : PlaceKind::Nothing;
    case Step::Dot: return PlaceKind::Member;
    case Step::Type: return PlaceKind::Type;
    default: return PlaceKind::Nothing;
  }
}

/// Reads up to the cursor.
class PlaceSearch {
 public:
  PlaceSearch(const SyntaxTree& tree, std::uint32_t offset, Span around)
      : text_(tree.file().text()),
        offset_(offset),
        tokens_(text_, around.begin),
        reader_(text_, !are_brackets_paired(text_, around)) {
    place_.offset = offset;
    place_.word = {offset, offset};
  }

  CursorPlace find() {
    for (;;) {
      const Token token = tokens_.next();
      if (is_cursor_in(token, offset_) || is_begun_color(token)) return finish_inside(token);
      if (token.kind == TokenKind::End || token.span.begin >= offset_) return finish({});
      read(token);
    }
  }

 private:
  /// Whether it is a `#` before the cursor without its digits.
  bool is_begun_color(const Token& token) const {
    return token.span.end == offset_ && text_.substr(token.span.begin, token.span.size()) == "#";
  }

  void read(const Token& token) {
    if (token.kind == TokenKind::LineEnd) {
      line_begin_ = token.span.end;
      is_first_ = true;
    }
    if (is_trivia(token.kind)) return;
    reader_.read(token, is_first_ ? token.span.begin - line_begin_ : PlaceReader::kNotFirst);
    is_first_ = false;
    place_.before = text_.substr(token.span.begin, token.span.size());
  }

  CursorPlace finish_inside(const Token& token) {
    place_.token = token.span;
    if (is_comment(token.kind)) return finish(PlaceKind::Comment, token);
    if (is_name(token.kind)) {
      place_.word = token.span;
      return finish(token);
    }
    if (token.kind == TokenKind::Number) return finish(PlaceKind::Number, token);
    if (token.kind == TokenKind::Color || is_begun_color(token)) {
      CursorPlace place = finish(PlaceKind::Color, token);
      if (!begins_value(place.inner())) place.kind = PlaceKind::Nothing;
      return place;
    }
    const bool is_file_name = is_string(token.kind) && step_at(token) == Step::File;
    if (is_file_name) return finish(PlaceKind::FileName, token);
    const bool is_inside = is_string(token.kind) || !is_trivia(token.kind);
    return is_inside ? finish(PlaceKind::Nothing, token) : finish({});
  }

  static bool begins_value(const OpenBracket& inner) {
    const bool is_element = !inner.is_block() && inner.role != Role::Parameters;
    return inner.step == Step::Operand || (inner.step == Step::Start && is_element);
  }

  Step step_at(const Token& token) {
    enter_line(token.span.begin);
    return reader_.brackets().back().step;
  }

  /// Closes the brackets that end before the line of the cursor.
  void enter_line(std::uint32_t at) {
    if (is_first_) reader_.leave_lines(at - line_begin_, at < text_.size() ? text_[at] : '\0');
  }

  CursorPlace finish(PlaceKind kind, const Token& token) {
    CursorPlace place = finish(token);
    place.kind = kind;
    return place;
  }

  CursorPlace finish(const Token& token) {
    const bool has_word = token.span.size() > 0;
    // An empty line after the one with the bracket: its indentation is not typed yet.
    const bool is_fresh = !has_word && is_after_bracket();
    if (!is_fresh) enter_line(has_word ? token.span.begin : offset_);
    place_.is_first_of_line = is_first_;
    place_.brackets = std::move(reader_.brackets());
    const bool has_colon = has_colon_after(text_, place_.word.end);
    const OpenBracket& inner = place_.inner();
    place_.kind = inner.is_block() ? kind_in_block(place_, has_colon) : kind_in_brackets(place_);
    place_.is_first_of_statement = inner.step == Step::PathDot;
    return std::move(place_);
  }

  bool is_after_bracket() const {
    return !place_.before.empty() && (place_.before == "{" || place_.before == "(");
  }

  std::string_view text_;
  std::uint32_t offset_;
  TokenReader tokens_;
  PlaceReader reader_;
  std::uint32_t line_begin_ = tokens_.at();
  bool is_first_ = true;
  CursorPlace place_;
};

}  // namespace

bool is_cursor_in(const Token& token, std::uint32_t offset) {
  if (token.span.begin >= offset || offset > token.span.end) return false;
  if (offset < token.span.end) return true;
  switch (token.kind) {
    case TokenKind::Name:
    case TokenKind::ForeignName:
    case TokenKind::Number:
    case TokenKind::Color:
    case TokenKind::LineComment:
    case TokenKind::DocComment:
    case TokenKind::UnclosedComment:
    case TokenKind::UnclosedString: return true;
    default: return false;
  }
}

CursorPlace find_cursor_place(const SyntaxTree& tree, std::uint32_t offset) {
  const auto size = static_cast<std::uint32_t>(tree.file().text().size());
  offset = std::min(offset, size);
  return PlaceSearch(tree, offset, find_surroundings(tree, offset)).find();
}

std::vector<std::string_view> labels_after(const CursorPlace& place, std::string_view text) {
  constexpr int kMaxTokens = 4096;
  std::vector<std::string_view> labels;
  TokenReader tokens(text, std::max(place.offset, place.word.end));
  std::uint32_t depth = 0;
  bool is_first = false;
  Token last;
  for (int i = 0; i < kMaxTokens; ++i) {
    const Token token = tokens.next_in_line();
    if (token.kind == TokenKind::End) break;
    if (token.kind == TokenKind::LineEnd) is_first = true;
    if (is_trivia(token.kind)) continue;
    // The bracket is not closed.
    const bool is_outside = is_first && token.kind != TokenKind::Close &&
                            indent_of_line(text, token.span.begin) <= place.inner().indent;
    if (is_outside) break;
    is_first = false;
    if (token.kind == TokenKind::Open) ++depth;
    if (token.kind == TokenKind::Close && depth-- == 0) break;
    const bool is_label = depth == 0 && is_name(last.kind) && tokens.text(token) == ":";
    if (is_label) labels.push_back(tokens.text(last));
    last = token;
  }
  return labels;
}

std::vector<VisibleLocal> visible_locals(const CursorPlace& place) {
  std::vector<VisibleLocal> found;
  std::unordered_set<std::string_view> names;
  std::uint32_t depth = 0;
  const auto add = [&](const LocalName& local) {
    if (names.insert(local.name).second) found.push_back({local, depth});
  };
  const auto add_all = [&](const std::vector<LocalName>& locals, std::size_t without = 0) {
    for (std::size_t i = locals.size() - without; i > 0; --i) add(locals[i - 1]);
  };
  for (std::size_t i = place.brackets.size(); i > 0; --i) {
    const OpenBracket& f = place.brackets[i - 1];
    if (f.word == "fn" || f.word == "def") add_all(f.declared);
    // A default can use the parameters before it.
    const bool is_typing = f.role == Role::Parameters && f.step != Step::Start;
    add_all(f.locals, is_typing && !f.locals.empty() ? 1 : 0);
    if (f.is_block()) ++depth;
  }
  return found;
}

}  // namespace sdlc::lang
