#pragma once

#include "apps/experiments/contact_trial.hpp"

namespace app {

/// A method on a scene.
struct StabilityCell {
    std::string scene, kernel, method;
    bool has_solution;
    ContactTrial trial;
};

/// "433 cells: 380 solved, …"
std::string summary_of(const std::vector<StabilityCell>& cells);

/// A web page: which methods break, where, and what rugosa says then.
std::string stability_page(const std::vector<StabilityCell>& cells);

} // namespace app
