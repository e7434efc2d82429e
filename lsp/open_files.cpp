#include "lsp/open_files.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "lsp/positions.hpp"

namespace sdlc::lsp {
namespace {

/// A line of a text that changes. Changes come in an order: each line is searched from the one
/// before, not from the beginning.
struct LinePlace {
  std::uint32_t line = 1;
  std::size_t begin = 0;

  /// Goes to the line; false if the text has fewer lines: then this is the last one.
  bool move_to(std::string_view text, std::uint32_t wanted) {
    while (line > wanted) {
      begin = begin < 2 ? 0 : text.rfind('\n', begin - 2) + 1;  // npos + 1 is 0
      --line;
    }
    while (line < wanted) {
      const std::size_t end = text.find('\n', begin);
      if (end == std::string_view::npos) return false;
      begin = end + 1;
      ++line;
    }
    return true;
  }
};

/// The offset of a position in a text; one outside of it is at its end, or at the end of its line.
std::size_t offset_in(std::string_view text, lang::Position position, LinePlace& place,
                      lang::PositionEncoding encoding) {
  if (!place.move_to(text, position.line)) return text.size();
  std::string_view line = text.substr(place.begin, text.find('\n', place.begin) - place.begin);
  while (line.ends_with('\r')) line.remove_suffix(1);  // as SourceFile::line() does
  return place.begin + lang::offset_in_line(line, position.column, encoding);
}

void apply(std::string& text, const Json& change, LinePlace& place,
           lang::PositionEncoding encoding) {
  if (!change.is_object() || !change.contains("text") || !change.at("text").is_string()) {
    throw RequestError(ErrorCode::InvalidParams, "a change needs a `text`");
  }
  const auto& inserted = change.at("text").get_ref<const std::string&>();
  const auto range = change.find("range");
  if (range == change.end() || range->is_null()) {
    text = inserted;
    place = {};
    return;
  }
  if (!range->is_object() || !range->contains("start") || !range->contains("end")) {
    throw RequestError(ErrorCode::InvalidParams, "a range needs `start` and `end`");
  }
  const std::size_t end = offset_in(text, position_of_json(range->at("end")), place, encoding);
  const std::size_t begin = offset_in(text, position_of_json(range->at("start")), place, encoding);
  if (begin > end) {
    throw RequestError(ErrorCode::InvalidParams, "the range of a change ends before it begins");
  }
  text.replace(begin, end - begin, inserted);
}

}  // namespace

std::string changed_text(std::string text, const Json& changes, lang::PositionEncoding encoding) {
  if (!changes.is_array()) {
    throw RequestError(ErrorCode::InvalidParams, "`contentChanges` must be an array");
  }
  LinePlace place;  // before what a change replaces
  for (const Json& change : changes) apply(text, change, place, encoding);
  return text;
}

}  // namespace sdlc::lsp
