#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

#include "lang/editor/completion_builder.hpp"
#include "lang/program/nearest_file.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

/// The text inside the quotes of the string token.
Span content_of(std::string_view text, Span token) {
  const bool is_closed = token.size() > 1 && text[token.end - 1] == '"';
  const std::uint32_t end = is_closed ? token.end - 1 : end_of_unclosed_string(text, token);
  return {token.begin + 1, std::max(token.begin + 1, end)};
}

}  // namespace

void complete_file_name(CompletionBuilder& builder, const PathLister& list_folder) {
  const CursorPlace& place = builder.place();
  const Span content = content_of(builder.text(), place.token);
  if (place.offset < content.begin || place.offset > content.end) return;
  const std::string_view typed = builder.text().substr(content.begin, place.offset - content.begin);
  // Files are named relative to the scene.
  if (typed.starts_with('/') || typed.find('\\') != std::string_view::npos) return;
  const std::size_t slash = typed.rfind('/') + 1;  // npos + 1 is 0
  const std::uint32_t begin = content.begin + static_cast<std::uint32_t>(slash);
  const std::string_view rest = builder.text().substr(begin, content.end - begin);
  const auto size = static_cast<std::uint32_t>(std::min(rest.find('/'), rest.size()));
  builder.set_replaced({begin, begin + size});

  const std::filesystem::path own = builder.view().module(builder.file()).path;
  const std::filesystem::path folder = own.parent_path() / typed.substr(0, slash);
  const bool is_here = (folder / own.filename()).lexically_normal() == own.lexically_normal();
  const bool is_include = place.inner().word == "include";
  const bool has_slash = size < rest.size();
  if (typed.ends_with('.')) {
    builder.add({.label = "../", .kind = CompletionKind::Folder, .text = has_slash ? ".." : "../"},
                {});
  }
  for (const FolderEntry& entry : list_folder(folder)) {
    if (entry.name.starts_with('.')) continue;
    if (!entry.is_folder && !is_loadable(entry.name, is_include)) continue;
    if (is_here && entry.name == own.filename()) continue;
    builder.add({.label = entry.is_folder ? entry.name + "/" : entry.name,
                 .kind = entry.is_folder ? CompletionKind::Folder : CompletionKind::File,
                 .text = entry.is_folder && !has_slash ? entry.name + "/" : entry.name},
                {entry.is_folder ? 1 : 0, 0});
  }
}

void complete_import_name(CompletionBuilder& builder, bool with_as) {
  const OpenBracket& f = builder.place().inner();
  std::string_view file = builder.text().substr(f.path.begin, f.path.size());
  file = file.substr(1, file.size() - (file.size() > 1 && file.ends_with('"') ? 2 : 1));
  const std::string name = name_for_file(file);
  CompletionItem item{.label = with_as ? "as " + name : name,
                      .kind = with_as ? CompletionKind::Keyword : CompletionKind::Module,
                      .documentation = "The name before the names of the imported file."};
  if (with_as) item.snippet = "as ${1:" + name + "}";
  builder.add(std::move(item), {});
}

}  // namespace sdlc::lang
