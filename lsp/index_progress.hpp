#pragma once

#include <mutex>
#include <string>

#include "lsp/connection.hpp"
#include "lsp/folder_index.hpp"

namespace sdlc::lsp {

/// Shows in the editor that the folders are being read, if that takes more than a moment. Its
/// functions are called by the thread of the index.
class IndexProgress {
 public:
  explicit IndexProgress(Connection& connection) : connection_(connection) {}

  /// Whether the client shows progress.
  void set_shown(bool is_shown);
  void begin();
  void report(const FolderIndex::Progress& progress);
  void end(const FolderIndex::Progress& progress);

 private:
  void send(Json value);

  Connection& connection_;
  std::mutex mutex_;
  bool is_shown_ = false;
  int walks_ = 0;
  std::string token_;       // of the walk that goes on
  bool has_begun_ = false;  // the client knows the token
};

}  // namespace sdlc::lsp
