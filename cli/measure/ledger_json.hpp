#pragma once

#include <string>
#include <string_view>

#include "render/measure/study.hpp"

namespace sdlc::cli {

/// The results of a study so far, as text; read_ledger restores the exact numbers.
std::string to_json(const render::StudyLedger& ledger);

/// Throws std::invalid_argument with the reason if the text is not a ledger, or is inconsistent.
render::StudyLedger read_ledger(std::string_view text);

}  // namespace sdlc::cli
