#include "tests/lang/editor/marked_scene.hpp"

#include <stdexcept>
#include <utility>

namespace sdlc::test {

MarkedScene::MarkedScene(std::map<std::string, std::string> texts)
    : files_(take_mark(std::move(texts))) {
  std::error_code error;
  auto root = workspace_.load("root.scene", lang::Limits().any_file(), error);
  if (!root) throw std::logic_error("a marked scene needs a root.scene");
  view_.emplace(std::move(root), lang::ProgramOptions{.workspace = &workspace_});
  const auto file = view_->find(marked_);
  if (!file) throw std::logic_error("the scene does not read " + marked_);
  file_ = *file;
}

std::map<std::string, std::string> MarkedScene::take_mark(
    std::map<std::string, std::string> texts) {
  for (auto& [name, text] : texts) {
    const std::size_t at = text.find('|');
    if (at == std::string::npos) continue;
    text.erase(at, 1);
    marked_ = name;
    offset_ = static_cast<std::uint32_t>(at);
  }
  return texts;
}

}  // namespace sdlc::test
