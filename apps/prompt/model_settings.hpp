#pragma once

#include "apps/prompt/settings.hpp"
#include "domain/accuracy/respond.hpp"
#include "domain/contact/kernel.hpp"
#include "domain/mwm/sampling.hpp"

namespace app {

/// The settings that make a model: --nodes, --length, --kernel … as flags (prefix "") or keys (prefix
/// "model.").
std::vector<Setting> model_settings(const std::string& prefix = "");

/// How exactly a search or a curve must know a genome's response, for commands that can take less:
/// --accuracy. `against` says what the response is compared with.
Setting accuracy_setting(const std::string& prefix = "", const std::string& against = "the model's own");
/// 0 where none is asked for. Throws rough::InputError on one that is not more than 0 and at most 1.
double accuracy_from(const Settings& settings, const std::string& prefix = "");

/// --nodes, from `least` to 1e7, or what stands for it where it is not given.
rough::Index nodes_from(const Settings& settings, rough::Index otherwise, const std::string& prefix = "",
                        rough::Index least = 2);

/// The model they describe. A measured profile brings its own grid: nodes and length then default to its own.
rough::Model model_from(const Settings& settings, const std::string& prefix = "");
/// Of a genome that was made for a length (mm), which --length overrides.
rough::Model model_from(const Settings& settings, double length);
rough::Model model_from(const Settings& settings, const rough::Profile& scan, const std::string& prefix = "");

/// The shortest wave that a search may use, mm; 8 node distances where none is given. Throws
/// rough::InputError on one that the grid does not see: shorter than a node distance.
double shortest_wave_from(const Settings& settings, const std::string& name, const rough::Grid& grid);

const std::vector<std::string>& solver_names(); ///< in the order of rough::Solver
const std::string& name_of(rough::Solver solver);

} // namespace app
