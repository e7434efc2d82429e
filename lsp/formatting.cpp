#include "lsp/formatting.hpp"

#include <memory>
#include <string>

#include <fmt/format.h>

#include "lang/editor/formatting.hpp"
#include "lsp/edits_json.hpp"
#include "lsp/positions.hpp"

namespace sdlc::lsp {
namespace {

/// Formatting needs the text alone, not the scene that it is in.
std::shared_ptr<const lang::Document> document_of(Session& session, const Json& params) {
  const std::filesystem::path path = session.path_of(params);
  auto document = session.load(session.workspace().identity(path));
  if (document) return document;
  throw RequestError(ErrorCode::InvalidParams, fmt::format("cannot read `{}`", path.string()));
}

Json result_of(const Session& session, const lang::Document& document,
               const lang::Formatting& formatting) {
  if (formatting.is_refused()) throw RequestError(ErrorCode::RequestFailed, formatting.refusal);
  return edits_json(session, document, formatting.edits);
}

}  // namespace

Json format_document(Session& session, const Json& params) {
  const auto document = document_of(session, params);
  return result_of(session, *document, lang::format_text(*document));
}

Json format_lines(Session& session, const Json& params) {
  const auto document = document_of(session, params);
  const lang::Span range = span_of_json(*document, params.at("range"), session.client().encoding());
  return result_of(session, *document, lang::format_range(*document, range));
}

Json format_while_typing(Session& session, const Json& params) {
  const auto document = document_of(session, params);
  const std::uint32_t caret =
      offset_of_json(*document, params.at("position"), session.client().encoding());
  const auto& typed = params.at("ch").get_ref<const std::string&>();
  const lang::Formatting formatting = lang::format_on_type(*document, caret, typed);
  return edits_json(session, *document, formatting.edits);  // none if it is refused
}

Json typing_triggers() {
  Json more = Json::array();
  for (std::size_t i = 1; i < lang::kFormattingTriggers.size(); ++i) {
    more.push_back(lang::kFormattingTriggers[i]);
  }
  return {{"firstTriggerCharacter", lang::kFormattingTriggers[0]},
          {"moreTriggerCharacter", std::move(more)}};
}

}  // namespace sdlc::lsp
