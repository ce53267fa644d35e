#pragma once

#include "apps/experiments/paper/run.hpp"
#include "apps/prompt/settings.hpp"

namespace app {

/// The keys that experiments/paper.ini may set.
std::vector<Setting> paper_settings();

/// What they ask for, nothing run yet: models, targets, database, seed. Reads targets and scans; relative
/// paths in the file are looked for beside it. Throws rough::InputError.
PaperRun paper_from(const Settings& settings, const Origin& origin);

} // namespace app
