#include "lsp/inlay_hints.hpp"

#include "lang/editor/inlay_hints.hpp"
#include "lsp/positions.hpp"

namespace sdlc::lsp {

Json inlay_hint(Session& session, const Json& params) {
  Json hints = Json::array();
  if (!session.settings().inlay_hints) return hints;
  const Text text = session.text_of(params);
  if (!text.is_scene()) return hints;
  constexpr int kType = 1, kParameter = 2;  // InlayHintKind of the protocol
  TextRanges ranges(*text.source, session.client().encoding());
  const lang::Span range = session.span(text, params.at("range"));
  for (const lang::InlayHint& hint : lang::inlay_hints(*text.view, text.file, range)) {
    const bool is_argument = hint.kind == lang::InlayHint::Kind::Argument;
    hints.push_back({{"position", ranges.position(hint.offset)},
                     {"label", hint.text},
                     {"kind", is_argument ? kParameter : kType},
                     {"paddingLeft", !is_argument},
                     {"paddingRight", is_argument}});
  }
  return hints;
}

void refresh_inlay_hints(Session& session) {
  if (!session.client().can("/workspace/inlayHint/refreshSupport")) return;
  session.connection().request("workspace/inlayHint/refresh", nullptr);
}

}  // namespace sdlc::lsp
