#include "cli/scene_pack.hpp"

#include <stdexcept>

#include "lang/pack/zip.hpp"

// A page has no packs, which take zlib.

namespace sdlc::lang {

bool is_zip(std::string_view /*beginning*/) { return false; }

}  // namespace sdlc::lang

namespace sdlc::cli {

std::shared_ptr<const lang::Document> ScenePack::read_scene() {
  throw std::logic_error("a page has no packs");
}

void ScenePack::confine(lang::ProgramOptions& /*program*/) {
  throw std::logic_error("a page has no packs");
}

}  // namespace sdlc::cli
