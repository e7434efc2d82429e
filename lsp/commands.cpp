#include "lsp/commands.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/ast/ast.hpp"
#include "lang/compile/compile.hpp"
#include "lang/explain/explain.hpp"
#include "lang/text/ascii.hpp"
#include "lsp/code_actions.hpp"
#include "lsp/methods.hpp"
#include "lsp/session_scenes.hpp"
#include "lsp/uri.hpp"

namespace sdlc::lsp {

namespace fs = std::filesystem;

namespace {

/// The parameters of a request about the text that the argument names, by its URI or a member.
Json about_text(const Json& argument) {
  const Json& uri = argument.is_string() ? argument : argument.at("uri");
  return {{"textDocument", {{"uri", uri}}}};
}
Json member(const Json& argument, const char* name) {
  return argument.is_object() ? argument.value(name, Json()) : Json();
}

// Rendering

bool has_camera(const Text& text) {
  if (!text.is_scene()) return true;  // of a config
  const lang::ast::Node file(text.view->tree(text.file), 0);
  for (const lang::ast::Node statement : file.children()) {
    if (statement.is(lang::SyntaxKind::Object) && statement.head() == "camera") return true;
  }
  return false;
}

/// The first frame of an animation: in an editor, all of them would take too long.
std::optional<int> first_frame(Session& session, const fs::path& scene) {
  const auto document = session.load(scene);
  if (!document) return std::nullopt;
  lang::DiagnosticSink ignored(&session.stop());
  lang::Compiler compiler(*document, session.program_options(), ignored);
  const auto animation = compiler.animation();
  return animation ? std::optional(animation->first) : std::nullopt;
}

const OpenFile* open_file(const Session& session, const fs::path& identity) {
  const auto found = std::ranges::find_if(
      session.open_files(), [&](const auto& file) { return file.second.identity == identity; });
  return found == session.open_files().end() ? nullptr : &found->second;
}

/// The open files, without the scene itself, that the scene reads and that have unsaved changes.
std::vector<std::string> unsaved_files(Session& session, const fs::path& scene) {
  std::vector<std::string> names;
  const lang::SceneView* view = session.view_of(scene);
  if (view == nullptr) return names;
  for (const auto& [uri, file] : session.open_files()) {
    if (file.identity == scene || !view->find(file.identity)) continue;
    std::error_code ignored;
    const auto saved = session.disk().read(file.path, file.text->size(), ignored);
    if (saved != *file.text) names.push_back(fmt::format("`{}`", file.path.filename().string()));
  }
  return names;
}

/// The scene that is shown for a file: itself, if it has a camera.
fs::path shown_scene(Session& session, const Text& text, bool is_itself) {
  return is_itself || has_camera(text) ? text.identity : session.scene_of(text.identity);
}

Json render(Session& session, const Json& argument) {
  const Text text = session.text_of(about_text(argument));
  const Json camera = member(argument, "camera"), frame = member(argument, "frame");
  RenderOrder order{.camera = camera.is_null() ? std::string() : camera.get<std::string>(),
                    .threads = session.settings().threads,
                    .is_sandboxed = session.program_options().is_sandboxed};
  const fs::path scene = shown_scene(session, text, !order.camera.empty());
  order.scene = scene;
  if (const OpenFile* open = open_file(session, scene)) {
    order.scene = open->path;
    order.text = open->text;
  }
  order.frame = frame.is_null() ? first_frame(session, scene) : std::optional(frame.get<int>());
  if (const std::vector<std::string> unsaved = unsaved_files(session, scene); !unsaved.empty()) {
    session.connection().show(
        MessageType::Warning,
        fmt::format("The render reads {} as saved, without the changes in the editor.",
                    fmt::join(unsaved, ", ")));
  }
  session.renders().start(
      std::move(order), {.has_progress = session.client().can("/window/workDoneProgress"),
                         .shows_documents = session.client().can("/window/showDocument/support")});
  return nullptr;
}

Json preview(Session& session, const Json& argument) {
  const Text text = session.text_of(about_text(argument));
  fs::path scene = shown_scene(session, text, false);
  if (const OpenFile* open = open_file(session, scene)) scene = open->path;
  std::vector<PreviewText> texts;
  for (const auto& [uri, file] : session.open_files()) texts.push_back({file.path, file.text});
  const std::string url = session.previews().url_of(
      scene, texts, session.program_options().is_sandboxed, session.settings().threads);
  if (member(argument, "external") == true &&
      session.client().can("/window/showDocument/support")) {
    session.connection().request("window/showDocument", {{"uri", url}, {"external", true}});
  }
  return {{"url", url}, {"scene", session.uri_of(scene)}};
}

Json end_preview(Session& session, const Json& argument) {
  const Json uri = about_text(argument).at("textDocument").at("uri");
  if (session.has_previews()) {
    session.previews().end(path_of_uri(uri.get_ref<const std::string&>()));
  }
  return nullptr;
}

// Fixes and explanations

Json fix_all(Session& session, const Json& argument) {
  const Json edit = fix_all_edit(session, about_text(argument));
  if (edit.is_null()) {
    session.connection().show(MessageType::Info, "There is nothing that can be fixed safely.");
  } else {
    session.connection().request("workspace/applyEdit",
                                 {{"label", "Fix all safe findings"}, {"edit", edit}});
  }
  return nullptr;
}

/// Shows a page in the editor: as a file, or as a message where the editor cannot show files.
void show_page(Session& session, const std::string& code, std::string_view page) {
  if (session.client().can("/window/showDocument/support")) {
    session.show_document(code + ".md", page);
  } else {
    session.connection().show(MessageType::Info, std::string(page));
  }
}

Json explain(Session& session, const Json& argument) {
  const std::string code = lang::upper_case(
      (argument.is_string() ? argument : argument.at("code")).get_ref<const std::string&>());
  const auto page = lang::explanation(code);
  if (!page) {
    throw RequestError(ErrorCode::RequestFailed,
                       fmt::format("no diagnostic has the code `{}`", code));
  }
  if (member(argument, "show") == true) show_page(session, code, *page);
  return {{"code", code}, {"markdown", *page}};
}

// The scene of a file

/// A scene in a list for the user: relative to the folder of the workspace that it is in.
std::string shown_path(const Session& session, const fs::path& path) {
  for (const fs::path& folder : session.folders()) {
    const fs::path below = path.lexically_relative(folder);
    if (!below.empty() && *below.begin() != "..") return below.generic_string();
  }
  return path.string();
}

/// Asks the user for the scene of a file.
void ask_for_scene(Session& session, const fs::path& file) {
  constexpr std::size_t kMaxScenes = 20;
  wait_for_index(session);
  std::vector<fs::path> scenes = session.scenes_with(file);
  if (std::ranges::find(scenes, file) == scenes.end()) scenes.push_back(file);
  if (scenes.size() == 1) {
    return session.connection().show(
        MessageType::Info,
        fmt::format("No scene that is known imports or includes `{}`.", file.filename().string()));
  }
  if (scenes.size() > kMaxScenes) scenes.resize(kMaxScenes);
  const fs::path present = session.scene_of(file);
  std::map<std::string, std::optional<fs::path>> choices{{"Automatic", std::nullopt}};
  Json actions = Json::array();
  for (const fs::path& scene : scenes) {
    std::string title = scene == file ? "On its own" : shown_path(session, scene);
    if (scene == present) title += " (now)";
    actions.push_back({{"title", title}});
    choices[std::move(title)] = scene;
  }
  actions.push_back({{"title", "Automatic"}});
  session.connection().request(
      "window/showMessageRequest",
      {{"type", static_cast<int>(MessageType::Info)},
       {"message", fmt::format("With which scene is `{}` checked?", file.filename().string())},
       {"actions", std::move(actions)}},
      [&session, file, choices = std::move(choices)](const Json* result) {
        if (result == nullptr || !result->is_object()) return;
        const auto choice = choices.find(result->value("title", std::string()));
        if (choice != choices.end()) session.choose_scene(file, choice->second);
      });
}

Json choose_scene(Session& session, const Json& argument) {
  const Text text = session.text_of(about_text(argument));
  if (!argument.is_object() || !argument.contains("scene")) {
    ask_for_scene(session, text.identity);
  } else if (argument.at("scene").is_null()) {
    session.choose_scene(text.identity, std::nullopt);
  } else {
    const fs::path scene = path_of_uri(argument.at("scene").get_ref<const std::string&>());
    session.choose_scene(text.identity, session.workspace().identity(scene));
  }
  return nullptr;
}

struct Command {
  std::string_view name;
  RequestHandler run;
};

constexpr std::array<Command, 6> kCommands{{
    {"sdlc.render", render},
    {"sdlc.preview", preview},
    {"sdlc.endPreview", end_preview},
    {"sdlc.fixAll", fix_all},
    {"sdlc.explain", explain},
    {"sdlc.chooseScene", choose_scene},
}};

}  // namespace

Json execute_command(Session& session, const Json& params) {
  const auto& name = params.at("command").get_ref<const std::string&>();
  const auto command = std::ranges::find(kCommands, name, &Command::name);
  if (command == kCommands.end()) {
    throw RequestError(ErrorCode::InvalidParams, fmt::format("unknown command `{}`", name));
  }
  return command->run(session, params.at("arguments").at(0));
}

void cursor_moved(Session& session, const Json& params) {
  if (!session.has_previews()) return;
  const Text text = session.text_of(params);
  const lang::Position place = text.source->position(session.offset(text, params.at("position")));
  session.previews().move({.path = session.path_of(params), .position = place});
}

void cancel_progress(Session& session, const Json& params) {
  session.renders().cancel(params.at("token"));
}

Json command_names() {
  Json names = Json::array();
  for (const Command& command : kCommands) names.push_back(command.name);
  return names;
}

}  // namespace sdlc::lsp
