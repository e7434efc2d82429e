#include "tests/editors/tree_sitter/example_captures.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {

std::vector<std::string> example_files() {
  namespace fs = std::filesystem;
  std::vector<std::string> files;
  for (const char* folder : {"examples", "examples/library", "tests/files/frozen"}) {
    for (const auto& entry : fs::directory_iterator(fs::path(SDLC_SOURCE_DIR) / folder)) {
      if (entry.path().extension() == ".scene") files.push_back(entry.path().string());
    }
  }
  std::ranges::sort(files);
  return files;
}

std::string captures_in_examples(const Query& query) {
  std::string lines;
  for (const std::string& file : example_files()) {
    const std::string text = content_of(file);
    const SceneTree tree(text);
    lines += file + "\n";
    for (const Capture& capture : query.captures(tree)) {
      lines += fmt::format("{} {} {}\n", capture.span.begin, capture.span.end, capture.name);
    }
    if (tree.has_error()) lines += "error\n";
  }
  return lines;
}

}  // namespace sdlc::test
