#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "lang/editor/scene_view.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// The type of a token for highlighting.
enum class SemanticType : std::uint8_t {
  Namespace,   ///< the name of an import
  Type,        ///< built-in kinds and types
  Class,       ///< defs
  Struct,      ///< constructors of materials
  Parameter,   ///< of fns and defs, and labels of arguments
  Variable,    ///< lets, params, loop variables and built-in values
  Property,    ///< labels in objects, and components: `.x`
  EnumMember,  ///< words
  Function,
  Label,  ///< names of objects
  Keyword,
  Comment,
  String,
  Number,  ///< colours too
  Operator,
};

/// The names of the Language Server Protocol, in the order of the enumerators.
inline constexpr auto kSemanticTypeNames = std::to_array<std::string_view>(
    {"namespace", "type", "class", "struct", "parameter", "variable", "property", "enumMember",
     "function", "label", "keyword", "comment", "string", "number", "operator"});

/// Bits of SemanticToken::modifiers.
enum SemanticModifier : std::uint8_t {
  kDeclarationModifier = 1,
  kReadonlyModifier = 2,
  kDefaultLibraryModifier = 4,  ///< the language defines it
  kDocumentationModifier = 8,   ///< a `///` comment
};

/// In the order of the bits.
inline constexpr auto kSemanticModifierNames =
    std::to_array<std::string_view>({"declaration", "readonly", "defaultLibrary", "documentation"});

struct SemanticToken {
  Span span;  ///< in one line
  SemanticType type = SemanticType::Variable;
  std::uint8_t modifiers = 0;

  friend bool operator==(const SemanticToken&, const SemanticToken&) = default;
};

/// The tokens of a file, or those that overlap `range`, in the order of the text. Brackets, commas,
/// colons, dots and names without a meaning are omitted.
std::vector<SemanticToken> semantic_tokens(const SceneView& view, std::uint32_t file,
                                           std::optional<Span> range = std::nullopt);

}  // namespace sdlc::lang
