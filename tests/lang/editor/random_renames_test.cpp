#include <algorithm>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <gtest/gtest.h>

#include "lang/compile/compile.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/editor/navigation.hpp"
#include "lang/editor/rename.hpp"
#include "lang/editor/scene_view.hpp"
#include "lang/resolve/symbol.hpp"
#include "lang/workspace/workspace.hpp"
#include "render/scene/digest.hpp"
#include "tests/lang/editor/shared_scenes.hpp"

// A rename that is not refused keeps every example, bit for bit.
namespace sdlc::test {
namespace {

namespace fs = std::filesystem;
using namespace lang;

/// All examples, as scenes of one workspace.
class Examples {
 public:
  Examples() {
    for (const auto& entry : fs::directory_iterator(fs::path(SDLC_SOURCE_DIR) / "examples")) {
      if (entry.path().extension() == ".scene") paths_.push_back(entry.path());
    }
    std::ranges::sort(paths_);
    for (const fs::path& path : paths_) {
      std::error_code error;
      auto document = workspace_.load(path, Limits().any_file(), error);
      views_.emplace_back(std::move(document),
                          ProgramOptions{.workspace = &workspace_, .limits = {}});
    }
  }

  const std::deque<SceneView>& views() const { return views_; }

  std::vector<const SceneView*> readers_of(const fs::path& path) const {
    std::vector<const SceneView*> found;
    for (const SceneView& view : views_) {
      if (view.find(path)) found.push_back(&view);
    }
    return found;
  }

  /// The texts with the new name at the places, by path.
  std::map<fs::path, std::string> changed(const std::vector<Place>& places,
                                          std::string_view new_name) const {
    std::map<fs::path, std::string> texts;
    for (auto place = places.rbegin(); place != places.rend(); ++place) {
      auto [text, is_new] = texts.try_emplace(place->path);
      std::error_code error;
      if (is_new) text->second = *files_.read(place->path, Limits().any_file(), error);
      text->second.replace(place->where.begin, place->where.size(), new_name);
    }
    return texts;
  }

  /// Of the scene of a view, with some texts replaced.
  std::uint64_t digest(const SceneView& view, const std::map<fs::path, std::string>& texts) const {
    Workspace workspace(files_);
    for (const auto& [path, text] : texts) workspace.open(path, text);
    std::error_code error;
    const auto root = workspace.load(view.root().name(), Limits().any_file(), error);
    DiagnosticSink sink;
    Compiler compiler(*root, {.workspace = &workspace, .limits = {}, .sets = {}}, sink);
    const auto lowered = compiler.lower({});
    EXPECT_FALSE(sink.has_errors()) << view.root().name();
    return lowered ? render::digest_of(lowered->scene) : 0;
  }

 private:
  DiskFileSystem files_;
  Workspace workspace_{files_};
  std::vector<fs::path> paths_;
  std::deque<SceneView> views_;
};

/// A fresh name, another name of the scene, or one of the language.
std::string random_name(const SceneView& view, std::uint32_t file, std::mt19937& random) {
  const auto symbols = view.table(file).symbols();
  switch (random() % 3) {
    case 0: return "fresh_name";
    case 1: return std::string(symbols[random() % symbols.size()].name);
    default: {
      const char* const names[] = {"red",    "sin",      "sphere", "none",
                                   "radius", "material", "x",      "time"};
      return names[random() % std::size(names)];
    }
  }
}

TEST(RandomRenames, KeepTheExamplesOrAreRefused) {
  const Examples examples;
  std::mt19937 random(11);  // NOLINT(cert-msc51-cpp): the same renames each time
  int done = 0, refused = 0, shared = 0;
  for (const SceneView& view : examples.views()) {
    for (int i = 0; i < 12; ++i) {
      const auto file = static_cast<std::uint32_t>(random() % view.file_count());
      const auto names = view.table(file).occurrences();
      const Occurrence& name = names[random() % names.size()];
      const auto symbol = shared_symbol(view, file, name.where.begin);
      ASSERT_TRUE(symbol);
      const std::string new_name = random_name(view, file, random);
      const std::vector<const SceneView*> views =
          symbol->is_local_to_file ? std::vector{&view} : examples.readers_of(symbol->path);
      KnownScenes scenes(views);
      const RenamePlan plan = plan_rename(scenes, *symbol, new_name);
      if (!plan.refusal.empty()) {
        ++refused;
        continue;
      }
      ++done;
      if (views.size() > 1) ++shared;
      const auto texts = examples.changed(plan.places, new_name);
      // The first of many readers is enough: plan_rename() looks at all.
      EXPECT_EQ(examples.digest(*views.front(), texts), examples.digest(*views.front(), {}))
          << view.file(file).text(name.where) << " to " << new_name << " in "
          << views.front()->root().name();
    }
  }
  EXPECT_GT(done, 20);
  EXPECT_GT(refused, 20);
  EXPECT_GT(shared, 5) << "of symbols that several examples use";
}

}  // namespace
}  // namespace sdlc::test
