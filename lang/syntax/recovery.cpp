#include "lang/syntax/recovery.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "lang/syntax/scan.hpp"

namespace sdlc::lang {
namespace {

constexpr auto kStatementWords = std::to_array<std::string_view>(
    {"import", "include", "param", "let", "fn", "def", "assert", "for", "if"});

enum class Beginning : std::uint8_t {
  None,
  Property,   ///< `name:`, which an argument looks like too
  Statement,  ///< what can stand in no bracket
};

/// What kind of statement the line's first token at `at` looks like the beginning of.
Beginning classify(std::string_view text, std::uint32_t at) {
  const std::uint32_t end = end_of_identifier(text, at);
  if (end == at) return Beginning::None;
  const std::string_view word = text.substr(at, end - at);
  const std::uint32_t next = skip_blanks(text, end);
  const char c = char_at(text, next);
  if (c == ':' || (c == '=' && char_at(text, next + 1) != '=')) return Beginning::Property;
  if (std::find(kStatementWords.begin(), kStatementWords.end(), word) != kStatementWords.end()) {
    return word == "if" ? Beginning::Property : Beginning::Statement;
  }
  if (c == '{') return Beginning::Statement;
  // No expression goes on with a literal: this is a property that lacks its colon.
  if (next > end && (c == '"' || c == '#' || is_digit(c))) return Beginning::Property;
  const std::uint32_t name_end = end_of_identifier(text, next);
  const bool is_named = name_end > next && char_at(text, skip_blanks(text, name_end)) == '{';
  return is_named ? Beginning::Statement : Beginning::None;
}

/// The braces that the text does not close, outermost first.
std::vector<std::uint32_t> unclosed_braces(std::string_view text) {
  std::vector<std::uint32_t> open;
  for (std::uint32_t at = 0; at < text.size();) {
    const std::uint32_t behind = end_of_opaque(text, at);
    if (behind > at) {
      at = behind;
      continue;
    }
    if (text[at] == '{') open.push_back(at);
    if (text[at] == '}' && !open.empty()) open.pop_back();
    ++at;
  }
  return open;
}

/// Looks for the first line that is not indented deeper than the block that it stands in, nor its
/// end.
class IndentScan {
 public:
  explicit IndentScan(std::string_view text) : text_(text) {}

  std::optional<MissingBrace> run(std::uint32_t opener) {
    for (std::uint32_t at = opener; at < text_.size();) {
      if (text_[at] == '\n' && !blocks_.empty() && brackets_ == 0) {
        const std::uint32_t line = at + 1;
        at = skip_blanks(text_, line);
        if (is_shallow(at, at - line)) return missing_before(at);
        continue;
      }
      const std::uint32_t behind = end_of_opaque(text_, at);
      if (behind == at) {
        count_brackets(at);
        if (!is_blank(text_[at])) token_end_ = at + 1;
        ++at;
      } else {
        if (text_[at] == '"') token_end_ = behind;
        at = behind;
      }
    }
    return std::nullopt;
  }

 private:
  struct Block {
    std::uint32_t opener;
    std::uint32_t indent;
  };

  static bool is_blank(char c) noexcept { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

  bool is_shallow(std::uint32_t at, std::uint32_t indent) const {
    const char c = char_at(text_, at);
    const bool is_empty = at >= text_.size() || c == '\n' || end_of_comment(text_, at) > at;
    if (is_empty || c == '{') return false;
    // A closing brace may stand as deep as the line of the opening one.
    if (c == '}') return blocks_.size() > 1 && indent < blocks_.back().indent;
    return indent <= blocks_.back().indent;
  }

  MissingBrace missing_before(std::uint32_t at) const {
    MissingBrace missing{
        .opener = blocks_.back().opener, .before = token_at(text_, at), .mend_at = {}};
    if (is_blank(char_at(text_, token_end_))) missing.mend_at = token_end_;
    return missing;
  }

  void count_brackets(std::uint32_t at) {
    switch (text_[at]) {
      case '{':
        blocks_.push_back({at, indent_of_line(text_, at)});
        brackets_ = 0;
        break;
      case '}':
        if (!blocks_.empty()) blocks_.pop_back();
        brackets_ = 0;
        break;
      case '(':
      case '[': ++brackets_; break;
      case ')':
      case ']': brackets_ -= brackets_ > 0; break;
      default: break;
    }
  }

  std::string_view text_;
  std::vector<Block> blocks_;
  std::uint32_t brackets_ = 0;
  std::uint32_t token_end_ = 0;
};

}  // namespace

std::uint32_t next_statement(std::string_view text, std::uint32_t from, RecoveryOptions options) {
  constexpr std::uint32_t kNowhere = 0xFFFFFFFF;
  // Behind an open bracket a line `name:` may be an argument or the next property; what follows
  // tells.
  constexpr std::uint32_t kLookahead = 4096;

  std::string open(options.open - (options.open_block && options.open > 0 ? 1 : 0), '(');
  if (options.open_block) open += '{';
  std::size_t open_blocks = options.open_block ? 1 : 0;
  std::uint32_t property = kNowhere;

  // Where to go on if a statement begins at `at`, the first token of a line.
  const auto at_line = [&](std::uint32_t at) {
    const Beginning beginning = classify(text, at);
    if (beginning == Beginning::None) return kNowhere;
    if (open.empty()) return at;
    if (open_blocks > 0) return kNowhere;
    if (beginning == Beginning::Statement || !options.is_patient) return std::min(property, at);
    property = std::min(property, at);
    return kNowhere;
  };

  const auto size = static_cast<std::uint32_t>(text.size());
  // The place itself may be the beginning of the next line's statement.
  if (is_first_of_line(text, from)) {
    if (const std::uint32_t found = at_line(from); found != kNowhere) return found;
  }
  for (std::uint32_t at = from; at < size;) {
    if (property != kNowhere && at - property > kLookahead) return property;
    const std::uint32_t behind = end_of_opaque(text, at);
    if (behind > at) {
      // A comment that is never closed is worth an error of its own.
      const bool is_comment = text[at] == '/' && text[at + 1] == '*';
      if (is_comment && behind == size && !text.ends_with("*/")) return at;
      at = behind;
      continue;
    }
    const char c = text[at];
    if (c == '\n') {
      at = skip_blanks(text, at + 1);
      if (const std::uint32_t found = at_line(at); found != kNowhere) return found;
    } else if (c == '(' || c == '[' || c == '{') {
      open += c == '{' ? '{' : '(';
      open_blocks += c == '{';
      ++at;
    } else if (c == ')' || c == ']') {
      if (!open.empty() && open.back() == '(') open.pop_back();
      if (open.empty()) property = kNowhere;
      ++at;
    } else if (c == '}') {
      if (open_blocks == 0) return std::min(property, at);
      open.resize(open.rfind('{'));
      --open_blocks;
      ++at;
    } else if (c == ',' && open.empty()) {
      const std::uint32_t next = skip_blanks(text, at + 1);
      if (classify(text, next) == Beginning::Property) return next;
      ++at;
    } else {
      at = std::max(at + 1, end_of_identifier(text, at));
    }
  }
  return std::min(property, size);
}

bool looks_like_statement(std::string_view text, std::uint32_t at) {
  return classify(text, at) != Beginning::None;
}

Span trim(std::string_view text, Span span) noexcept {
  const auto is_blank = [&](std::uint32_t at) {
    return text[at] == ' ' || text[at] == '\t' || text[at] == '\n' || text[at] == '\r';
  };
  while (span.begin < span.end && is_blank(span.end - 1)) --span.end;
  while (span.begin < span.end && is_blank(span.begin)) ++span.begin;
  return span;
}

MissingBrace find_missing_brace(std::string_view text) {
  const std::vector<std::uint32_t> unclosed = unclosed_braces(text);
  const std::size_t count = std::max<std::size_t>(unclosed.size(), 1);
  const std::uint32_t outermost = unclosed.empty() ? 0 : unclosed.front();
  if (auto missing = IndentScan(text).run(outermost)) return *missing;
  return {.opener = outermost, .before = {}, .mend_at = text.size(), .count = count};
}

void report_missing_brace(const SourceFile& file, const MissingBrace& missing,
                          DiagnosticSink& sink) {
  const Location opener{&file, {missing.opener, missing.opener + 1}};
  if (!missing.before) {
    sink.report(diag::unclosed, opener, "{");
    return;
  }
  const std::uint32_t at = missing.before->begin;
  sink.report(diag::missing_brace, {&file, *missing.before})
      .label(opener, "opened here")
      .help("close the block in front of this line, or indent what belongs to it")
      .fix({&file, {at, at}}, "}\n" + std::string(at - line_begin(file.text(), at), ' '));
}

}  // namespace sdlc::lang
