#pragma once

#include "apps/prompt/settings.hpp"
#include "domain/target/target.hpp"

namespace app {

/// The target files that a setting names, commas between: as given on the command line, or beside the .ini
/// that names them. Throws rough::InputError where there is none.
std::vector<std::filesystem::path> target_files(const Settings& settings, const std::string& name);

/// What they hold, each named as its file.
std::vector<rough::Target> named_targets(const Settings& settings, const std::string& name);

} // namespace app
