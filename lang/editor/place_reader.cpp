#include "lang/editor/place_reader.hpp"

#include <algorithm>
#include <array>

#include "lang/repair/recovery.hpp"
#include "lang/source/limits.hpp"
#include "lang/text/brackets.hpp"

namespace sdlc::lang {
namespace {

using Role = OpenBracket::Role;
using Step = PlaceStep;

template <std::size_t N>
bool is_any_of(std::string_view word, const std::array<std::string_view, N>& words) {
  return std::ranges::find(words, word) != words.end();
}

constexpr std::array<std::string_view, 5> kDeclarations{"let", "param", "fn", "def", "for"};
constexpr std::array<std::string_view, 2> kFileWords{"import", "include"};

/// The words that begin a statement wherever they are.
bool is_statement_word(std::string_view word) {
  return is_any_of(word, kDeclarations) || is_any_of(word, kFileWords) || word == "assert";
}

}  // namespace

PlaceReader::PlaceReader(std::string_view text, bool is_broken)
    : text_(text), is_broken_(is_broken), brackets_(1) {}

std::string_view PlaceReader::next_after(const Token& token) const {
  TokenReader reader(text_, token.span.end);
  return reader.text(reader.next_solid());
}

void PlaceReader::leave_lines(std::uint32_t indent, char first) {
  if (!is_broken_) return;
  while (brackets_.size() > 1 && indent <= top().indent &&
         !is_bracket_pair(text_[top().at], first)) {
    close(closing_bracket(text_[top().at]));
  }
}

void PlaceReader::read(const Token& token, std::uint32_t indent) {
  const char first = text_[token.span.begin];
  is_first_ = indent != kNotFirst;
  if (is_first_) {
    indent_ = indent;
    leave_lines(indent, first);
  }
  if (token.kind == TokenKind::Close) return close(first);
  switch (top().step) {
    case Step::Start: return read_start(token);
    case Step::Path:
    case Step::PathDot:
    case Step::ObjectName: return read_path(token);
    case Step::Operand: return read_operand(token);
    case Step::AfterOperand:
    case Step::Dot: return read_after_operand(token);
    default: return read_declaration(token);
  }
}

void PlaceReader::read_start(const Token& token) {
  OpenBracket& f = top();
  f.begin = token.span.begin;
  if (is_name(token.kind) && f.is_block()) return begin_statement(token);
  const std::string_view word = text_.substr(token.span.begin, token.span.size());
  if (is_name(token.kind) && f.role == Role::Parameters) {
    f.locals.push_back({.name = word, .where = token.span, .is_parameter = true});
    f.step = Step::AfterName;
    return;
  }
  if (is_name(token.kind) && f.role == Role::Arguments) {
    const std::string_view next = next_after(token);
    if (next == ":" || next == "=") return set_label(word);
  }
  if (word == ",") return read_comma();
  f.step = Step::Operand;
  read_operand(token);
}

void PlaceReader::begin_statement(const Token& token) {
  OpenBracket& f = top();
  const std::string_view word = text_.substr(token.span.begin, token.span.size());
  const bool is_label = next_after(token) == ":";
  if (is_label) return set_label(word);
  if (word == "scene" && f.role == Role::File && !f.has_statements) {
    f.step = Step::Done;
    return;
  }
  f.has_statements = true;
  f.word = word;
  if (is_any_of(word, kDeclarations)) {
    f.step = Step::DeclaredName;
  } else if (is_any_of(word, kFileWords)) {
    f.step = Step::File;
  } else if (word == "if" || word == "assert" || word == "else") {
    f.step = word == "else" ? Step::AfterOperand : Step::Operand;
    f.path = {};
  } else {
    f.word = {};
    f.path = token.span;
    f.step = Step::Path;
  }
}

void PlaceReader::set_label(std::string_view label) {
  OpenBracket& f = top();
  f.label = label;
  f.labels.push_back(label);
  f.step = Step::AfterLabel;
}

/// After the path or the name at the beginning of a statement.
void PlaceReader::read_path(const Token& token) {
  OpenBracket& f = top();
  const std::string_view word = text_.substr(token.span.begin, token.span.size());
  if (word == "." && f.step == Step::Path) {
    f.step = Step::PathDot;
  } else if (f.step == Step::PathDot) {
    f.step = Step::Path;
    if (is_name(token.kind)) f.path.end = token.span.end;
  } else if (word == "{") {
    open(Role::Block, token, f.path);
  } else if (is_name(token.kind)) {
    if (is_first_ || f.step == Step::ObjectName) return restart(token);
    f.step = Step::ObjectName;
  } else if (word == "=" || word == ":") {
    // `radius = 1` is a habit from other languages.
    f.label = text_.substr(f.path.begin, f.path.size());
    f.labels.push_back(f.label);
    f.step = Step::Operand;
  } else {
    f.step = Step::AfterOperand;
    read_after_operand(token);
  }
}

/// Inside the fixed parts of a statement.
void PlaceReader::read_declaration(const Token& token) {
  OpenBracket& f = top();
  const std::string_view word = text_.substr(token.span.begin, token.span.size());
  switch (f.step) {
    case Step::DeclaredName:
      if (f.word == "for" && word == "(") return open(Role::Parameters, token);
      if (!is_name(token.kind)) break;
      f.name = word;
      if (f.word == "for" || f.word == "let") {
        (f.is_block() ? f.declared : f.locals).push_back({.name = word, .where = token.span});
      }
      f.step = Step::AfterName;
      return;
    case Step::AfterName:
      if (f.word != "for" || word != ",") break;
      f.step = Step::DeclaredName;
      return;
    case Step::AfterLabel: f.step = Step::Operand; return;
    case Step::Type:
      if (is_name(token.kind)) {
        (f.role == Role::Parameters ? f.locals.back().type : f.type) = word;
        f.step = Step::AfterType;
        return;
      }
      break;
    case Step::File:
      if (!is_string(token.kind)) break;
      f.path = token.span;
      if (f.word == "include") return end_statement(f);
      f.step = Step::AfterFile;
      return;
    case Step::AfterFile:
      if (word == "as") {
        f.step = Step::ImportName;
        return;
      }
      break;
    case Step::ImportName:
    case Step::Done: return is_first_ ? restart(token) : end_statement(f);
    default: break;
  }
  if (word == ":") {
    f.step = Step::Type;
  } else if (word == "=" || word == "in") {
    f.step = Step::Operand;
  } else if (word == "(" && f.step == Step::AfterName && f.role != Role::Parameters) {
    open(Role::Parameters, token);
  } else if (word == ",") {
    read_comma();
  } else if (word == "{") {
    open_block(token);
  } else if (f.is_block() && is_name(token.kind)) {
    restart(token);
  }
}

/// Whether a statement begins where a value is missing.
bool PlaceReader::begins_statement(const Token& token) const {
  if (!brackets_.back().is_block()) return false;
  const std::string_view word = text_.substr(token.span.begin, token.span.size());
  if (next_after(token) == ":" || is_statement_word(word)) return true;
  const bool is_head = brackets_.back().word == "for" || brackets_.back().word == "if";
  return is_first_ && !is_head && looks_like_object(text_, token.span.begin);
}

void PlaceReader::read_operand(const Token& token) {
  OpenBracket& f = top();
  switch (text_[token.span.begin]) {
    case '(': return open(Role::Parenthesis, token);
    case '[': return open(Role::List, token);
    case '{': return open_block(token);
    case ',': return read_comma();
    default: break;
  }
  if (is_name(token.kind)) return read_name_as_operand(token);
  if (token.kind == TokenKind::Number || is_string(token.kind) || token.kind == TokenKind::Color) {
    f.path = {};
    f.step = Step::AfterOperand;
  }
}

void PlaceReader::read_name_as_operand(const Token& token) {
  OpenBracket& f = top();
  const std::string_view word = text_.substr(token.span.begin, token.span.size());
  if (begins_statement(token)) return restart(token);
  if (word == "if") {
    f.conditionals.push_back(ConditionalPart::Condition);
  } else if (word != "not" && !read_link_word(word)) {
    f.path = token.span;
    f.step = Step::AfterOperand;
  }
}

/// Reads a word that joins operands; false for other words.
bool PlaceReader::read_link_word(std::string_view word) {
  OpenBracket& f = top();
  if (word == "then" || word == "else") {
    if (f.conditionals.empty()) return false;
    if (word == "else" && f.conditionals.back() == ConditionalPart::Else &&
        f.conditionals.size() > 1) {
      f.conditionals.pop_back();
    }
    f.conditionals.back() = word == "then" ? ConditionalPart::Then : ConditionalPart::Else;
  } else if (word != "and" && word != "or" && word != "in") {
    return false;
  }
  f.step = Step::Operand;
  return true;
}

void PlaceReader::read_after_operand(const Token& token) {
  OpenBracket& f = top();
  const std::string_view word = text_.substr(token.span.begin, token.span.size());
  if (f.step == Step::Dot) {
    f.step = Step::AfterOperand;
    if (is_name(token.kind)) {
      if (f.path.size() > 0) f.path.end = token.span.end;
      return;
    }
  }
  if (is_name(token.kind)) return read_name_after_operand(token);
  switch (text_[token.span.begin]) {
    case '(':
      return f.path.size() > 0 ? open(Role::Arguments, token, f.path)
                               : open(Role::Parenthesis, token);
    case '[': return open(Role::Index, token);
    case '{': return open_block(token);
    case ',': return read_comma();
    default: break;
  }
  if (word == ".") {
    f.step = Step::Dot;
  } else if (token.kind == TokenKind::Mark || token.kind == TokenKind::Unknown) {
    f.step = Step::Operand;
  }
}

void PlaceReader::read_name_after_operand(const Token& token) {
  OpenBracket& f = top();
  const std::string_view word = text_.substr(token.span.begin, token.span.size());
  if (f.role == Role::List && f.conditionals.empty() && (word == "for" || word == "if")) {
    f.word = word;
    f.step = word == "for" ? Step::DeclaredName : Step::Operand;
  } else if (f.word == "else" && word == "if" && f.path.size() == 0) {
    f.word = word;
    f.step = Step::Operand;
  } else if (!read_link_word(word)) {
    if (f.is_block()) return restart(token);
    f.path = token.span;
  }
}

void PlaceReader::read_comma() {
  OpenBracket& f = top();
  if (f.is_block() && (f.word != "assert" || f.commas > 0)) return end_statement(f);
  ++f.commas;
  f.label = {};
  f.conditionals.clear();
  f.path = {};
  f.step = f.is_block() ? Step::Operand : Step::Start;
}

void PlaceReader::open(Role role, const Token& bracket, Span head) {
  // The parser refuses deeper nesting.
  if (brackets_.size() > kMaxNesting) {
    ++deeper_;
    return;
  }
  brackets_.push_back({.role = role, .head = head, .at = bracket.span.begin, .indent = indent_});
  if (!brackets_.back().is_block()) return;
  const OpenBracket& around = brackets_[brackets_.size() - 2];
  if (around.word != "let") brackets_.back().locals = around.declared;
}

void PlaceReader::open_block(const Token& bracket) {
  OpenBracket& f = top();
  const auto size = static_cast<std::uint32_t>(f.word.size());
  const auto begin = size == 0 ? 0u : static_cast<std::uint32_t>(f.word.data() - text_.data());
  const bool has_block = f.word == "for" || f.word == "if" || f.word == "else" || f.word == "def";
  open(Role::Block, bracket, has_block ? Span{begin, begin + size} : f.path);
}

void PlaceReader::close(char bracket) {
  if (deeper_ > 0) {
    --deeper_;
    return;
  }
  const auto found = std::find_if(brackets_.rbegin(), brackets_.rend() - 1, [&](const auto& open) {
    return is_bracket_pair(text_[open.at], bracket);
  });
  if (found == brackets_.rend() - 1) return;
  const Role role = found->role;
  std::vector<LocalName> locals = std::move(found->locals);
  brackets_.erase(found.base() - 1, brackets_.end());
  OpenBracket& f = top();
  if (role == Role::Parameters && f.word == "for") {
    auto& names = f.is_block() ? f.declared : f.locals;
    names.insert(names.end(), locals.begin(), locals.end());
    f.step = Step::AfterName;
  } else if (role == Role::Parameters) {
    f.declared = std::move(locals);
    f.step = Step::AfterParameters;
  } else if (role == Role::Block && f.is_block()) {
    end_statement(f);
  } else {
    f.path = {};
    f.step = Step::AfterOperand;
  }
}

void PlaceReader::end_statement(OpenBracket& f) {
  const bool is_local = f.role == Role::Block && f.word == "let";
  if (is_local) f.locals.insert(f.locals.end(), f.declared.begin(), f.declared.end());
  f.declared.clear();
  f.previous = f.word;
  f.word = f.name = f.type = f.label = {};
  f.path = {};
  f.commas = 0;
  f.conditionals.clear();
  f.step = Step::Start;
}

/// The token begins the next statement.
void PlaceReader::restart(const Token& token) {
  end_statement(top());
  read_start(token);
}

}  // namespace sdlc::lang
