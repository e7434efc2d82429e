#include "lsp/code_lenses.hpp"

#include <utility>

#include "lang/editor/code_lenses.hpp"

namespace sdlc::lsp {

Json code_lens(Session& session, const Json& params) {
  Json lenses = Json::array();
  const Text text = session.text_of(params);
  if (!text.is_scene()) return lenses;
  for (const lang::RenderLens& lens : lang::render_lenses(*text.view, text.file)) {
    Json argument{{"uri", params.at("textDocument").at("uri")}};
    if (!lens.camera.empty()) argument["camera"] = lens.camera;
    lenses.push_back({{"range", session.range(*text.source, lens.where)},
                      {"command",
                       {{"title", "Render"},
                        {"command", "sdlc.render"},
                        {"arguments", Json::array({std::move(argument)})}}}});
  }
  return lenses;
}

}  // namespace sdlc::lsp
