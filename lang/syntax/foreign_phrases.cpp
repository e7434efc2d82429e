#include "lang/syntax/foreign_phrases.hpp"

#include <algorithm>
#include <cstddef>
#include <set>

#include <fmt/format.h>

#include "lang/schema/schema.hpp"
#include "lang/schema/type_names.hpp"
#include "lang/syntax/certainty.hpp"
#include "lang/syntax/foreign_words.hpp"
#include "lang/syntax/token_editor.hpp"
#include "lang/syntax/vocabulary.hpp"
#include "lang/text/ascii.hpp"
#include "lang/token/name_characters.hpp"

namespace sdlc::lang {
namespace {

/// Copies the tokens from one list to another, phrase by phrase.
class PhraseReader : private TokenEditor {
 public:
  PhraseReader(std::string_view text, std::vector<LayoutToken>& tokens)
      : TokenEditor(text, tokens), roles_(tokens.size(), Role::None) {}

  ForeignPhrases run() {
    file_block();
    match_brackets();
    for (at_ = 0; at_ < in_.size(); ++at_) {
      if (in_[at_].is_first) begin_line();
      if (!phrase()) keep();
    }
    while (!indented_.empty()) end_indented();
    return finish();
  }

 private:
  /// What an earlier token of the phrase has made of a later one.
  enum class Role : std::uint8_t { None, Blank, Closing, Joining };

  /// A block told by its indentation.
  struct Indented {
    std::uint32_t indent;
    std::size_t phrase;
  };

  bool phrase() {
    if (at_ == 0 && is_surrounded_) return meant_as("scene 1");
    switch (roles_[at_]) {
      case Role::Blank: return blank();
      case Role::Closing: return closing();
      case Role::Joining: return meant_as("_");
      case Role::None: break;
    }
    return indented_block() || vector() || ratio() || bare_point() || braced_point() ||
           hash_definition() || quoted_name() || quoted_label() || dashed_name() || new_value() ||
           typed_value() || assigned_object() || function_by_let() || function_block() ||
           other_letters();
  }

  // Blocks told by their indentation

  void begin_line() {
    while (!indented_.empty() && in_[at_].indent <= indented_.back().indent) end_indented();
    line_ = at_;
  }

  void end_indented() {
    const LayoutToken& last = out_.back();
    const std::string end = fmt::format("\n{}}}", std::string(indented_.back().indent, ' '));
    result_.phrases[indented_.back().phrase].edits.push_back({{last.end, last.end}, end});
    indented_.pop_back();
    add(LayoutToken(last), last.end, LayoutKind::Close, "}");
  }

  /// Whether the colon at the end of this token is one in front of an indented block.
  bool opens_indented() const {
    constexpr auto kHeads =
        std::to_array<std::string_view>({"for", "if", "def", "fn", "else:", "elif", "else"});
    const bool ends_line = at_ + 1 < in_.size() && in_[at_ + 1].is_first;
    return ends_line && in_[at_].end > in_[at_].begin && text_[in_[at_].end - 1] == ':' &&
           is_one_of(written(line_), kHeads) && in_[at_ + 1].indent > in_[line_].indent;
  }

  bool indented_block() {
    if (!opens_indented()) return false;
    LayoutToken colon = in_[at_];
    colon.begin = colon.end - 1;
    if (colon.begin > in_[at_].begin) {
      LayoutToken word = in_[at_];
      word.kind = LayoutKind::Value;
      word.end =
          word.begin + static_cast<std::uint32_t>(text_.substr(word.begin).find_first_of(" \t:"));
      emit(word, false);
      colon.is_first = false;
    }
    if (written(line_) == "def" && written(at_ + 1) == "return") return function_by_return(colon);
    ForeignPhrase& phrase =
        tell(ForeignPhrase::Expected, span_of(colon), "`{`, found `:`", "a block stands in braces");
    phrase.edits.push_back({span_of(colon), " {"});
    indented_.push_back({in_[line_].indent, result_.phrases.size() - 1});
    colon.kind = LayoutKind::Open;
    colon.bracket = '{';
    colon.meant = "{";
    emit(colon, true);
    return true;
  }

  /// `def f(x):` with `return` in the next line.
  bool function_by_return(LayoutToken colon) {
    colon.kind = LayoutKind::Operator;
    colon.meant = "=";
    emit(colon, true);
    const auto word = std::find_if(out_.rbegin(), out_.rend(), [&](const LayoutToken& token) {
      return token.begin == in_[line_].begin;
    });
    word->meant = "fn";
    result_.is_told[static_cast<std::size_t>(out_.rend() - word) - 1] = true;
    roles_[at_ + 1] = Role::Blank;
    ForeignPhrase& phrase =
        tell(ForeignPhrase::Expected, span_of(*word), "`fn`, found `def`", std::string(kFunction));
    phrase.edits = {
        {span_of(*word), "fn"}, {span_of(colon), " ="}, {{colon.end, in_[at_ + 1].end}, ""}};
    return true;
  }

  // Values

  /// `<1, 2, 3>`
  bool vector() {
    constexpr std::size_t kLongest = 60;
    if (written(at_) != "<" || (!awaits_value() && written(before()) != "rgb")) return false;
    std::size_t commas = 0, depth = 0, close = at_ + 1;
    for (;; ++close) {
      if (!is_behind(close) || close > at_ + kLongest) return false;
      const LayoutToken& token = in_[close];
      if (token.kind == LayoutKind::Label || token.bracket == '{') return false;
      if (token.kind == LayoutKind::Open) ++depth;
      if (token.kind == LayoutKind::Close && depth-- == 0) return false;
      if (depth > 0) continue;
      if (token.kind == LayoutKind::Comma) ++commas;
      if (written(close) == ">") break;
    }
    if (commas != 2) return false;
    roles_[close] = Role::Closing;
    const Span inside{in_[at_].end, in_[close].begin};
    const bool is_color = !awaits_value();
    const Span span = span_of(is_color ? at_ - 1 : at_, close);
    const std::string_view help = is_color ? "a linear colour is written `linear(r, g, b)`"
                                           : "a point is written `(x, y, z)`";
    ForeignPhrase& phrase =
        tell(ForeignPhrase::Foreign, span, std::string(text(span)), std::string(help));
    phrase.edits.push_back({span, fmt::format("{}({})", is_color ? "linear" : "", text(inside))});
    phrase.is_safe = !is_color;
    return bracket(LayoutKind::Open, '(', "(");
  }

  /// `16:9`
  bool ratio() {
    const bool is_ratio = written(at_) == ":" && at_ >= 2 && is(at_ - 2, LayoutKind::Label) &&
                          is_number(at_ - 1) && is_number(at_ + 1) && is_behind(at_ + 1);
    if (!is_ratio) return false;
    ForeignPhrase& phrase =
        tell(ForeignPhrase::Foreign, span_of(in_[at_]), ":", "a ratio is a quotient");
    phrase.edits.push_back({phrase.span, "/"});
    phrase.is_safe = label_name(at_ - 2) == "aspect";
    return meant_as("/");
  }

  /// The last token of a number or name, perhaps with a sign, at `i`; the number of tokens if there
  /// is none.
  std::size_t end_of_component(std::size_t i) const {
    if (written(i) == "-") ++i;
    return (is_number(i) || is_name(i)) && is_behind(i) ? i : in_.size();
  }

  /// `center: 1, 2, 3`, with commas or without.
  bool bare_point() {
    if (!is(at_, LayoutKind::Label) || (!open_.empty() && open_.back() != '{')) return false;
    std::size_t next = at_ + 1, last = at_;
    bool has_number = false;
    std::array<std::size_t, 3> ends{};
    for (std::size_t& end : ends) {
      if (last != at_ && is(next, LayoutKind::Comma)) ++next;
      end = last = end_of_component(next);
      if (last >= in_.size()) return false;
      has_number = has_number || is_number(last);
      next = last + 1;
    }
    const bool has_comma = is(ends[0] + 1, LayoutKind::Comma);
    const bool ends_value = next >= in_.size() || in_[next].is_first || is_bracket(next, '}') ||
                            (is(next, LayoutKind::Comma) && !is_number(next + 1));
    // Names one after the other may be anything.
    const bool are_plain = has_comma || (is_number(ends[0]) && is_number(ends[1]));
    if (!ends_value || !has_number || !are_plain) return false;
    const Span span = span_of(at_ + 1, last);
    std::string point = "(";
    for (std::size_t i = at_ + 1; i <= last; ++i) {
      if (is(i, LayoutKind::Comma)) continue;
      point += written(i);
      if (i == ends[0] || i == ends[1]) point += ", ";
    }
    ForeignPhrase& phrase = tell(ForeignPhrase::Expected, span,
                                 fmt::format("a point in parentheses, found `{}`", text(span)), "");
    phrase.edits.push_back({span, point + ")"});
    phrase.is_safe = is_point_property(label_name(at_)) &&
                     std::ranges::all_of(ends, [&](std::size_t end) { return is_number(end); });

    keep();
    add(in_[at_ + 1], in_[at_ + 1].begin, LayoutKind::Open, "(");
    for (++at_; at_ <= last; ++at_) {
      keep();
      const bool lacks_comma =
          (at_ == ends[0] || at_ == ends[1]) && !is(at_ + 1, LayoutKind::Comma);
      if (lacks_comma) add(in_[at_], in_[at_].end, LayoutKind::Comma, ",");
    }
    add(in_[last], in_[last].end, LayoutKind::Close, ")");
    at_ = last;
    return true;
  }

  /// `{1, 2, 3}` in the place of a value
  bool braced_point() {
    const bool is_value = is_bracket(at_, '{') && at_ > 0 && is(at_ - 1, LayoutKind::Label);
    if (!is_value) return false;
    std::size_t last = at_;
    for (int i = 0; i < 3; ++i) {
      if (i > 0 && !is(++last, LayoutKind::Comma)) return false;
      last = end_of_component(last + 1);
      if (last >= in_.size()) return false;
    }
    const std::size_t close = last + 1;
    if (!is_bracket(close, '}')) return false;
    const Span span = span_of(at_, close);
    ForeignPhrase& phrase = tell(ForeignPhrase::Expected, span,
                                 fmt::format("a point in parentheses, found `{}`", text(span)), "");
    phrase.edits.push_back({span, fmt::format("({})", text({in_[at_].end, in_[close].begin}))});
    phrase.is_safe = is_point_property(label_name(at_ - 1));
    roles_[close] = Role::Closing;
    return bracket(LayoutKind::Open, '(', "(");
  }

  /// `new diffuse(…)`
  bool new_value() {
    const bool is_new = written(at_) == "new" && awaits_value() && is_name(at_ + 1) &&
                        is_bracket(at_ + 2, '(') && is_joined(at_ + 2);
    if (!is_new) return false;
    ForeignPhrase& phrase =
        tell(ForeignPhrase::Foreign, span_of(in_[at_]), "new", "a call makes its value");
    phrase.edits.push_back({{in_[at_].begin, in_[at_ + 1].begin}, ""});
    phrase.is_safe = true;
    LayoutToken token = in_[at_];
    token.kind = LayoutKind::Operator;
    token.meant = " ";
    emit(token, true);
    return true;
  }

  /// `#declare size = …`
  bool hash_definition() {
    const bool is_definition = is(at_, LayoutKind::Value) && first(at_) == '#' &&
                               (written(at_) == "#declare" || written(at_) == "#local");
    if (!is_definition) return false;
    ForeignPhrase& phrase = tell(ForeignPhrase::Expected, span_of(in_[at_]),
                                 fmt::format("`let`, found `{}`", written(at_)), "");
    phrase.edits.push_back({phrase.span, "let"});
    phrase.is_safe = true;
    return meant_as("let");
  }

  // Names

  /// Without its colon.
  std::string_view label_name(std::size_t i) const {
    return written(i).substr(0, written(i).find_first_of(" \t:"));
  }

  static bool is_identifier(std::string_view name) {
    return !name.empty() && end_of_identifier(name, 0) == name.size() &&
           !is_one_of(name, kReservedWords);
  }

  /// `sphere "ball" {`
  bool quoted_name() {
    const bool is_quoted =
        is_string(at_) && is_bracket(at_ + 1, '{') && at_ > 0 && is_name(at_ - 1) &&
        is_behind(at_) && written(at_ - 1) != "in" &&
        (at_ == 1 || in_[at_ - 1].is_first || out_[out_.size() - 2].bracket == '{' ||
         is(at_ - 2, LayoutKind::Comma) || is_bracket(at_ - 2, '}'));
    const std::string_view string = written(at_);
    if (!is_quoted || string.size() < 3) return false;
    std::string name(string.substr(1, string.size() - 2));
    const bool is_plain = is_identifier(name);
    for (char& c : name) c = is_idchar(c) ? c : '_';
    if (!is_identifier(name)) name = "_" + name;
    ForeignPhrase& phrase =
        tell(ForeignPhrase::Expected, span_of(in_[at_]), fmt::format("a name, found `{}`", string),
             "names stand without quotes");
    phrase.edits.push_back({phrase.span, name});
    phrase.is_safe = is_plain;
    return meant_as(store(name));
  }

  /// `"center": …`
  bool quoted_label() {
    const bool is_label = is_string(at_) && written(at_ + 1) == ":" && may_begin() &&
                          (open_.empty() || open_.back() == '{');
    const std::string_view string = written(at_);
    if (!is_label || string.size() < 3) return false;
    const std::string name(string.substr(1, string.size() - 2));
    if (end_of_identifier(name, 0) != name.size()) return false;
    ForeignPhrase& phrase =
        tell(ForeignPhrase::Expected, span_of(in_[at_]), fmt::format("a name, found `{}`", string),
             "names of properties stand without quotes");
    phrase.edits.push_back({phrase.span, name});
    phrase.is_safe = true;
    LayoutToken token = in_[at_];
    token.kind = LayoutKind::Label;
    token.end = in_[at_ + 1].end;
    // As long as with the quotes, so that every byte keeps its place.
    const std::string blanks(token.end - token.begin - name.size() - 2, ' ');
    token.meant = store(fmt::format(" {}{}:", name, blanks));
    emit(token, true);
    ++at_;
    return true;
  }

  /// `let my-name = …`: the uses, written in the same way, follow.
  bool dashed_name() {
    const bool declares = written(at_) == "let" || written(at_) == "param";
    if (!declares || !is_name(at_ + 1)) return false;
    std::size_t last = at_ + 1;
    while (written(last + 1) == "-" && is_joined(last + 1) && is_word(last + 2) &&
           is_joined(last + 2)) {
      last += 2;
    }
    const bool is_declared =
        last > at_ + 1 && (written(last + 1) == "=" || written(last + 1) == ":");
    constexpr int kMostDashed =
        50;  // each is looked for in the whole text, and of more none is told
    if (!is_declared || ++dashed_ > kMostDashed) return false;
    const std::string name(text(span_of(at_ + 1, last)));
    std::string fixed = name;
    std::replace(fixed.begin(), fixed.end(), '-', '_');
    ForeignPhrase& phrase =
        tell(ForeignPhrase::Expected, span_of(at_ + 1, last),
             fmt::format("a name, found `{}`", name), std::string(kNameLetters));
    const std::size_t length = last - at_ - 1;
    for (std::size_t i = 0; i + length < in_.size(); ++i) {
      const Span use = span_of(i, i + length);
      if (text(use) != name || (i > 0 && is_joined(i) && written(i - 1) == "-")) continue;
      phrase.edits.push_back({use, fixed});
      for (std::size_t j = i + 1; j < i + length; j += 2) roles_[j] = Role::Joining;
    }
    return false;
  }

  /// `let size: number = …`
  bool typed_value() {
    const bool is_typed = is(at_, LayoutKind::Label) && at_ > 0 && written(at_ - 1) == "let" &&
                          is_name(at_ + 1) && written(at_ + 2) == "=";
    if (!is_typed) return false;
    LayoutToken name = in_[at_], type = in_[at_ + 1];
    name.kind = LayoutKind::Value;
    name.end = name.begin + static_cast<std::uint32_t>(written(at_).find_first_of(" \t:"));
    type.begin = name.end;
    type.kind = LayoutKind::Operator;
    type.meant = " ";
    ForeignPhrase& phrase = tell(ForeignPhrase::Expected, {in_[at_].end - 1, in_[at_].end},
                                 "`=`, found `:`", "a value has the type of what it is made of");
    phrase.edits.push_back({span_of(type), ""});
    const std::string_view type_name = written(at_ + 1);
    const ForeignWord* foreign = find_foreign_word(type_name);
    phrase.is_safe =
        is_type_name(type_name) || (foreign != nullptr && foreign->kind == ForeignWord::Value);
    emit(name, false);
    emit(type, true);
    ++at_;
    return true;
  }

  /// `Sphere ball = …`
  bool assigned_object() {
    const bool is_typed = is_word(at_) && may_begin() && is_name(at_ + 1) && is_behind(at_ + 1) &&
                          written(at_ + 2) == "=" && is_behind(at_ + 2);
    if (!is_typed) return false;
    std::string kind(written(at_));
    kind[0] = to_lower(kind[0]);
    const auto kinds = all_kinds();
    const bool is_kind = std::any_of(kinds.begin(), kinds.end(),
                                     [&](const Kind& known) { return known.name == kind; });
    const bool repeats = is_name(at_ + 3) && is_bracket(at_ + 4, '{');
    if (!is_kind || (!repeats && !is_bracket(at_ + 3, '{'))) return false;
    const std::size_t brace = at_ + (repeats ? 4 : 3);
    ForeignPhrase& phrase =
        tell(ForeignPhrase::Expected, span_of(in_[at_ + 2]), "`{`, found `=`",
             fmt::format("an object is `{} {} {{ … }}`", kind, written(at_ + 1)));
    phrase.edits.push_back({{in_[at_ + 1].end, in_[brace].begin}, " "});
    keep();
    LayoutToken name = in_[at_ + 1];
    name.end = in_[brace - 1].end;
    name.meant = written(at_ + 1);
    emit(name, true);
    at_ = brace - 1;
    return true;
  }

  /// Words with letters that no name has.
  bool other_letters() {
    const LayoutToken& token = in_[at_];
    const bool is_text = token.kind == LayoutKind::Value || token.kind == LayoutKind::Label;
    const std::string_view word = written(at_);
    const auto is_other = [](char c) { return static_cast<unsigned char>(c) >= 0x80; };
    const bool has_other = std::any_of(word.begin(), word.end(), is_other);
    if (!is_text || is_string(at_) || !has_other) return false;
    std::string plain(word);
    std::replace_if(plain.begin(), plain.end(), is_other, '_');
    std::string name(word.substr(0, word.find_first_of(" \t:")));
    const Span span{token.begin, token.begin + static_cast<std::uint32_t>(name.size())};
    if (told_words_.insert(name).second) {
      tell(ForeignPhrase::Foreign, span, name, std::string(kNameLetters));
    }
    return meant_as(store(plain));
  }

  // Functions

  /// `let f(x) = …`
  bool function_by_let() {
    const bool is_let = (written(at_) == "let" || written(at_) == "def") && is_name(at_ + 1) &&
                        is_bracket(at_ + 2, '(') && is_joined(at_ + 2);
    if (!is_let) return false;
    const std::size_t is = closing_of(at_ + 2) + 1;
    if (written(is) != "=" || is_bracket(is + 2, '{')) return false;
    ForeignPhrase& phrase =
        tell(ForeignPhrase::Expected, span_of(in_[at_]),
             fmt::format("`fn`, found `{}`", written(at_)), std::string(kFunction));
    phrase.edits.push_back({phrase.span, "fn"});
    return meant_as("fn");
  }

  /// `fn f(x) { return … }`
  bool function_block() {
    const ForeignWord* word = find_foreign_word(written(at_));
    const bool is_foreign = word != nullptr && word->kind == ForeignWord::Function;
    const bool is_head = (is_foreign || written(at_) == "fn" || written(at_) == "def") &&
                         is_name(at_ + 1) && is_bracket(at_ + 2, '(') && is_joined(at_ + 2);
    if (!is_head) return false;
    const std::size_t open = closing_of(at_ + 2) + 1;
    if (!is_bracket(open, '{')) return false;
    const bool returns = written(open + 1) == "return";
    if (!returns && written(at_) == "def") return false;
    std::size_t close = closing_of(open);
    if (close >= in_.size() || close == open + 1 + returns) return false;
    for (std::size_t i = open + 1; i < close; ++i) {
      const bool is_statement = is_bracket(i, '{') || written(i) == "=" ||
                                is_one_of(written(i), kStatementWords) ||
                                (written(i) == ";" && i + 1 < close);
      if (is_statement && written(i) != "if") return false;
    }
    const Span span = span_of(in_[open]);
    ForeignPhrase& phrase = tell(ForeignPhrase::Expected, span, "`=` and an expression, found `{`",
                                 std::string(kFunction));
    const bool has_semicolon = written(close - 1) == ";";
    const std::size_t body = open + 1 + returns, last = close - 1 - has_semicolon;
    if (written(at_) == "def") phrase.edits.push_back({span_of(in_[at_]), "fn"});
    phrase.edits.push_back({{in_[open].begin, in_[body].begin}, "= "});
    phrase.edits.push_back({{in_[last].end, in_[close].end}, ""});
    if (written(at_) == "def") meant_as("fn");
    if (written(at_) != "def") keep();
    for (++at_; at_ < open; ++at_) keep();
    LayoutToken is = in_[open];
    is.kind = LayoutKind::Operator;
    is.bracket = '\0';
    is.meant = "=";
    emit(is, true);
    if (returns) roles_[open + 1] = Role::Blank;
    if (has_semicolon) roles_[close - 1] = Role::Blank;
    roles_[close] = Role::Blank;
    return true;
  }

  // The file

  /// `scene "name" { … }` around all there is.
  void file_block() {
    if (written(std::size_t{0}) != "scene") return;
    const std::size_t open = is_string(1) || is_name(1) ? 2 : 1;
    if (!is_bracket(open, '{') || in_[open].line != in_[0].line) return;
    ForeignPhrase& phrase = tell(ForeignPhrase::NoVersion, span_of(0, open), "",
                                 "the first statement is `scene 1`; no block surrounds the others");
    phrase.edits.push_back({phrase.span, "scene 1"});
    in_[0].end = in_[open].end;
    in_.erase(in_.begin() + 1, in_.begin() + static_cast<std::ptrdiff_t>(open) + 1);
    is_surrounded_ = true;
    if (in_.back().bracket == '}') {
      phrase.edits.push_back({span_of(in_.back()), ""});
      roles_[in_.size() - 1] = Role::Blank;
    }
  }

  std::vector<Role> roles_;
  std::size_t line_ = 0;        ///< the first token of the line
  bool is_surrounded_ = false;  ///< by a block of the whole file
  std::vector<Indented> indented_;
  std::set<std::string> told_words_;
  int dashed_ = 0;  ///< names declared with dashes
};

}  // namespace

ForeignPhrases mark_foreign_phrases(std::string_view text, std::vector<LayoutToken>& tokens) {
  return PhraseReader(text, tokens).run();
}

}  // namespace sdlc::lang
