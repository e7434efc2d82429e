#include "lang/editor/completion.hpp"

#include "lang/editor/completion_builder.hpp"

namespace sdlc::lang {

CompletionList complete(SceneView& view, std::uint32_t file, std::uint32_t offset,
                        const PathLister& list_folder) {
  const CursorPlace place = find_cursor_place(view.tree(file), offset);
  CompletionBuilder builder(view, file, place);
  switch (place.kind) {
    case CursorPlace::Kind::Nothing: break;
    case CursorPlace::Kind::Comment: complete_comment(builder); break;
    case CursorPlace::Kind::FileName: complete_file_name(builder, list_folder); break;
    case CursorPlace::Kind::Color: complete_color(builder); break;
    case CursorPlace::Kind::Number: complete_number(builder); break;
    case CursorPlace::Kind::Statement: complete_statement(builder); break;
    case CursorPlace::Kind::Argument: complete_argument(builder); break;
    case CursorPlace::Kind::Expression: complete_value(builder); break;
    case CursorPlace::Kind::Operator: complete_operator(builder); break;
    case CursorPlace::Kind::Member: complete_member(builder); break;
    case CursorPlace::Kind::Type: complete_type(builder); break;
    case CursorPlace::Kind::In:
      builder.add({.label = "in",
                   .kind = CompletionKind::Keyword,
                   .documentation = "The list whose elements the variable takes.",
                   .text = "in "},
                  {});
      break;
    case CursorPlace::Kind::As: complete_import_name(builder, true); break;
    case CursorPlace::Kind::ImportName: complete_import_name(builder, false); break;
  }
  return builder.take();
}

}  // namespace sdlc::lang
