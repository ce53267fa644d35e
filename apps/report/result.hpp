#pragma once

#include "apps/report/variant_run.hpp"
#include "domain/design/search.hpp"

#include <nlohmann/json.hpp>

namespace app {

/// A search's way and answer, of the name; the answer's response is left to whoever needs it.
VariantRun variant_run(const std::string& name, const rough::SearchResult& found,
                       std::vector<StageRecord> stages, double seconds);

/// One variant's way and answer, as result.json holds it, with
/// what was modelled of the answer: one account for each way the target is loaded, `loaded` being the model
/// that the search used for it. For the free half-plane with dK/d ln d at each load step.
nlohmann::json variant_json(const VariantRun& variant, const std::vector<rough::Model>& loaded);

/// The model set-up: grid, body, load steps.
nlohmann::json model_json(const rough::Model& model);

/// What it takes to repeat a run.
struct Origin {
    std::string version, command;
    std::uint64_t seed;
    int threads;
};

/// The top of every result.json: the model set-up and the run's origin.
nlohmann::json head_json(const rough::Model& model, const Origin& origin);

nlohmann::json target_json(const rough::Target& target);

} // namespace app
