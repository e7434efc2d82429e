#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lang/editor/scene_view.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

enum class CompletionKind : std::uint8_t {
  Keyword,
  Snippet,
  ObjectKind,   ///< a built-in kind or a def
  Property,     ///< or a named argument
  Variable,     ///< a let, param, parameter or loop variable
  Function,     ///< a fn or a built-in function
  Constructor,  ///< of a material, colour or motion
  Color,
  Word,  ///< a word of a property, `true`, `false`
  Literal,
  Module,  ///< the name of an import
  Component,
  Type,
  Unit,
  File,
  Folder,
  Code,  ///< of a diagnostic
};

struct CompletionItem {
  std::string label;
  CompletionKind kind = CompletionKind::Variable;
  std::string detail = {};         ///< one line: the type, the default
  std::string documentation = {};  ///< Markdown
  Span replaced = {};
  std::string filter = {};  ///< what the replaced text is compared with; empty: the label
  std::string text = {};    ///< to insert
  std::string snippet =
      {};  ///< the same with placeholders, for editors that have them; may be empty
};

struct CompletionList {
  std::vector<CompletionItem> items;  ///< the best first
  bool is_incomplete = false;         ///< there are more: ask again after the next character
};

/// What can be written at the offset, filtered by the word before it. Deterministic.
CompletionList complete(SceneView& view, std::uint32_t file, std::uint32_t offset,
                        const PathLister& list_folder);

}  // namespace sdlc::lang
