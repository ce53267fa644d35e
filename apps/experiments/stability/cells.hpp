#pragma once

#include "apps/experiments/contact_trial.hpp"
#include "apps/report/record.hpp"

#include <filesystem>

namespace app {

/// A method on a scene.
struct StabilityCell {
    std::string scene, kernel, method;
    bool has_solution;
    ContactTrial trial;
};

/// "433 cells: 380 solved, ..."
std::string summary_of(const std::vector<StabilityCell>& cells);

/// Writes result.json and stability.csv.
void write_stability(const std::vector<StabilityCell>& cells, const Origin& origin,
                     const std::filesystem::path& folder);

} // namespace app
