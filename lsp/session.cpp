#include "lsp/session.hpp"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "lang/editor/config_text.hpp"
#include "lang/source/data_format.hpp"
#include "lang/source/nearest_offset.hpp"
#include "lsp/positions.hpp"
#include "lsp/uri.hpp"

namespace sdlc::lsp {

namespace fs = std::filesystem;

Session::Session(Connection& connection, Log& log, const ServerOptions& options, Post post)
    : connection_(connection),
      log_(log),
      post_(std::move(post)),
      server_options_(options),
      publisher_(disk_, connection),
      index_progress_(connection),
      index_(disk_,
             {.begin = [this] { index_progress_.begin(); },
              .report = [this](const auto& progress) { index_progress_.report(progress); },
              .end = [this](const auto& progress) { index_progress_.end(progress); },
              .changed = [this] { post_([this] { update_scenes(); }); }},
             FolderIndex::kMaxScenes, options.has_threads),
      checks_(
          disk_, {.limits = options.limits, .is_sandboxed = options.is_sandboxed}, log,
          [this](const Checks::Result& result) {
            publisher_.publish(result);
            post_([this, scene = result.scene] { review_choices(scene); });
          },
          options.has_threads) {}

void Session::run_due() {
  index_.run_due();
  checks().run_due();
}

RenderRuns& Session::renders() {
  if (!renders_) {
    renders_ = std::make_unique<RenderRuns>(
        server_options_.program,
        [this](std::string_view method, Json params) {
          connection_.notify(method, std::move(params));
        },
        [this](std::string_view method, Json params, Connection::OnResult on_result) {
          connection_.request(method, std::move(params), std::move(on_result));
        });
  }
  return *renders_;
}

Previews& Session::previews() {
  if (!previews_) {
    previews_ = std::make_unique<Previews>(
        server_options_.program,
        [this](const Previews::Place& place) { post_([this, place] { show_place(place); }); });
  }
  return *previews_;
}

void Session::show_place(const Previews::Place& place) {
  const auto document = load(place.path);
  if (!document || !client_.can("/window/showDocument/support")) return;
  const std::uint32_t offset = lang::nearest_offset(*document, place.position);
  connection_.request("window/showDocument", {{"uri", uri_of(place.path)},
                                              {"takeFocus", true},
                                              {"selection", range(*document, {offset, offset})}});
}

void Session::set_client(Client client) {
  client_ = std::move(client);
  index_.set_encoding(client_.encoding());
  index_progress_.set_shown(client_.can("/window/workDoneProgress"));
  publisher_.configure(client_);
}

void Session::set_settings(const Settings& settings) {
  settings_ = settings;
  log_.set_trace(settings.trace);
  checks_.set_sandboxed(program_options().is_sandboxed);
  views_.clear();
}

void Session::set_folders(std::vector<fs::path> folders) {
  folders_ = std::move(folders);
  index_.set_folders(folders_);
}

lang::ProgramOptions Session::program_options() {
  return {.workspace = &workspace_,
          .limits = server_options_.limits,
          .is_sandboxed = server_options_.is_sandboxed || settings_.is_sandboxed};
}

void Session::open(OpenFile file) {
  const std::string uri = file.uri;
  publisher_.send_again(file.identity);
  change(files_[uri] = std::move(file));
}

void Session::change(const OpenFile& file) {
  workspace_.open(file.path, *file.text, file.version);
  if (previews_) previews_->change(file.path, file.text.get());
  checks_.change(file);
  index_.open(file.path, file.text);
  if (&files_[file.uri] != &file) files_[file.uri] = file;
  texts_changed();
}

void Session::set_outdated(const std::string& uri, const std::string& reason) {
  OpenFile& file = files_.at(uri);
  file.is_outdated = true;
  log_.write(fmt::format("a change of `{}` was refused: {}", uri, reason));
  connection_.show(MessageType::Error,
                   fmt::format("sdlc no longer knows the text of `{}`, because the editor has sent "
                               "a wrong change ({}). Close the file and open it again.",
                               file.path.filename().string(), reason));
}

void Session::close(const std::string& uri) {
  const auto found = files_.find(uri);
  if (found == files_.end()) return;
  const OpenFile file = std::move(found->second);
  files_.erase(found);
  // The same file can be open under another URI, through a link.
  const auto other = std::ranges::find_if(
      files_, [&](const auto& open) { return open.second.identity == file.identity; });
  if (other != files_.end()) return change(other->second);
  workspace_.close(file.path);
  if (previews_) previews_->change(file.path, nullptr);
  checks_.close(file.path);
  index_.close(file.path);
  texts_changed();
}

const OpenFile* Session::find_open(const std::string& uri) const {
  const auto found = files_.find(uri);
  return found == files_.end() ? nullptr : &found->second;
}

void Session::files_changed(const std::vector<fs::path>& files) {
  for (const fs::path& file : files) index_.update(file);
  checks_.check_all();
  texts_changed();
}

void Session::texts_changed() {
  views_.clear();
  plan_update();
}

void Session::plan_update() {
  if (std::exchange(is_update_due_, true)) return;
  post_([this] {
    if (is_update_due_) update_scenes();
  });
}

Checks& Session::checks() {
  if (is_update_due_) update_scenes();
  return checks_;
}

void Session::update_scenes() {
  is_update_due_ = false;
  std::map<fs::path, Publisher::OpenText> open;
  std::set<fs::path> scenes;
  for (const auto& [uri, file] : files_) {
    const fs::path scene = scene_of(file.identity);
    const bool is_json = lang::source_format_of(file.path, *file.text) == lang::SourceFormat::Json;
    const bool is_no_scene = lang::data_format_of(file.path).has_value() ||
                             (is_json && !lang::looks_like_config(*file.text));
    const bool is_foreign = scene == file.identity && is_no_scene;
    Publisher::OpenText& text = open[file.identity];
    text = {.uri = uri,
            .scene = is_foreign ? fs::path() : scene,
            .has_other_uri = !text.uri.empty()};
    if (!is_foreign) scenes.insert(scene);
  }
  publisher_.set_open(std::move(open));
  // A chosen scene that does not read its file today may do so after its next change.
  for (const auto& [file, choice] : chosen_) {
    if (workspace_.is_open(file)) scenes.insert(choice.scene);
  }
  checks_.set_scenes(std::move(scenes));
}

void Session::review_choices(const fs::path& scene) {
  bool has_changed = false;
  for (auto& [file, choice] : chosen_) {
    if (choice.scene != scene || file == scene) continue;
    const std::optional<bool> is_read = checks_.reads(scene, file);
    if (!is_read || *is_read == choice.is_read) continue;
    choice.is_read = *is_read;
    has_changed = true;
    if (choice.is_read) continue;
    connection_.show(MessageType::Warning,
                     fmt::format("`{}` does not read `{}`, which is checked in the scene that is "
                                 "found automatically until it does.",
                                 scene.filename().string(), file.filename().string()));
  }
  if (has_changed) update_scenes();
}

void Session::show_document(const std::string& name, std::string_view text) {
  const fs::path file = pages_.path() / name;
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::system_error(errno, std::generic_category(), file.string());
  connection_.request("window/showDocument", {{"uri", uri_of_path(file)}, {"takeFocus", true}});
}

void Session::show_once(const std::string& warning) {
  constexpr std::size_t kMaxShown = 100;
  if (shown_.size() < kMaxShown && shown_.insert(warning).second) {
    connection_.show(MessageType::Warning, warning);
  }
}

fs::path Session::scene_of(const fs::path& identity) const {
  const auto chosen = chosen_.find(identity);
  if (chosen != chosen_.end() && chosen->second.is_read) return chosen->second.scene;
  const std::vector<fs::path> roots = index_.roots_of(identity);
  if (roots.empty()) return identity;
  const auto is_open = [&](const fs::path& scene) { return workspace_.is_open(scene); };
  const auto open = std::ranges::find_if(roots, is_open);
  return open == roots.end() ? roots.front() : *open;
}

std::vector<fs::path> Session::scenes_with(const fs::path& identity) const {
  std::vector<fs::path> scenes{scene_of(identity)};
  for (fs::path& root : index_.roots_of(identity)) {
    if (root != scenes.front()) scenes.push_back(std::move(root));
  }
  return scenes;
}

void Session::choose_scene(const fs::path& file, std::optional<fs::path> scene) {
  chosen_.erase(file);
  if (scene) chosen_.emplace(file, Choice{.scene = std::move(*scene)});
  update_scenes();
  if (const auto chosen = chosen_.find(file); chosen != chosen_.end()) {
    review_choices(fs::path(chosen->second.scene));  // no check follows if it was checked before
  }
}

std::shared_ptr<const lang::Document> Session::load(const fs::path& path) {
  std::error_code error;
  if (workspace_.is_special(path)) return nullptr;
  return workspace_.load(path, server_options_.limits.any_file(), error);
}

lang::SceneView* Session::view_of(const fs::path& scene) {
  const auto known = std::ranges::find(views_, scene, &View::scene);
  if (known != views_.end()) {
    std::rotate(known, known + 1, views_.end());
    return views_.back().view.get();
  }
  auto root = load(scene);
  const bool is_scene = root && root->format() == lang::SourceFormat::Scene &&
                        !lang::data_format_of(scene).has_value();
  if (!is_scene) return nullptr;
  constexpr std::size_t kMaxViews = 4;
  if (views_.size() == kMaxViews) views_.erase(views_.begin());
  auto view = std::make_unique<lang::SceneView>(std::move(root), program_options(), stop_);
  return views_.emplace_back(View{scene, std::move(view)}).view.get();
}

fs::path Session::path_of(const Json& params) const {
  const std::string& uri = document_uri(params);
  const OpenFile* file = find_open(uri);
  if (file == nullptr) return path_of_uri(uri);
  if (file->is_outdated) {
    throw RequestError(ErrorCode::ContentModified, "the text is not that of the editor");
  }
  return file->path;
}

Text Session::text_of(const Json& params) { return text_at(path_of(params)); }

Text Session::text_at(const fs::path& path) {
  Text text{.identity = workspace_.identity(path)};
  auto document = load(text.identity);
  if (!document) {
    throw RequestError(ErrorCode::InvalidParams, fmt::format("cannot read `{}`", path.string()));
  }
  if (document->format() == lang::SourceFormat::Json) {
    text.source = document.get();
    text.config = std::move(document);
    return text;
  }
  for (const fs::path& scene : {scene_of(text.identity), text.identity}) {
    lang::SceneView* view = view_of(scene);
    const auto file = view == nullptr ? std::nullopt : view->find(text.identity);
    if (!file) continue;  // the scene no longer reads it
    text.view = view;
    text.file = *file;
    text.source = &view->file(*file);
    return text;
  }
  throw RequestError(ErrorCode::InvalidParams, fmt::format("cannot read `{}`", path.string()));
}

std::uint32_t Session::offset(const Text& text, const Json& position) const {
  return offset_of_json(*text.source, position, client_.encoding());
}

lang::Span Session::span(const Text& text, const Json& range) const {
  return span_of_json(*text.source, range, client_.encoding());
}

Json Session::range(const lang::SourceFile& file, lang::Span span) const {
  return range_json(file, span, client_.encoding());
}

Json Session::location(const lang::SourceFile& file, lang::Span span) const {
  return {{"uri", uri_of(file)}, {"range", range(file, span)}};
}

}  // namespace sdlc::lsp
