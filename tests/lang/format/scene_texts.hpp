#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include <gtest/gtest.h>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/format/format.hpp"
#include "lang/source/limits.hpp"
#include "lang/source/source.hpp"
#include "tests/lang/syntax/tree_checks.hpp"

namespace sdlc::test {

struct SceneText {
  std::string name;
  std::string text;
};

/// The scenes of these folders of the repository, by name.
inline std::vector<SceneText> scenes_in(const std::vector<std::string>& folders) {
  std::vector<SceneText> texts;
  for (const std::string& folder : folders) {
    const auto path = std::filesystem::path(SDLC_SOURCE_DIR) / folder;
    for (const auto& entry : std::filesystem::directory_iterator(path)) {
      std::error_code error;
      if (entry.path().extension() != ".scene") continue;
      if (auto text = lang::DiskFileSystem().read(entry.path(), lang::Limits().any_file(), error)) {
        texts.push_back({entry.path().string(), std::move(*text)});
      }
    }
  }
  std::ranges::sort(texts, {}, &SceneText::name);
  return texts;
}

/// Texts without mistakes: the examples, and a text with every construct of the language.
inline std::vector<SceneText> sound_scenes() {
  std::vector<SceneText> texts = scenes_in({"examples", "examples/library", "tests/files/whole"});
  texts.push_back({"language.scene", std::string(kWholeLanguage)});
  return texts;
}

/// The formatted form of a text without mistakes.
inline std::string formatted(const std::string& text) {
  const lang::Document file("test.scene", text);
  lang::DiagnosticSink sink;
  const auto outcome = lang::format_file(file, sink);
  if (!outcome) ADD_FAILURE() << sink.diagnostics().front().message << "\n" << text;
  return outcome.value_or("");
}

}  // namespace sdlc::test
