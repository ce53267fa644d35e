#pragma once

#include "apps/report/paper_data.hpp"

#include <nlohmann/json.hpp>

namespace app {

/// One variant's way and answer, as result.json holds it, with what was modelled of the answer: one account
/// for each way the target is loaded, `loaded` being the model that the search used for it. For the free
/// half-plane with dK/d ln d at each load step.
nlohmann::json variant_json(const VariantRun& variant, const std::vector<rough::Model>& loaded);

/// The model set-up at the top of every result.json: grid, body, load steps.
nlohmann::json model_json(const rough::Model& model);

nlohmann::json target_json(const rough::Target& target);

} // namespace app
