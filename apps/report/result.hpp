#pragma once

#include "apps/report/record.hpp"
#include "domain/accuracy/respond_within.hpp"
#include "domain/design/search.hpp"

#include <nlohmann/json.hpp>

namespace app {

/// A search's way and answer, of the name; the answer's response is left to whoever needs it.
VariantRun variant_run(const std::string& name, const rough::SearchResult& found,
                       std::vector<StageRecord> stages, double seconds);

/// The model set-up: grid, body, load steps.
nlohmann::json model_json(const rough::Model& model);

/// Name and points, in the columns of the target's file.
nlohmann::json target_json(const rough::Target& target);

/// version, command, seed and threads: what every result.json begins with.
nlohmann::json origin_json(const Origin& origin);

/// result.json of a record; a kind of run adds keys of its own. Each variant has its stages and answer, what
/// was modelled of the answer (an account for each way the target is loaded) and, for the free half-plane,
/// dK/d ln d at each load step.
nlohmann::json result_json(const Record& record);

/// What was modelled, as CURVE.json and result.json hold it: nodes, steps, chromosomes used and dropped with
/// their bound, solver, tolerance, seconds, estimated error, and the same in words.
nlohmann::json account_json(const rough::Account& account);

/// What a search modelled of a genome, and how far off that is from the same model solved throughout
/// (`true_error`).
nlohmann::json modelled_json(const rough::Genome& genome, const rough::Model& model);

} // namespace app
