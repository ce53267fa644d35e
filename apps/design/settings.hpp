#pragma once

#include "apps/design/run.hpp"
#include "apps/settings.hpp"

namespace app {

/// The flags of `rugosa design`.
std::vector<Setting> design_settings();

/// What they ask for; reads targets and scans. Throws rough::InputError.
DesignRun design_from(const Settings& settings);

/// K at `points` even pressures up to the last one of a measured profile's own response, or up to `highest`
/// (MPa; 0: no limit).
rough::Goal goal_like(const rough::Profile& profile, const rough::Model& model, const std::string& name,
                      rough::Index points, double highest);

/// Throws rough::InputError where what the goal's file records of its model is not so.
void expect_same_model(const rough::Goal& goal, const rough::Model& model);

/// What a target file records of its model.
std::map<std::string, std::string> recorded_model(const rough::Model& model);

} // namespace app
