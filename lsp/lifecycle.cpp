#include "lsp/lifecycle.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/source/data_format.hpp"
#include "lsp/code_actions.hpp"
#include "lsp/commands.hpp"
#include "lsp/completion.hpp"
#include "lsp/formatting.hpp"
#include "lsp/inlay_hints.hpp"
#include "lsp/semantic_tokens.hpp"
#include "lsp/uri.hpp"

namespace sdlc::lsp {
namespace {

/// What the server can do for this client.
Json capabilities_for(const Client& client) {
  const bool is_utf8 = client.encoding() == lang::PositionEncoding::Utf8;
  return {
      {"positionEncoding", is_utf8 ? "utf-8" : "utf-16"},
      {"textDocumentSync", {{"openClose", true}, {"change", 2}, {"save", true}}},
      {"completionProvider", completion_options()},
      {"signatureHelpProvider", signature_help_options()},
      {"definitionProvider", true},
      {"declarationProvider", true},
      {"referencesProvider", true},
      {"documentHighlightProvider", true},
      {"documentLinkProvider", {{"resolveProvider", false}}},
      {"renameProvider", {{"prepareProvider", true}}},
      {"documentSymbolProvider", true},
      {"workspaceSymbolProvider", true},
      {"foldingRangeProvider", true},
      {"selectionRangeProvider", true},
      {"callHierarchyProvider", true},
      {"hoverProvider", true},
      {"colorProvider", true},
      {"semanticTokensProvider", semantic_tokens_options()},
      {"inlayHintProvider", true},
      {"codeLensProvider", Json::object()},
      {"codeActionProvider", code_action_options()},
      {"documentFormattingProvider", true},
      {"documentRangeFormattingProvider", true},
      {"documentOnTypeFormattingProvider", typing_triggers()},
      {"executeCommandProvider", {{"commands", command_names()}}},
      {"workspace", {{"workspaceFolders", {{"supported", true}, {"changeNotifications", true}}}}},
  };
}

std::vector<std::filesystem::path> folders_in(const Json& folders) {
  std::vector<std::filesystem::path> paths;
  if (!folders.is_array()) return paths;
  for (const Json& folder : folders) {
    paths.push_back(path_of_uri(folder.at("uri").get_ref<const std::string&>()));
  }
  return paths;
}

/// Files that the server wants to know about when they change on disk.
void watch_files(Session& session) {
  const std::string capability = "/workspace/didChangeWatchedFiles/dynamicRegistration";
  if (!session.client().can(capability)) return;
  Json watchers = Json::array();
  for (const char* pattern : {"**/*.scene", "**/*.json", "**/.sdlc.toml"}) {
    watchers.push_back({{"globPattern", pattern}});
  }
  for (const lang::DataFormatInfo& format : lang::kDataFormats) {
    watchers.push_back({{"globPattern", fmt::format("**/*{}", format.extension)}});
  }
  session.connection().request(
      "client/registerCapability",
      {{"registrations",
        Json::array({{{"id", "files"},
                      {"method", "workspace/didChangeWatchedFiles"},
                      {"registerOptions", {{"watchers", std::move(watchers)}}}}})}});
}

/// Tells the user what is wrong with them.
Settings settings_in(Session& session, const Json& json) {
  std::vector<std::string> mistakes;
  const Settings settings = Settings::of(json, mistakes);
  for (const std::string& mistake : mistakes) session.show_once(mistake);
  return settings;
}

void change_settings(Session& session, const Json& json) {
  const Settings settings = settings_in(session, json);
  const bool has_changed = settings.inlay_hints != session.settings().inlay_hints;
  session.set_settings(settings);
  if (has_changed) refresh_inlay_hints(session);
}

/// Asks the client for the section `sdlc`. A client that knows nothing about it keeps the settings.
void ask_for_settings(Session& session) {
  if (!session.client().can("/workspace/configuration")) return;
  session.connection().request("workspace/configuration",
                               {{"items", Json::array({{{"section", "sdlc"}}})}},
                               [&session](const Json* result) {
                                 if (!result || !result->is_array() || result->empty()) return;
                                 if (result->front().is_null()) return;
                                 change_settings(session, result->front());
                               });
}

}  // namespace

Json initialize(Session& session, const Json& params) {
  session.set_client(Client(params.value("capabilities", Json::object())));
  const Json folders = params.value("workspaceFolders", Json());
  if (folders.is_array()) {
    session.set_folders(folders_in(folders));
  } else if (params.contains("rootUri") && params.at("rootUri").is_string()) {
    session.set_folders({path_of_uri(params.at("rootUri").get_ref<const std::string&>())});
  }
  session.set_settings(settings_in(session, params.value("initializationOptions", Json())));
  if (params.contains("trace")) set_trace(session, {{"value", params.at("trace")}});
  return {{"capabilities", capabilities_for(session.client())},
          {"serverInfo", {{"name", "sdlc"}, {"version", session.server_options().version}}}};
}

void initialized(Session& session, const Json& /*params*/) {
  watch_files(session);
  ask_for_settings(session);
}

Json shut_down(Session& /*session*/, const Json& /*params*/) { return nullptr; }

void set_trace(Session& session, const Json& params) {
  std::vector<std::string> ignored;
  Settings settings = session.settings();
  settings.trace =
      Settings::of({{"trace", {{"server", params.value("value", Json())}}}}, ignored).trace;
  session.set_settings(settings);
}

void did_change_configuration(Session& session, const Json& params) {
  const Json settings = params.value("settings", Json());
  if (settings.is_object() && settings.contains("sdlc")) {
    change_settings(session, settings.at("sdlc"));
  } else {
    ask_for_settings(session);
  }
}

void did_change_workspace_folders(Session& session, const Json& params) {
  const Json& event = params.at("event");
  std::vector<std::filesystem::path> folders = session.folders();
  for (const auto& removed : folders_in(event.value("removed", Json())))
    std::erase(folders, removed);
  for (auto& added : folders_in(event.value("added", Json()))) folders.push_back(std::move(added));
  session.set_folders(std::move(folders));
}

}  // namespace sdlc::lsp
