#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "lang/source/position_encoding.hpp"
#include "lsp/json_rpc.hpp"

namespace sdlc::lsp {

/// A text that is open in the editor.
struct OpenFile {
  std::string uri = {};  ///< as the client writes it
  std::filesystem::path path = {};
  std::filesystem::path identity = {};  ///< the same for all paths of one file
  int version = 0;
  std::shared_ptr<const std::string> text = {};
  bool is_outdated = false;  ///< a change could not be applied: the editor has another text
};

/// The text after `didChange`'s list of changes. Throws RequestError (InvalidParams) if one cannot
/// be applied.
std::string changed_text(std::string text, const Json& changes, lang::PositionEncoding encoding);

}  // namespace sdlc::lsp
