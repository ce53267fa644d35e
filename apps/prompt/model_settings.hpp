#pragma once

#include "apps/prompt/settings.hpp"
#include "domain/response/model.hpp"
#include "domain/scan/source.hpp"

namespace app {

/// Says which pressures those of an unstated modulus are.
inline constexpr const char* modulus_note =
    "note: no --modulus given: E is 1 MPa, so pressures and stiffness are in units of E";

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

rough::Kernel kernel_from(const Settings& settings, const std::string& prefix = "");

/// The model on a grid that --nodes and --length may change, complete. Throws rough::InputError if it has no
/// solution.
rough::Model model_on(rough::Grid grid, const Settings& settings, const std::string& prefix = "");
/// The model they describe, complete. Throws rough::InputError where it has no solution.
rough::Model model_from(const Settings& settings, const std::string& prefix = "");
/// The same for what brings its own grid along: nodes and length default to that.
rough::Model model_from(const Settings& settings, const rough::Source& source,
                        const std::string& prefix = "");

/// The end of the load and what a node bears: --to-pressure, --pressures and --hardness.
std::vector<Setting> loading_settings();
/// The model under that load. Throws rough::InputError on loads that contradict each other.
rough::Model loaded(rough::Model model, const Settings& settings);

} // namespace app
