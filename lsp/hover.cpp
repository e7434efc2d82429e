#include "lsp/hover.hpp"

#include <cstdint>
#include <string>
#include <utility>

#include "lang/editor/config_hover.hpp"
#include "lang/editor/hover.hpp"

namespace sdlc::lsp {

Json hover(Session& session, const Json& params) {
  const Text text = session.text_of(params);
  const std::uint32_t offset = session.offset(text, params.at("position"));
  auto found = text.is_scene() ? lang::hover(*text.view, text.file, offset)
                               : lang::hover_config(*text.source, offset);
  if (!found) return nullptr;
  const bool is_markdown = session.client().lists("/textDocument/hover/contentFormat", "markdown");
  std::string value =
      is_markdown ? std::move(found->markdown) : lang::to_plain_text(found->markdown);
  return {
      {"contents", {{"kind", is_markdown ? "markdown" : "plaintext"}, {"value", std::move(value)}}},
      {"range", session.range(*text.source, found->where)}};
}

}  // namespace sdlc::lsp
