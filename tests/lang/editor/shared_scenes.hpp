#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lang/editor/navigation.hpp"
#include "lang/editor/scene_view.hpp"
#include "lang/workspace/workspace.hpp"
#include "tests/lang/editor/marked_scene.hpp"

namespace sdlc::test {

/// Scenes that are all in memory.
class KnownScenes final : public lang::SceneSet {
 public:
  explicit KnownScenes(std::vector<const lang::SceneView*> views) : views_(std::move(views)) {}

  std::size_t size() const override { return views_.size(); }
  const lang::SceneView* scene(std::size_t index) override { return views_[index]; }

 private:
  std::vector<const lang::SceneView*> views_;
};

/// Several scenes of one workspace. The cursor is given as text: "size" is the first `size` of the
/// file, "size#3" the third.
class SharedScenes {
 public:
  /// `roots`: the names of the scenes to resolve.
  SharedScenes(const std::map<std::string, std::string>& texts,
               const std::vector<std::string>& roots);

  KnownScenes scenes() const { return KnownScenes(pointers_); }
  const lang::SceneView& view(std::size_t index) const { return *pointers_[index]; }
  /// The symbol at the cursor, in the first scene that reads the file; fails without one.
  lang::SharedSymbol symbol(const std::string& file, const std::string& cursor) const;
  /// "lib.scene 2:5"
  std::string describe(const lang::Place& place) const;
  std::vector<std::string> references(const std::string& file, const std::string& cursor,
                                      bool includes_declaration = true) const;
  const std::map<std::string, std::string>& texts() const { return texts_; }
  lang::Workspace& workspace() { return workspace_; }

 private:
  std::map<std::string, std::string> texts_;
  TextFiles files_;
  lang::Workspace workspace_{files_};
  std::deque<lang::SceneView> scenes_;
  std::vector<const lang::SceneView*> pointers_;
};

/// The offset of the cursor in the text; fails without one.
std::uint32_t offset_in(std::string_view text, const std::string& cursor);

}  // namespace sdlc::test
