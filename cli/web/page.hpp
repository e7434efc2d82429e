#pragma once

#include "cli/web/web_server.hpp"

namespace sdlc::cli {

/// The page of `sdlc serve`: one file that loads nothing else.
WebResource page();

}  // namespace sdlc::cli
