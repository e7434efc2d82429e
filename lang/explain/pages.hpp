#pragma once

#include <span>
#include <string_view>

namespace sdlc::lang {

struct Page {
  std::string_view name;  ///< of its file, without the extension
  std::string_view text;
};

/// The pages of docs/explain, by name; cmake/SdlcEmbed.cmake writes them.
extern const std::span<const Page> kPages;

}  // namespace sdlc::lang
