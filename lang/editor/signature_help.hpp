#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lang/editor/scene_view.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

struct ParameterHelp {
  Span where;                 ///< bytes of the signature's label
  std::string documentation;  ///< Markdown; may be empty
};

struct Signature {
  std::string label;          ///< "specular(color, fuzz: 0)"
  std::string documentation;  ///< Markdown
  std::vector<ParameterHelp> parameters = {};
};

/// The call around the cursor.
struct SignatureHelp {
  std::vector<Signature> signatures;  ///< one for each form of the function
  std::size_t active_signature = 0;
  std::optional<std::size_t> active_parameter = {};  ///< nullopt: there is no such parameter
};

/// Help for the innermost call of a known function that is open at the offset.
std::optional<SignatureHelp> signature_help(SceneView& view, std::uint32_t file,
                                            std::uint32_t offset);

}  // namespace sdlc::lang
