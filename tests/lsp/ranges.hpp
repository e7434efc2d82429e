#pragma once

#include <cstdint>

#include "lsp/json_rpc.hpp"

namespace sdlc::test {

/// A position of the protocol.
inline lsp::Json position_at(std::uint32_t line, std::uint32_t character) {
  return {{"line", line}, {"character", character}};
}

/// A range in one line.
inline lsp::Json range_in_line(std::uint32_t line, std::uint32_t begin, std::uint32_t end) {
  return {{"start", position_at(line, begin)}, {"end", position_at(line, end)}};
}

}  // namespace sdlc::test
