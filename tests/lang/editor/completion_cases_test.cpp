#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lang/editor/completion.hpp"

namespace sdlc::test {
namespace {

namespace fs = std::filesystem;

/// The first completions at places of real scenes. A file in tests/files/complete begins with a
/// line `scene PATH`; each case is a line `OLD => NEW` and the expected labels on the next line:
/// OLD, which the scene contains, is replaced by NEW, in which `|` is the cursor. `\n` is a line
/// end, `<eof>` at the end of NEW removes the rest of the scene. A line without ` => ` is NEW, and
/// without its cursor also OLD. SDLC_UPDATE=1 rewrites the expectations; review them as a user.
constexpr std::size_t kShown = 5;

fs::path root() { return fs::path(SDLC_SOURCE_DIR); }

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string with_line_ends(std::string_view text) {
  std::string result(text);
  for (std::size_t at = 0; (at = result.find("\\n", at)) != std::string::npos;) {
    result.replace(at, 2, "\n");
  }
  return result;
}

/// A scene with the edit of a case.
struct EditedScene {
  std::string text;
  std::uint32_t cursor = 0;
};

EditedScene edit(const std::string& text, std::string_view line) {
  const std::size_t arrow = line.find(" => ");
  std::string after = with_line_ends(line.substr(arrow == std::string_view::npos ? 0 : arrow + 4));
  std::string before = with_line_ends(line.substr(0, arrow));
  if (arrow == std::string_view::npos) before.erase(before.find('|'), 1);
  const std::size_t at = text.find(before);
  const std::size_t cursor = after.find('|');
  if (at == std::string::npos) throw std::runtime_error(fmt::format("not in the scene: {}", line));
  if (cursor == std::string::npos) throw std::runtime_error(fmt::format("no cursor: {}", line));
  after.erase(cursor, 1);
  const std::size_t end = after.find("<eof>");
  if (end != std::string::npos) after.resize(end);
  std::string rest = end != std::string::npos ? "" : text.substr(at + before.size());
  return {text.substr(0, at) + after + rest, static_cast<std::uint32_t>(at + cursor)};
}

std::string first_labels(const fs::path& scene, std::string_view line) {
  const EditedScene edited = edit(read_text(scene), line);
  lang::DiskFileSystem files;
  lang::Workspace workspace(files);
  workspace.open(scene, edited.text);
  std::error_code error;
  auto root = workspace.load(scene, lang::Limits().any_file(), error);
  lang::ProgramOptions options;
  options.workspace = &workspace;
  lang::SceneView view(std::move(root), options);
  const lang::CompletionList list = lang::complete(
      view, 0, edited.cursor, [&](const fs::path& folder) { return files.list(folder); });
  std::string labels;
  for (std::size_t i = 0; i < std::min(kShown, list.items.size()); ++i) {
    labels += (i == 0 ? "" : " · ") + list.items[i].label;
  }
  return labels.empty() ? "nothing" : labels;
}

class CompletionCases : public testing::TestWithParam<fs::path> {};

TEST_P(CompletionCases, HaveTheExpectedFirstLabels) {
  std::istringstream lines(read_text(GetParam()));
  std::string updated;
  fs::path scene;
  std::string current;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("  ")) {
      EXPECT_EQ(current, line.substr(2)) << updated.substr(updated.rfind('\n', updated.size() - 2));
      continue;
    }
    updated += line + "\n";
    if (line.starts_with("scene ") && line.find('|') == std::string::npos) {
      scene = root() / line.substr(6);
    } else if (!line.empty()) {
      SCOPED_TRACE(line);
      current = first_labels(scene, line);
      updated += fmt::format("  {}\n", current);
    }
  }
  if (std::getenv("SDLC_UPDATE") != nullptr) std::ofstream(GetParam()) << updated;
  EXPECT_EQ(updated, read_text(GetParam()));
}

std::vector<fs::path> case_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(root() / "tests/files/complete")) {
    files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

INSTANTIATE_TEST_SUITE_P(Files, CompletionCases, testing::ValuesIn(case_files()),
                         [](const auto& file) { return file.param.stem().string(); });

}  // namespace
}  // namespace sdlc::test
