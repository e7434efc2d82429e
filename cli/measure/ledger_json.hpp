#pragma once

#include <string>
#include <string_view>

#include "render/measure/study.hpp"

namespace sdlc::cli {

/// What a study has done so far, as text that read_ledger reads back to the same numbers.
std::string to_json(const render::StudyLedger& ledger);

/// Throws std::invalid_argument with the reason where the text is no such thing, or where what it
/// says does not go together.
render::StudyLedger read_ledger(std::string_view text);

}  // namespace sdlc::cli
