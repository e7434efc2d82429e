#include "lang/data/data.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>

#include "lang/data/readers.hpp"
#include "lang/source/data_format.hpp"
#include "lang/text/ascii.hpp"
#include "lang/text/utf8.hpp"

namespace sdlc::lang {
namespace {

/// Reports bad UTF-8, control characters and carriage returns alone; stops after some.
void check_characters_of(const SourceFile& file, DiagnosticSink& sink) {
  constexpr int kMaxReports = 20;
  const std::string_view text = file.text();
  int reports = 0;
  for (std::uint32_t at = 0; at < text.size() && reports < kMaxReports;) {
    const char c = text[at];
    const bool is_line_end = c == '\n' || (c == '\r' && text.substr(at + 1, 1) == "\n");
    if ((c >= ' ' && c < '\x7F') || c == '\t' || is_line_end) {
      ++at;
      continue;
    }
    const DecodedChar decoded = decode_utf8(text.substr(at));
    const Location where{&file, {at, at + decoded.size}};
    at += decoded.size;
    if (!decoded.is_valid) {
      sink.report(diag::bad_utf8, where).help("save the file as UTF-8");
      ++reports;
    } else if (c == '\r') {
      sink.report(diag::bad_character, where, "a carriage return without a line feed")
          .help("save the file with LF or CRLF line ends");
      return;  // a file of such lines
    } else if (is_ascii(c)) {
      sink.report(diag::bad_character, where,
                  fmt::format("U+{:04X}, a control character,",
                              static_cast<std::uint32_t>(decoded.code_point)));
      ++reports;
    }
  }
}

}  // namespace

std::string_view take_line(std::string_view text, std::uint32_t& at) {
  const std::size_t end = std::min(text.find('\n', at), text.size());
  std::string_view line = text.substr(at, end - at);
  if (line.ends_with('\r')) line.remove_suffix(1);
  at = static_cast<std::uint32_t>(std::min(end + 1, text.size()));
  return line;
}

std::uint32_t begin_of_text(std::string_view text) {
  return text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
}

std::shared_ptr<const Table> read_table(const SourceFile& file, DiagnosticSink& sink) {
  const std::size_t errors = sink.error_count();
  check_characters_of(file, sink);
  if (sink.error_count() > errors) return nullptr;
  switch (data_format_of(file.name()).value_or(DataFormat::Csv)) {
    case DataFormat::Csv: return read_delimited(file, ',', sink);
    case DataFormat::Tsv: return read_delimited(file, '\t', sink);
    case DataFormat::Xyz: return read_xyz(file, sink);
  }
  return nullptr;
}

}  // namespace sdlc::lang
