#include "lang/json/mend_brackets.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "lang/source/limits.hpp"
#include "lang/text/brackets.hpp"
#include "lang/token/lines.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

/// Classifies the tokens of a config by their role in its layout; trivia is left out.
class Classifier {
 public:
  explicit Classifier(std::string_view text) : text_(text), reader_(text, 0, SourceFormat::Json) {}

  std::vector<LayoutToken> run() {
    for (Token token = reader_.next(); token.kind != TokenKind::End; token = reader_.next()) {
      // Where a quote or the end of a comment is missing no one knows which brackets are text.
      const bool is_open =
          token.kind == TokenKind::UnclosedComment || (is_quote(token) && !is_closed(token));
      if (is_open) return {};
      is_trivia(token.kind) ? skip(token) : read(token);
    }
    if (tokens_.empty() || tokens_[0].bracket != '{') return {};
    deepen_members();
    mark();
    return std::move(tokens_);
  }

 private:
  bool is_quote(const Token& token) const { return text_[token.span.begin] == '"'; }
  static bool is_closed(const Token& token) { return token.kind == TokenKind::String; }
  bool is_mark(const Token& token) const {
    return std::string_view("{}[],:").find(text_[token.span.begin]) != std::string_view::npos;
  }

  void skip(const Token& trivia) {
    if (trivia.kind == TokenKind::LineEnd) {
      ++line_;
      indent_ = skip_blanks(text_, trivia.span.end) - trivia.span.end;
      is_first_ = true;
    } else if (trivia.kind == TokenKind::BlockComment) {
      const std::string_view comment = reader_.text(trivia);
      line_ += static_cast<std::uint32_t>(std::count(comment.begin(), comment.end(), '\n'));
    }
  }

  void read(const Token& token) {
    const char c = text_[token.span.begin];
    const bool opens = c == '{' || c == '[', closes = c == '}' || c == ']';
    if (opens || closes || c == ',') {
      add(token.span, opens ? LayoutKind::Open : closes ? LayoutKind::Close : LayoutKind::Comma);
      if (c != ',') tokens_.back().bracket = c;
      return;
    }
    if (c == ':') return add(token.span, LayoutKind::Label);
    const std::uint32_t end = is_quote(token) ? token.span.end : end_of_run();
    const std::uint32_t colon = skip_blanks(text_, end);
    const bool is_label = colon < text_.size() && text_[colon] == ':';
    add({token.span.begin, is_label ? colon + 1 : end},
        is_label ? LayoutKind::Label : LayoutKind::Value);
  }

  /// Words, numbers and signs with nothing between them are one value.
  std::uint32_t end_of_run() const {
    TokenReader ahead = reader_;
    std::uint32_t end = ahead.at();
    for (Token token = ahead.next(); token.kind != TokenKind::End; token = ahead.next()) {
      if (is_trivia(token.kind) || is_mark(token) || is_quote(token)) break;
      end = token.span.end;
    }
    return end;
  }

  void add(Span span, LayoutKind kind) {
    tokens_.push_back({.begin = span.begin,
                       .end = span.end,
                       .line = line_,
                       .indent = indent_,
                       .kind = kind,
                       .is_first = is_first_});
    is_first_ = false;
    reader_.seek(span.end);
  }

  /// Members that stand below the config's bracket, not further in, are inside all the same.
  void deepen_members() {
    const auto is_member = [&](const LayoutToken& token) {
      return token.kind == LayoutKind::Label && token.is_first && token.line > 0 &&
             token.indent == 0;
    };
    if (std::ranges::none_of(tokens_, is_member)) return;
    for (LayoutToken& token : tokens_) {
      const bool is_end = &token == &tokens_.back() && token.kind == LayoutKind::Close;
      if (token.line > tokens_.front().line && !is_end) ++token.indent;
    }
  }

  /// What each token is among its neighbours: an object has labels, and a value behind each.
  void mark() {
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      LayoutToken& token = tokens_[i];
      const LayoutToken* last = i == 0 ? nullptr : &tokens_[i - 1];
      const bool is_value = token.kind == LayoutKind::Value || token.kind == LayoutKind::Open;
      const bool is_behind_label = last != nullptr && last->kind == LayoutKind::Label;
      token.continues = token.kind == LayoutKind::Comma || is_behind_label;
      token.is_stray = is_value && !is_behind_label && last != nullptr;
      token.may_open = is_value && is_behind_label && token.bracket != '[';
      if (token.kind == LayoutKind::Label && is_behind_label) token.wanted = '{';
    }
  }

  std::string_view text_;
  TokenReader reader_;
  std::vector<LayoutToken> tokens_;
  std::uint32_t line_ = 0, indent_ = 0;
  bool is_first_ = true;
};

class Report {
 public:
  Report(const SourceFile& file, const std::vector<LayoutToken>& tokens, DiagnosticSink& sink)
      : file_(file), tokens_(tokens), sink_(sink) {}

  void run(const std::vector<BracketFault>& faults) {
    for (std::size_t i = 0; i < faults.size(); ++i) {
      if (i + 1 < faults.size() && is_wrong_close(faults[i], faults[i + 1])) {
        wrong(faults[i].token, faults[i + 1].partner, faults[i + 1].bracket);
        ++i;
      } else if (faults[i].kind == BracketFault::Surplus) {
        // Of a bracket in another's place it has been told what it should be.
        if (i == 0 || faults[i - 1].token != faults[i].token) surplus(faults[i]);
      } else if (faults[i].kind == BracketFault::MissingMark) {
        continue;  // it belongs to the bracket
      } else if (faults[i].token == tokens_.size()) {
        return missing_at_end(faults, i);
      } else {
        missing(faults[i]);
      }
    }
  }

  void wrong(std::uint32_t close, std::uint32_t open, char bracket) {
    sink_
        .report(diag::expected, at(close),
                fmt::format("`{}`, found `{}`", bracket, text(tokens_[close])))
        .label(at(open), "opened here")
        .unsafe_fix(at(close), std::string(1, bracket));
  }

 private:
  /// One bracket too many where another is missing.
  static bool is_wrong_close(const BracketFault& fault, const BracketFault& next) {
    return fault.kind == BracketFault::Surplus && (fault.bracket == '}' || fault.bracket == ']') &&
           next.kind == BracketFault::MissingClose && next.token == fault.token + 1 &&
           next.partner != BracketFault::kNone;
  }

  Location at(std::uint32_t token) const {
    return {&file_, {tokens_[token].begin, tokens_[token].end}};
  }

  void surplus(const BracketFault& fault) {
    const std::string_view bracket(&fault.bracket, 1);
    const bool opens = fault.bracket == '{' || fault.bracket == '[';
    auto report = opens ? sink_.report(diag::unclosed, at(fault.token), bracket)
                        : sink_.report(diag::unmatched, at(fault.token), bracket);
    report.unsafe_fix(at(fault.token), "");
  }

  /// At the end of the line before, unless the bracket belongs into a line of its own.
  void missing(const BracketFault& fault) {
    const bool has_partner = fault.partner != BracketFault::kNone;
    const bool closes = fault.kind == BracketFault::MissingClose;
    const LayoutToken& token = tokens_[fault.token];
    const bool has_lines = closes && has_partner && fault.partner + 1 < fault.token &&
                           tokens_[fault.partner + 1].is_first;
    const LayoutToken& last = tokens_[fault.token - 1];
    const bool is_apart = !closes && last.kind != LayoutKind::Label;
    const bool ends_line = token.is_first && !has_lines && !is_apart;
    const std::string found = ends_line ? "the end of the line" : fmt::format("`{}`", text(token));
    const std::uint32_t end = last.end;
    const Location gap{&file_, {end, end}};
    auto report = sink_.report(diag::expected, ends_line ? gap : at(fault.token),
                               fmt::format("`{}`, found {}", fault.bracket, found));
    if (has_partner) report.label(at(fault.partner), closes ? "opened here" : "closed here");
    const std::uint32_t place = closes ? end : token.begin;
    report.unsafe_fix({&file_, {place, place}}, std::string(1, fault.bracket));
  }

  void missing_at_end(const std::vector<BracketFault>& faults, std::size_t first) {
    const LayoutToken& last = tokens_.back();
    const BracketFault& fault = faults[first];
    std::uint32_t place = last.end;
    const std::size_t line_end = file_.text().find('\n', place);
    const bool has_lines = fault.partner != BracketFault::kNone &&
                           tokens_[fault.partner].line < last.line &&
                           line_end != std::string_view::npos;
    if (has_lines) place = static_cast<std::uint32_t>(line_end + 1);
    std::string closing;
    for (std::size_t i = first; i < faults.size(); ++i) closing += faults[i].bracket;
    const Location where{&file_, {place, place}};
    auto report = sink_.report(diag::expected, where,
                               fmt::format("`{}`, found the end of the file", fault.bracket));
    for (std::size_t i = first; i < faults.size(); ++i) {
      if (faults[i].partner != BracketFault::kNone) {
        report.label(at(faults[i].partner), "opened here");
      }
    }
    report.unsafe_fix(where, closing);
  }

  std::string_view text(const LayoutToken& token) const {
    return file_.text().substr(token.begin, token.end - token.begin);
  }

  const SourceFile& file_;
  const std::vector<LayoutToken>& tokens_;
  DiagnosticSink& sink_;
};

/// A bracket that is lost with its line took the comma along.
void add_commas(const std::vector<LayoutToken>& tokens, std::vector<BracketFault>& faults) {
  for (std::size_t i = 0; i < faults.size(); ++i) {
    const BracketFault fault = faults[i];
    if (fault.kind != BracketFault::MissingClose || fault.token == tokens.size()) continue;
    const bool is_last = i + 1 == faults.size() || faults[i + 1].token != fault.token;
    const LayoutKind next = tokens[fault.token].kind;
    if (!is_last || next == LayoutKind::Comma || next == LayoutKind::Close) continue;
    const BracketFault comma{
        .kind = BracketFault::MissingMark, .bracket = ',', .token = fault.token};
    faults.insert(faults.begin() + static_cast<std::ptrdiff_t>(++i), comma);
  }
}

/// Such a text is not read to its end anyway.
bool is_too_deep(const std::vector<LayoutToken>& tokens) noexcept {
  int depth = 0;
  for (const LayoutToken& token : tokens) {
    if (token.kind == LayoutKind::Open && ++depth > kMaxNesting) return true;
    if (token.kind == LayoutKind::Close && depth > 0) --depth;
  }
  return false;
}

struct Pair {
  std::uint32_t open, close;
};

/// The pairs whose closing bracket is of the other kind, where nothing else is wrong with the
/// brackets and the lines say so too; else none.
std::vector<Pair> wrong_pairs(const std::vector<LayoutToken>& tokens) {
  std::vector<Pair> pairs;
  std::vector<std::uint32_t> open;
  for (std::uint32_t i = 0; i < tokens.size(); ++i) {
    const LayoutToken& token = tokens[i];
    if (token.kind == LayoutKind::Open) open.push_back(i);
    const bool is_label = token.kind == LayoutKind::Label;
    if (is_label && !open.empty() && tokens[open.back()].bracket == '[') return {};
    if (token.kind != LayoutKind::Close) continue;
    if (open.empty()) return {};
    const LayoutToken& opening = tokens[open.back()];
    if (token.bracket != closing_bracket(opening.bracket)) {
      const bool is_in_line =
          token.line == opening.line || (token.is_first && token.indent == opening.indent);
      const bool has_labels = tokens[open.back() + 1].kind == LayoutKind::Label;
      if (!is_in_line || has_labels != (opening.bracket == '{')) return {};
      pairs.push_back({open.back(), i});
    }
    open.pop_back();
  }
  return open.empty() ? pairs : std::vector<Pair>();
}

}  // namespace

std::optional<MendedText> mend_brackets(const SourceFile& file, std::optional<std::string>& mended,
                                        DiagnosticSink& sink) {
  const std::string_view text = mended ? std::string_view(*mended) : file.text();
  if (text.size() > kMaxMendedText) return std::nullopt;
  const std::vector<LayoutToken> tokens = Classifier(text).run();
  if (has_matching_brackets(tokens) || is_too_deep(tokens)) return std::nullopt;

  Report report(file, tokens, sink);
  if (const auto pairs = wrong_pairs(tokens); !pairs.empty()) {
    if (!mended) mended.emplace(text);
    for (const auto& [open, close] : pairs) {
      const char bracket = closing_bracket(tokens[open].bracket);
      report.wrong(close, open, bracket);
      (*mended)[tokens[close].begin] = bracket;
    }
    return std::nullopt;
  }
  BracketRepair repair = repair_brackets(tokens, BlockPlace::Values);
  if (repair.faults.empty()) return std::nullopt;
  add_commas(tokens, repair.faults);
  report.run(repair.faults);
  return MendedText(text, tokens, repair);
}

}  // namespace sdlc::lang
