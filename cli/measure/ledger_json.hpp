#pragma once

#include "cli/measure/json.hpp"
#include "render/measure/study.hpp"

namespace sdlc::cli {

/// The results of a study so far; read_ledger restores the exact numbers.
Json ledger_json(const render::StudyLedger& ledger);

/// Throws std::invalid_argument with the reason if the JSON is not a ledger.
render::StudyLedger read_ledger(const Json& json);

}  // namespace sdlc::cli
