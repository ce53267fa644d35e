#pragma once

#include "apps/commands/design/run.hpp"
#include "apps/prompt/settings.hpp"

namespace app {

/// The flags of `rugosa design`.
std::vector<Setting> design_settings();

/// What they ask for; reads targets and scans. Throws rough::InputError.
DesignRun design_from(const Settings& settings);

} // namespace app
