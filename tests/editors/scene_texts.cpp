#include "tests/editors/scene_texts.hpp"

#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>
#include <utility>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/syntax/syntax.hpp"
#include "tests/docs/markdown.hpp"
#include "tests/support/file_test.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

namespace fs = std::filesystem;
using Texts = std::vector<std::shared_ptr<const lang::SourceFile>>;

const fs::path kRoot = SDLC_SOURCE_DIR;

void add(Texts& texts, std::string name, std::string text) {
  texts.push_back(std::make_shared<lang::SourceFile>(std::move(name), std::move(text)));
}

/// A case of the formatter has the text, `>>>`, and the result.
void add_parts(Texts& texts, const std::string& name, const std::string& text) {
  constexpr std::string_view kArrow = "\n>>>\n";
  const std::size_t arrow = text.find(kArrow);
  add(texts, name, text.substr(0, arrow));
  if (arrow != std::string::npos) {
    add(texts, name + " formatted", text.substr(arrow + kArrow.size()));
  }
}

void add_cases(Texts& texts, const std::string& content, const fs::path& path) {
  for (const FileCase& file_case : parse_cases(content, path)) {
    for (const CaseText& text : file_case.texts) {
      if (text.is_flag() || text.name.ends_with(".json")) continue;
      add_parts(texts, path.filename().string() + ": " + file_case.name + " " + text.name,
                text.text());
    }
  }
}

std::vector<fs::path> files_in(const fs::path& folder, std::string_view extension) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
    if (entry.path().extension() == extension) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

void add_files(Texts& texts, const fs::path& folder) {
  static const std::regex kCase("(^|\n)--- \\w+ ---\n");
  for (const fs::path& path : files_in(folder, ".scene")) {
    const std::string content = content_of(path);
    if (std::regex_search(content, kCase)) {
      add_cases(texts, content, path);
    } else {
      add(texts, path.lexically_relative(kRoot).string(), content);
    }
  }
}

void add_blocks(Texts& texts, const fs::path& folder) {
  for (const fs::path& path : files_in(folder, ".md")) {
    for (CodeBlock& block : code_blocks_of(content_of(path))) {
      if (std::ranges::find(block.words, "scene") == block.words.end()) continue;
      add(texts, path.filename().string() + ":" + std::to_string(block.line),
          std::move(block.text));
    }
  }
}

}  // namespace

Texts all_scene_texts() {
  Texts texts;
  add_files(texts, "examples");
  add_files(texts, "tests/files");
  add_blocks(texts, "docs");
  return texts;
}

Texts correct_scene_texts() {
  Texts texts = all_scene_texts();
  std::erase_if(texts, [](const auto& file) {
    lang::DiagnosticSink sink;
    lang::parse(*file, sink);
    return sink.has_errors();
  });
  return texts;
}

}  // namespace sdlc::test
