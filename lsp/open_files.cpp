#include "lsp/open_files.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "lsp/positions.hpp"

namespace sdlc::lsp {
namespace {

/// The offset of a position in a text; one outside of it is at its end, or at the end of its line.
std::size_t offset_in(std::string_view text, lang::Position position,
                      lang::PositionEncoding encoding) {
  std::size_t begin = 0;
  for (std::uint32_t line = 1; line < position.line; ++line) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) return text.size();
    begin = end + 1;
  }
  std::string_view line = text.substr(begin, text.find('\n', begin) - begin);
  while (line.ends_with('\r')) line.remove_suffix(1);  // as SourceFile::line() does
  return begin + lang::offset_in_line(line, position.column, encoding);
}

void apply(std::string& text, const Json& change, lang::PositionEncoding encoding) {
  if (!change.is_object() || !change.contains("text") || !change.at("text").is_string()) {
    throw RequestError(ErrorCode::InvalidParams, "a change needs a `text`");
  }
  const auto& inserted = change.at("text").get_ref<const std::string&>();
  const auto range = change.find("range");
  if (range == change.end() || range->is_null()) {
    text = inserted;
    return;
  }
  if (!range->is_object() || !range->contains("start") || !range->contains("end")) {
    throw RequestError(ErrorCode::InvalidParams, "a range needs `start` and `end`");
  }
  const std::size_t begin = offset_in(text, position_of_json(range->at("start")), encoding);
  const std::size_t end = offset_in(text, position_of_json(range->at("end")), encoding);
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
  for (const Json& change : changes) apply(text, change, encoding);
  return text;
}

}  // namespace sdlc::lsp
