#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/editor/scene_view.hpp"
#include "lang/workspace/workspace.hpp"
#include "lsp/checks.hpp"
#include "lsp/client.hpp"
#include "lsp/connection.hpp"
#include "lsp/folder_index.hpp"
#include "lsp/index_progress.hpp"
#include "lsp/json_rpc.hpp"
#include "lsp/log.hpp"
#include "lsp/open_files.hpp"
#include "lsp/previews.hpp"
#include "lsp/publisher.hpp"
#include "lsp/render_runs.hpp"
#include "lsp/semantic_tokens.hpp"
#include "lsp/settings.hpp"
#include "lsp/temporary_folder.hpp"

namespace sdlc::lsp {

/// The text that a request is about, in its present state. Valid until the request ends.
struct Text {
  std::filesystem::path identity;
  const lang::SourceFile* source = nullptr;
  std::shared_ptr<const lang::Document> config = nullptr;  ///< of a JSON config
  lang::SceneView* view = nullptr;  ///< the scene that it is checked in; null for a config
  std::uint32_t file = 0;           ///< its index in the view

  bool is_scene() const noexcept { return view != nullptr; }
};

/// The state of a server: the texts that are open, the settings, and what is known about the files
/// around them. Handlers of messages use it, one at a time, on one thread.
class Session {
 public:
  /// Makes a function run on the thread of the session, after the messages that have arrived.
  using Post = std::function<void(std::function<void()>)>;

  Session(Connection& connection, Log& log, const ServerOptions& options, Post post);

  Connection& connection() noexcept { return connection_; }
  Log& log() noexcept { return log_; }
  const ServerOptions& server_options() const noexcept { return server_options_; }
  const Client& client() const noexcept { return client_; }
  const Settings& settings() const noexcept { return settings_; }
  /// Checks of the scenes of the texts as they are now.
  Checks& checks();
  /// Shows a text in the editor, as a file that is removed at the end. Throws std::system_error if
  /// it cannot be written.
  void show_document(const std::string& name, std::string_view text);
  /// A warning that the editor shows, unless it has shown it before.
  void show_once(const std::string& warning);
  const FolderIndex& index() const noexcept { return index_; }
  /// Without threads: does what they would do now.
  void run_due();
  /// Made on first use. Throws std::system_error.
  RenderRuns& renders();
  /// Made on first use.
  Previews& previews();
  bool has_previews() const noexcept { return previews_ != nullptr; }
  const std::vector<std::filesystem::path>& folders() const noexcept { return folders_; }

  void set_client(Client client);
  void set_settings(const Settings& settings);
  void set_folders(std::vector<std::filesystem::path> folders);

  // Open texts

  void open(OpenFile file);
  /// Replaces an open text.
  void change(const OpenFile& file);
  /// A change of an open text could not be applied: until a whole text arrives, requests about it
  /// are refused, and the user is told.
  void set_outdated(const std::string& uri, const std::string& reason);
  void close(const std::string& uri);
  /// Null if the client has not opened it.
  const OpenFile* find_open(const std::string& uri) const;
  /// By URI.
  const std::map<std::string, OpenFile>& open_files() const noexcept { return files_; }
  /// These files may have changed on disk.
  void files_changed(const std::vector<std::filesystem::path>& files);

  // What a request is about

  /// The path that `params.textDocument` names. Throws RequestError (InvalidParams) if it names
  /// none, and (ContentModified) if the text of the editor is not known.
  std::filesystem::path path_of(const Json& params) const;
  /// The text that `params.textDocument` names. Throws RequestError (InvalidParams) if there is
  /// none: it is not open and cannot be read.
  Text text_of(const Json& params);
  Text text_at(const std::filesystem::path& path);
  std::uint32_t offset(const Text& text, const Json& position) const;
  lang::Span span(const Text& text, const Json& range) const;
  Json range(const lang::SourceFile& file, lang::Span span) const;
  Json location(const lang::SourceFile& file, lang::Span span) const;
  /// The URI that the client uses for the file.
  std::string uri_of(const std::filesystem::path& path) const { return publisher_.uri_of(path); }
  std::string uri_of(const lang::SourceFile& file) const {
    return uri_of(std::filesystem::path(file.name()));
  }

  /// The scene as it is now, with what it reads; null if it cannot be read. Valid until the request
  /// ends, or until a few others have been used.
  lang::SceneView* view_of(const std::filesystem::path& scene);
  /// A text of a file that need not be open; null if it cannot be read.
  std::shared_ptr<const lang::Document> load(const std::filesystem::path& path);
  lang::Workspace& workspace() noexcept { return workspace_; }
  const lang::FileSystem& disk() const noexcept { return disk_; }

  // Scenes

  /// The scene that a file is checked in: the one that the user has chosen, if it reads the file;
  /// else the first scene that imports or includes it, open ones first; else the file itself.
  std::filesystem::path scene_of(const std::filesystem::path& identity) const;
  /// All scenes that read the file, the one that it is checked in first.
  std::vector<std::filesystem::path> scenes_with(const std::filesystem::path& identity) const;
  /// Chooses the scene that a file is checked in; nullopt: automatically. A scene that does not
  /// read the file counts as soon as it does: until then, the user is told that it does not.
  void choose_scene(const std::filesystem::path& file, std::optional<std::filesystem::path> scene);

  SemanticResults& semantic_results() noexcept { return semantic_results_; }

  /// Of the request that is being handled.
  const lang::StopRequest& stop() const noexcept { return *stop_; }
  void set_stop(const lang::StopRequest* stop) noexcept { stop_ = stop; }
  /// No check begins until the answer has been sent: it would compete for the processor with what
  /// a user waits for.
  void pause_checks() { pause_.emplace(checks()); }
  void resume_checks() { pause_.reset(); }

  /// Programs and limits as the settings have them, for this thread.
  lang::ProgramOptions program_options();

 private:
  struct View {
    std::filesystem::path scene;
    std::unique_ptr<lang::SceneView> view;
  };

  /// The scene that the user has chosen for a file.
  struct Choice {
    std::filesystem::path scene;
    bool is_read = true;  ///< the scene reads the file, as far as is known
  };

  void show_place(const Previews::Place& place);
  /// The texts have changed: forgets what was made of them, and checks what must be checked.
  void texts_changed();
  /// Updates the scenes after the messages that have arrived: an editor opens many files at once.
  void plan_update();
  void update_scenes();
  /// A check of the scene has ended: those who have chosen it learn whether it reads their file.
  void review_choices(const std::filesystem::path& scene);

  Connection& connection_;
  Log& log_;
  const Post post_;
  bool is_update_due_ = false;
  const ServerOptions server_options_;
  Client client_;
  Settings settings_;
  std::vector<std::filesystem::path> folders_;
  lang::DiskFileSystem disk_;
  lang::Workspace workspace_{disk_};
  std::map<std::string, OpenFile> files_;           // by URI
  std::map<std::filesystem::path, Choice> chosen_;  // by the file's identity
  std::set<std::string> shown_;                     // warnings
  TemporaryFolder pages_;
  std::vector<View> views_;  // the last used one is the last
  SemanticResults semantic_results_;
  const lang::StopRequest* stop_ = nullptr;
  Publisher publisher_;
  IndexProgress index_progress_;
  FolderIndex index_;
  Checks checks_;
  std::optional<Checks::Pause> pause_;  // of the request that is being handled
  std::unique_ptr<RenderRuns> renders_;
  std::unique_ptr<Previews> previews_;  // null: none has been asked for
};

}  // namespace sdlc::lsp
