#include "lsp/code_lenses.hpp"

#include <utility>

#include "lang/editor/code_lenses.hpp"
#include "lsp/positions.hpp"

namespace sdlc::lsp {

Json code_lens(Session& session, const Json& params) {
  Json lenses = Json::array();
  const Text text = session.text_of(params);
  if (!text.is_scene()) return lenses;
  TextRanges ranges(*text.source, session.client().encoding());
  for (const lang::RenderLens& lens : lang::render_lenses(*text.view, text.file)) {
    Json argument{{"uri", document_uri(params)}};
    if (!lens.camera.empty()) argument["camera"] = lens.camera;
    lenses.push_back({{"range", ranges.range(lens.where)},
                      {"command",
                       {{"title", "Render"},
                        {"command", "sdlc.render"},
                        {"arguments", Json::array({std::move(argument)})}}}});
  }
  return lenses;
}

}  // namespace sdlc::lsp
