#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lang/editor/completion.hpp"
#include "lang/editor/cursor_place.hpp"
#include "lang/editor/expected_type.hpp"
#include "lang/editor/scene_view.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::lang {

/// The order of completions: by fit, then by how much of the label is typed, by distance, by label.
struct CompletionRank {
  int fit = 0;
  int distance = 0;
};

/// Collects the completions at a place.
class CompletionBuilder {
 public:
  CompletionBuilder(SceneView& view, std::uint32_t file, const CursorPlace& place);

  SceneView& view() const noexcept { return view_; }
  std::uint32_t file() const noexcept { return file_; }
  const CursorPlace& place() const noexcept { return place_; }
  std::string_view text() const noexcept { return text_; }
  std::string_view prefix() const noexcept { return prefix_; }

  /// Whether the typed characters are in the label.
  bool accepts(std::string_view label) const;
  /// Adds the item if it is accepted. Without `text` the label is inserted, without `replaced` it
  /// replaces the word.
  void add(CompletionItem item, CompletionRank rank);
  /// Replaces `replaced` instead of the word, filtered by its text before the cursor.
  void set_replaced(Span replaced);

  /// Whether a name that is inserted is followed by this character already.
  bool is_followed_by(char c) const;
  std::size_t size() const noexcept { return ranked_.size(); }
  CompletionList take();

 private:
  struct Ranked {
    CompletionItem item;
    CompletionRank rank;
    int match;
  };

  SceneView& view_;
  std::uint32_t file_;
  const CursorPlace& place_;
  std::string_view text_;
  Span replaced_;
  std::string_view prefix_;
  std::vector<Ranked> ranked_;
};

// One function per kind of place.
void complete_statement(CompletionBuilder& builder);
void complete_value(CompletionBuilder& builder);
void complete_argument(CompletionBuilder& builder);
void complete_operator(CompletionBuilder& builder);
void complete_member(CompletionBuilder& builder);
void complete_number(CompletionBuilder& builder);
void complete_color(CompletionBuilder& builder);
void complete_type(CompletionBuilder& builder);
void complete_comment(CompletionBuilder& builder);
void complete_file_name(CompletionBuilder& builder, const PathLister& list_folder);
void complete_import_name(CompletionBuilder& builder, bool with_as);

// Items

/// A property or, with `is_argument`, a named argument.
CompletionItem property_item(const Property& property, bool is_argument, bool has_colon);
CompletionItem parameter_item(const SceneView& view, SymbolId parameter, bool is_argument,
                              bool has_colon);
/// `name`: as it is written, with the import if it is needed.
CompletionItem function_item(const SceneView& view, SymbolId function, std::string name,
                             bool has_arguments);
CompletionItem def_item(const SceneView& view, SymbolId def, std::string name, bool has_block);

/// Adds the values and functions of an import that are accepted. `qualifier`: `mat.`, or empty.
/// Returns whether any of them fits.
bool add_members(CompletionBuilder& builder, SymbolId import, std::string_view qualifier,
                 const ExpectedType& expected, bool only_fitting);

}  // namespace sdlc::lang
