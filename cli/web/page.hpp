#pragma once

#include <string_view>

#include "cli/web/web_server.hpp"

namespace sdlc::cli {

/// The page of `sdlc serve`: one file that loads nothing else. `host`: that of the request.
WebResource page(std::string_view host);

}  // namespace sdlc::cli
