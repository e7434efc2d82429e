#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "lang/editor/scene_view.hpp"
#include "lang/workspace/workspace.hpp"

namespace sdlc::test {

/// Files in memory.
class TextFiles final : public lang::FileSystem {
 public:
  explicit TextFiles(std::map<std::string, std::string> texts) : texts_(std::move(texts)) {}

  std::optional<std::string> read(const std::filesystem::path& path, std::uint64_t /*max*/,
                                  std::error_code& error) const override {
    const auto found = texts_.find(path.lexically_normal().generic_string());
    if (found != texts_.end()) return found->second;
    error = std::make_error_code(std::errc::no_such_file_or_directory);
    return std::nullopt;
  }

 private:
  std::map<std::string, std::string> texts_;
};

/// A scene in which `|` marks the cursor, with the files that it can read. The file with the mark
/// is the one that is asked about; without one it is the root.
class MarkedScene {
 public:
  explicit MarkedScene(std::string_view text) : MarkedScene({{"root.scene", std::string(text)}}) {}
  /// `texts`: by name; the root is `root.scene`.
  explicit MarkedScene(std::map<std::string, std::string> texts);

  lang::SceneView& view() { return *view_; }
  lang::Workspace& workspace() { return workspace_; }
  std::uint32_t file() const { return file_; }
  std::uint32_t offset() const { return offset_; }
  std::string_view text(std::uint32_t file) const { return view_->file(file).text(); }

 private:
  std::map<std::string, std::string> take_mark(std::map<std::string, std::string> texts);

  std::string marked_ = "root.scene";
  std::uint32_t offset_ = 0;
  TextFiles files_;
  lang::Workspace workspace_{files_};
  std::optional<lang::SceneView> view_;
  std::uint32_t file_ = 0;
};

}  // namespace sdlc::test
