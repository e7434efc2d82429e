#include "tests/lang/editor/shared_scenes.hpp"

#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "lang/source/source.hpp"

namespace sdlc::test {

using namespace lang;

SharedScenes::SharedScenes(const std::map<std::string, std::string>& texts,
                           const std::vector<std::string>& roots)
    : texts_(texts), files_(texts) {
  for (const std::string& root : roots) {
    std::error_code error;
    auto document = workspace_.load(root, Limits().any_file(), error);
    if (!document) throw std::logic_error("no scene " + root);
    const ProgramOptions options{.workspace = &workspace_, .limits = {}};
    pointers_.push_back(&scenes_.emplace_back(std::move(document), options));
  }
}

SharedSymbol SharedScenes::symbol(const std::string& name, const std::string& cursor) const {
  for (const SceneView* view : pointers_) {
    const auto file = view->find(name);
    if (!file) continue;
    const auto found = shared_symbol(*view, *file, offset_in(texts_.at(name), cursor));
    if (found) return *found;
  }
  throw std::logic_error("no symbol at " + cursor);
}

std::string SharedScenes::describe(const Place& place) const {
  const std::string name = place.path.generic_string();
  const Position position = SourceFile(name, texts_.at(name)).position(place.where.begin);
  return fmt::format("{} {}:{}", name, position.line, position.column);
}

std::vector<std::string> SharedScenes::references(const std::string& file,
                                                  const std::string& cursor,
                                                  bool includes_declaration) const {
  std::vector<std::string> found;
  KnownScenes all = scenes();
  for (const Place& place : lang::references(all, symbol(file, cursor), includes_declaration)) {
    found.push_back(describe(place));
  }
  return found;
}

std::uint32_t offset_in(std::string_view text, const std::string& cursor) {
  const std::size_t mark = cursor.find('#');
  const std::string wanted = cursor.substr(0, mark);
  int count = mark == std::string::npos ? 1 : std::stoi(cursor.substr(mark + 1));
  std::size_t at = text.find(wanted);
  while (at != std::string_view::npos && --count > 0) at = text.find(wanted, at + 1);
  if (at == std::string_view::npos) throw std::logic_error("no cursor " + cursor);
  return static_cast<std::uint32_t>(at);
}

}  // namespace sdlc::test
