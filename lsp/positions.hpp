#pragma once

#include "lang/source/position_encoding.hpp"
#include "lang/source/source.hpp"
#include "lsp/json_rpc.hpp"

/// Positions and ranges of the protocol, which count from 0.
namespace sdlc::lsp {

Json position_json(const lang::SourceFile& file, std::uint32_t offset,
                   lang::PositionEncoding encoding);
Json range_json(const lang::SourceFile& file, lang::Span span, lang::PositionEncoding encoding);
/// The range of the beginning of a file.
Json first_range();

/// The offset of a position; one outside the text is at its end, or at the end of its line. Throws
/// RequestError (InvalidParams) if it is no position.
std::uint32_t offset_of_json(const lang::SourceFile& file, const Json& position,
                             lang::PositionEncoding encoding);
lang::Span span_of_json(const lang::SourceFile& file, const Json& range,
                        lang::PositionEncoding encoding);

/// Line and column from 1 of a position. Throws RequestError (InvalidParams).
lang::Position position_of_json(const Json& position);

}  // namespace sdlc::lsp
