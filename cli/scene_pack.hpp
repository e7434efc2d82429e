#pragma once

#include <memory>
#include <string>
#include <utility>

#include "lang/pack/pack.hpp"
#include "lang/program/program.hpp"
#include "lang/source/limits.hpp"
#include "lang/workspace/workspace.hpp"

namespace sdlc::cli {

/// Of the names of packs.
inline constexpr const char* kPackExtension = ".sdlc.zip";

/// A pack as the input of a command: its scene, and a workspace that knows no other files.
class ScenePack {
 public:
  /// `path`: of the pack, as the user named it.
  ScenePack(std::string path, lang::Pack pack)
      : path_(std::move(path)), files_(path_, std::move(pack)) {}
  ScenePack(const ScenePack&) = delete;
  ScenePack& operator=(const ScenePack&) = delete;

  const std::string& path() const noexcept { return path_; }
  /// The name of the scene in messages, `ball.sdlc.zip/ball.scene`.
  std::string scene() const { return files_.scene().string(); }
  std::shared_ptr<const lang::Document> read_scene();
  /// Lets a program read the files of the pack, all of them, and no others.
  void confine(lang::ProgramOptions& program);
  /// Frees the texts, after the last program that reads them.
  void release() { files_.release(); }

 private:
  std::string path_;
  lang::PackFiles files_;
  lang::Workspace workspace_{files_};
};

/// The pack that `file` is, by its first bytes or its name; null for other files, and for standard
/// input, pipes and devices, of which nothing is read. Throws render::IoError.
std::shared_ptr<ScenePack> open_pack(const std::string& file, const lang::Limits& limits,
                                     const lang::Workspace& workspace);

}  // namespace sdlc::cli
