#include "lang/editor/text_edits.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "lang/text/line_diff.hpp"
#include "lang/text/utf8.hpp"

namespace sdlc::lang {
namespace {

/// Whether an editor has a position at `at`.
bool is_place(std::string_view text, std::size_t at) {
  if (at == 0 || at >= text.size()) return true;
  const bool splits_line_end = text[at - 1] == '\r' && text[at] == '\n';
  return !splits_line_end && !is_continuation(text[at]);
}

/// Two texts without what they have in common at their ends.
struct Difference {
  std::size_t begin = 0;  ///< in both texts
  std::size_t from_end = 0, to_end = 0;
};

Difference difference_of(std::string_view from, std::string_view to) {
  const std::size_t most = std::min(from.size(), to.size());
  std::size_t begin = 0;
  while (begin < most && from[begin] == to[begin]) ++begin;
  while (!is_place(from, begin) || !is_place(to, begin)) --begin;

  std::size_t same = 0;
  while (same < most - begin && from[from.size() - 1 - same] == to[to.size() - 1 - same]) ++same;
  while (!is_place(from, from.size() - same) || !is_place(to, to.size() - same)) --same;
  return {.begin = begin, .from_end = from.size() - same, .to_end = to.size() - same};
}

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// Lines are compared without their spaces, so that a line with another indentation is recognized.
std::vector<std::string> without_spaces(std::span<const std::string_view> lines) {
  std::vector<std::string> keys;
  keys.reserve(lines.size());
  for (const std::string_view line : lines) {
    std::string& key = keys.emplace_back(line);
    std::erase_if(key, is_space);
  }
  return keys;
}

/// Texts in lines, and the places of the lines.
struct LinedText {
  explicit LinedText(std::string_view text)
      : lines(lines_of(text)), keys(without_spaces(lines)), views(keys.begin(), keys.end()) {
    begins.reserve(lines.size() + 1);
    std::uint32_t at = 0;
    for (const std::string_view line : lines) {
      begins.push_back(at);
      at += static_cast<std::uint32_t>(line.size());
    }
    begins.push_back(at);
  }

  std::vector<std::string_view> lines;
  std::vector<std::string> keys;
  std::vector<std::string_view> views;
  std::vector<std::uint32_t> begins;
};

class Editing {
 public:
  Editing(std::string_view from, std::string_view to, std::uint32_t offset)
      : from_text_(from), to_text_(to), offset_(offset), from_(from), to_(to) {}

  std::vector<TextEdit> run() {
    std::vector<LineChange> changes = changed_lines(from_.views, to_.views);
    changes.push_back({from_.lines.size(), from_.lines.size(), to_.lines.size(), to_.lines.size()});
    std::size_t line = 0, to_line = 0;
    for (const LineChange& change : changes) {
      for (; line < change.a_begin; ++line, ++to_line) {
        add({line, line + 1, to_line, to_line + 1});
      }
      add_change(change);
      line = change.a_end, to_line = change.b_end;
    }
    return std::move(edits_);
  }

 private:
  /// A run of as many lines as before is probably the same lines.
  void add_change(const LineChange& change) {
    const std::size_t count = change.a_end - change.a_begin;
    if (count != change.b_end - change.b_begin) return add(change);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t a = change.a_begin + i, b = change.b_begin + i;
      add({a, a + 1, b, b + 1});
    }
  }

  void add(const LineChange& change) {
    const Span from{from_.begins[change.a_begin], from_.begins[change.a_end]};
    const Span to{to_.begins[change.b_begin], to_.begins[change.b_end]};
    if (is_fine() && differ_only_in_spaces(change)) {
      add_spaces(from, to);
    } else {
      add_difference(from, to);
    }
  }

  /// A client takes seconds for a hundred thousand edits.
  bool is_fine() const {
    constexpr std::size_t kMaxFineLines = 2000;
    return from_.lines.size() <= kMaxFineLines;
  }

  /// Whether the lines differ only in their spaces.
  bool differ_only_in_spaces(const LineChange& change) const {
    std::string from, to;
    for (std::size_t i = change.a_begin; i < change.a_end; ++i) from += from_.keys[i];
    for (std::size_t i = change.b_begin; i < change.b_end; ++i) to += to_.keys[i];
    return from == to;
  }

  /// Edits the spaces one by one, so that the caret keeps its place between them.
  void add_spaces(Span from, Span to) {
    const auto end_of_spaces = [](std::string_view text, std::uint32_t at, std::uint32_t end) {
      while (at < end && is_space(text[at])) ++at;
      return at;
    };
    while (from.begin < from.end || to.begin < to.end) {
      const Span from_run{from.begin, end_of_spaces(from_text_, from.begin, from.end)};
      const Span to_run{to.begin, end_of_spaces(to_text_, to.begin, to.end)};
      add_difference(from_run, to_run);
      from.begin = from_run.end + 1, to.begin = to_run.end + 1;
    }
  }

  void add_difference(Span from_span, Span to_span) {
    const std::string_view from = from_text_.substr(from_span.begin, from_span.size());
    const std::string_view to = to_text_.substr(to_span.begin, to_span.size());
    if (from == to) return;
    const Difference difference = difference_of(from, to);
    const std::uint32_t begin = offset_ + from_span.begin;
    edits_.push_back(
        {.where = {begin + static_cast<std::uint32_t>(difference.begin),
                   begin + static_cast<std::uint32_t>(difference.from_end)},
         .text = std::string(to.substr(difference.begin, difference.to_end - difference.begin))});
  }

  std::string_view from_text_, to_text_;
  std::uint32_t offset_;
  LinedText from_, to_;
  std::vector<TextEdit> edits_;
};

/// The beginning of the line; the line end is not divided.
std::size_t line_begin_of(std::string_view text, std::size_t at) {
  const std::size_t newline = at == 0 ? std::string_view::npos : text.rfind('\n', at - 1);
  return newline == std::string_view::npos ? 0 : newline + 1;
}

std::size_t line_end_of(std::string_view text, std::size_t at) {
  if (at > 0 && text[at - 1] == '\n') return at;
  const std::size_t newline = text.find('\n', at);
  return newline == std::string_view::npos ? text.size() : newline + 1;
}

}  // namespace

std::vector<TextEdit> text_edits(std::string_view from, std::string_view to) {
  if (from == to) return {};
  // Only the changed lines are compared as lines: most edits of a large text are small.
  const Difference difference = difference_of(from, to);
  const std::size_t begin = line_begin_of(from, difference.begin);
  const std::size_t end = line_end_of(from, difference.from_end);
  const std::size_t to_end = difference.to_end + (end - difference.from_end);
  return Editing(from.substr(begin, end - begin), to.substr(begin, to_end - begin),
                 static_cast<std::uint32_t>(begin))
      .run();
}

std::string with_edits(std::string_view text, std::span<const TextEdit> edits) {
  std::string result;
  std::uint32_t end = 0;
  for (const TextEdit& edit : edits) {
    result += text.substr(end, edit.where.begin - end);
    result += edit.text;
    end = edit.where.end;
  }
  result += text.substr(end);
  return result;
}

}  // namespace sdlc::lang
