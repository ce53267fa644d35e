#pragma once

#include <map>
#include <string>

namespace app {

/// The files of apps/report/templates and apps/report/figures, by name; .cmake/templates.cmake writes them.
const std::map<std::string, std::string>& builtin_files();

} // namespace app
