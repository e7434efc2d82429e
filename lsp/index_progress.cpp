#include "lsp/index_progress.hpp"

#include <utility>

#include <fmt/format.h>

namespace sdlc::lsp {

void IndexProgress::set_shown(bool is_shown) {
  const std::scoped_lock lock(mutex_);
  is_shown_ = is_shown;
}

void IndexProgress::begin() {
  const std::scoped_lock lock(mutex_);
  if (!is_shown_) return;
  token_ = fmt::format("sdlc/folders/{}", ++walks_);
  has_begun_ = false;
  // The client must know the token before it is used. The walk may have ended by then.
  connection_.request("window/workDoneProgress/create", {{"token", token_}},
                      [this, token = token_](const Json* result) {
                        const std::scoped_lock answered(mutex_);
                        if (result == nullptr || token != token_) return;
                        has_begun_ = true;
                        send({{"kind", "begin"}, {"title", "Reading scenes"}});
                      });
}

void IndexProgress::report(const FolderIndex::Progress& progress) {
  const std::scoped_lock lock(mutex_);
  if (has_begun_) send({{"kind", "report"}, {"message", fmt::format("{}", progress.read)}});
}

void IndexProgress::end(const FolderIndex::Progress& progress) {
  const std::scoped_lock lock(mutex_);
  if (has_begun_) send({{"kind", "end"}, {"message", fmt::format("{} scenes", progress.read)}});
  has_begun_ = false;
  token_.clear();
  if (!progress.is_limited) return;
  connection_.notify(
      "window/logMessage",
      {{"type", 2},
       {"message", fmt::format("the folders have more scenes than the {} that were read: other "
                               "scenes are unknown to references and renames",
                               FolderIndex::kMaxScenes)}});
}

void IndexProgress::send(Json value) {
  connection_.notify("$/progress", {{"token", token_}, {"value", std::move(value)}});
}

}  // namespace sdlc::lsp
