#pragma once

#include "apps/report/record.hpp"
#include "domain/accuracy/respond_within.hpp"
#include "domain/design/search.hpp"

namespace app {

/// The record of a search under a name, without the response of its answer.
VariantRun variant_run(const std::string& name, const rough::SearchResult& found,
                       std::vector<StageRecord> stages, double seconds);

/// The model: grid, body, load steps.
nlohmann::json model_json(const rough::Model& model);

/// Name and points of a target, with the columns of its file as keys.
nlohmann::json target_json(const rough::Target& target);

/// The keys of every result.json: version, command, seed and threads.
nlohmann::json origin_json(const Origin& origin);

/// result.json of a record, to which a kind of run adds keys. Each variant has its stages, its answer, and an
/// account of the answer's model per kind of load. On the free half-plane it has dK/d ln d per load step.
nlohmann::json result_json(const Record& record);

/// An account as in CURVE.json and result.json. It has nodes, steps, used and dropped chromosomes with their
/// bound, solver, tolerance, seconds, estimated errors, and a description in words.
nlohmann::json account_json(const rough::Account& account);

/// The account of a genome's response in a search, and its error against the exact model (`true_error`).
nlohmann::json modelled_json(const rough::Genome& genome, const rough::Model& model);

} // namespace app
