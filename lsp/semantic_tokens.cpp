#include "lsp/semantic_tokens.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "lang/editor/semantic_tokens.hpp"
#include "lang/source/position_encoding.hpp"
#include "lsp/session.hpp"

namespace sdlc::lsp {
namespace {

using Numbers = SemanticResults::Numbers;

/// Whether a grammar without names finds the token too.
bool is_syntactic(lang::SemanticType type) {
  using enum lang::SemanticType;
  return type == Comment || type == String || type == Number || type == Operator;
}

/// Five numbers per token: lines and columns since the token before, length, type, modifiers.
Numbers numbers_of(Session& session, const Text& text, std::optional<lang::Span> range) {
  Numbers numbers;
  if (!text.is_scene()) return numbers;
  const bool augments = session.client().can("/textDocument/semanticTokens/augmentsSyntaxTokens");
  lang::PositionMap positions(*text.source, session.client().encoding());
  lang::Position last{1, 1};
  for (const lang::SemanticToken& token : lang::semantic_tokens(*text.view, text.file, range)) {
    if (augments && is_syntactic(token.type)) continue;
    const lang::Position begin = positions.at(token.span.begin);
    const std::uint32_t size = positions.at(token.span.end).column - begin.column;
    const std::uint32_t lines = begin.line - last.line;
    const std::uint32_t columns = begin.column - (lines > 0 ? 1 : last.column);
    numbers.insert(numbers.end(),
                   {lines, columns, size, static_cast<std::uint32_t>(token.type), token.modifiers});
    last = begin;
  }
  return numbers;
}

/// The edit that replaces the numbers between the equal first and last ones.
Json edits_between(const Numbers& old, const Numbers& now) {
  if (old == now) return Json::array();
  const std::size_t size = std::min(old.size(), now.size());
  std::size_t first = 0, last = 0;
  while (first < size && old[first] == now[first]) ++first;
  while (last < size - first && old.end()[-1 - static_cast<std::ptrdiff_t>(last)] ==
                                    now.end()[-1 - static_cast<std::ptrdiff_t>(last)]) {
    ++last;
  }
  const Numbers added(now.begin() + static_cast<std::ptrdiff_t>(first),
                      now.end() - static_cast<std::ptrdiff_t>(last));
  return Json::array(
      {{{"start", first}, {"deleteCount", old.size() - first - last}, {"data", added}}});
}

}  // namespace

std::string SemanticResults::add(const std::string& uri, Numbers numbers) {
  std::erase_if(results_, [&](const Result& result) { return result.uri == uri; });
  if (results_.size() == kMaxTexts) results_.pop_front();
  results_.push_back({uri, std::to_string(next_id_++), std::move(numbers)});
  return results_.back().id;
}

const Numbers* SemanticResults::find(const std::string& uri, const std::string& id) const {
  const auto found = std::ranges::find_if(
      results_, [&](const Result& result) { return result.uri == uri && result.id == id; });
  return found == results_.end() ? nullptr : &found->numbers;
}

Json semantic_tokens_options() {
  return {{"legend",
           {{"tokenTypes", lang::kSemanticTypeNames},
            {"tokenModifiers", lang::kSemanticModifierNames}}},
          {"range", true},
          {"full", {{"delta", true}}}};
}

Json semantic_tokens_full(Session& session, const Json& params) {
  const Text text = session.text_of(params);
  Numbers numbers = numbers_of(session, text, std::nullopt);
  Json result{{"data", numbers}};
  result["resultId"] = session.semantic_results().add(document_uri(params), std::move(numbers));
  return result;
}

Json semantic_tokens_delta(Session& session, const Json& params) {
  const std::string& uri = document_uri(params);
  const std::string id = params.at("previousResultId").get<std::string>();
  const Numbers* old = session.semantic_results().find(uri, id);
  if (old == nullptr) return semantic_tokens_full(session, params);
  Numbers numbers = numbers_of(session, session.text_of(params), std::nullopt);
  Json result{{"edits", edits_between(*old, numbers)}};
  result["resultId"] = session.semantic_results().add(uri, std::move(numbers));
  return result;
}

Json semantic_tokens_range(Session& session, const Json& params) {
  const Text text = session.text_of(params);
  return {{"data", numbers_of(session, text, session.span(text, params.at("range")))}};
}

}  // namespace sdlc::lsp
