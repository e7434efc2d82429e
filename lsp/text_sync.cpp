#include "lsp/text_sync.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lsp/open_files.hpp"
#include "lsp/uri.hpp"

namespace sdlc::lsp {
namespace {

/// Version numbers are for messages only.
int version_in(const Json& document) {
  const auto version = document.find("version");
  return version != document.end() && version->is_number_integer() ? version->get<int>() : 0;
}

/// Whether the first of the changes is a whole text.
bool replaces_text(const Json& changes) {
  return changes.is_array() && !changes.empty() && changes.front().is_object() &&
         !changes.front().contains("range");
}

}  // namespace

void did_open(Session& session, const Json& params) {
  const Json& document = params.at("textDocument");
  const std::string& uri = document_uri(params);
  OpenFile file{.uri = uri, .path = path_of_uri(uri), .version = version_in(document)};
  file.identity = session.workspace().identity(file.path);
  file.text = std::make_shared<const std::string>(document.at("text").get<std::string>());
  session.open(std::move(file));
}

void did_change(Session& session, const Json& params) {
  const OpenFile* known = session.find_open(document_uri(params));
  if (known == nullptr) {
    session.log().write(fmt::format("a change of `{}`, which is not open", document_uri(params)));
    return;
  }
  OpenFile file = *known;
  file.version = version_in(params.at("textDocument"));
  const Json& changes = params.at("contentChanges");
  if (known->is_outdated && !replaces_text(changes)) return;
  try {
    file.text = std::make_shared<const std::string>(
        changed_text(*known->text, changes, session.client().encoding()));
    file.is_outdated = false;
    session.change(file);
  } catch (const RequestError& error) {
    session.set_outdated(file.uri, error.what());
  }
}

void did_close(Session& session, const Json& params) { session.close(document_uri(params)); }

void did_save(Session& session, const Json& params) {
  session.files_changed({path_of_uri(document_uri(params))});
}

void did_change_watched_files(Session& session, const Json& params) {
  std::vector<std::filesystem::path> files;
  for (const Json& change : params.at("changes")) {
    files.push_back(path_of_uri(change.at("uri").get_ref<const std::string&>()));
  }
  session.files_changed(files);
}

}  // namespace sdlc::lsp
