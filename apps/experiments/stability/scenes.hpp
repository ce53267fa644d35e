#pragma once

#include "apps/experiments/contact_trial.hpp"

namespace app {

/// A scene in which some method may fail, on one kernel.
struct StabilityScene : ContactScene {
    bool has_solution = true;
};

/// All of them, by the names of the stability table; a scene stands once for every kernel where it makes
/// sense.
std::vector<StabilityScene> stability_scenes();

} // namespace app
