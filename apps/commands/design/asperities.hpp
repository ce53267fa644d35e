#pragma once

#include "apps/prompt/settings.hpp"
#include "domain/asperities/design.hpp"

namespace app {

/// The settings of an array of caps, each name behind `prefix`.
std::vector<Setting> cap_settings(const std::string& prefix = "");
/// The settings that only `rugosa design` with caps has.
std::vector<Setting> asperity_settings();
/// The array, ranges and modulus that the settings describe, without targets.
rough::CapSetup cap_setup_from(const Settings& settings, const std::string& prefix = "");

/// `rugosa design --asperities`: a design with spherical caps, from settings to files. Returns the exit code.
int design_asperities(const Settings& settings, const std::string& line);

} // namespace app
