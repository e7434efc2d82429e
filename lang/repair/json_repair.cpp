#include "lang/repair/json_repair.hpp"

#include "lang/repair/brackets.hpp"
#include "lang/repair/json_syntax.hpp"
#include "lang/repair/tokens.hpp"

namespace sdlc::lang {

std::optional<RepairedText> repair_json(const SourceFile& file, DiagnosticSink& sink) {
  constexpr std::string_view kMarks("\x1A\x1C\x1D", 3);
  const std::string_view text = file.text();
  if (text.size() > kMaxRepairedText || text.find_first_of(kMarks) != std::string_view::npos) {
    return std::nullopt;
  }
  sink.stop_if_requested();
  RepairedText repaired(text);
  const RepairContext context{file, repaired, sink};
  TokenList tokens = json_tokens(text);
  repaired.apply(repair_json_syntax(context, tokens));
  if (repaired.is_changed()) tokens = json_tokens(repaired.text());
  if (!tokens.has_matching_brackets() && tokens.is_bracket(0, '{')) {
    repaired.apply(repair_brackets(context, tokens, find_json_bracket_faults(tokens)));
  }
  if (!repaired.is_changed()) return std::nullopt;
  return repaired;
}

}  // namespace sdlc::lang
