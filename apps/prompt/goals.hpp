#pragma once

#include "apps/prompt/settings.hpp"
#include "domain/accuracy/respond.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/target/goal.hpp"

#include <functional>

namespace app {

/// Reads a target file for a model; a conductance by --resistivity. Throws rough::InputError where the file
/// cannot be read, or where what it records of its model is not so.
rough::Goal goal_from(const Settings& settings, const std::string& file, const rough::Model& model);

/// y at even points up to the last.
rough::Goal even_goal(rough::Quantity quantity, const std::string& name, rough::Index points, double last,
                      const std::function<double(double)>& y);

/// What a target file records of its model: what its curve depends on besides the surface.
std::map<std::string, std::string> recorded_model(const rough::Model& model);

/// A line for each flag that was given and decides nothing: of another kernel, or of targets that these are
/// not (`targets`, their files).
std::vector<std::string> without_effect(const Settings& settings,
                                        const std::vector<std::string>& targets = {});

} // namespace app
