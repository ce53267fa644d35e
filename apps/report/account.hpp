#pragma once

#include "domain/accuracy/respond_within.hpp"

#include <nlohmann/json.hpp>

namespace app {

/// What was modelled, as CURVE.json and result.json hold it: nodes, steps, chromosomes used and dropped with
/// their bound, solver, tolerance, seconds, estimated error, and the same in words.
nlohmann::json account_json(const rough::Account& account);

/// What a search modelled of a genome, and how far off that is from the same model solved throughout
/// (`true_error`).
nlohmann::json modelled_json(const rough::Genome& genome, const rough::Model& model);

} // namespace app
