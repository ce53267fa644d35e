#pragma once

#include "apps/prompt/settings.hpp"
#include "domain/profile/solid.hpp"

namespace app {

/// `rugosa profile --surface`: what a map is, as files and a page.
int profile_map(const Settings& settings, const rough::Extrusion& extrusion);

} // namespace app
