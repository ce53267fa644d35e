#pragma once

#include "apps/report/html.hpp"

#include <string>
#include <vector>

namespace app {

// Figures and settings as the chart's page says them.

std::string time_words(double seconds);       ///< "12.3 ms"
std::string share_words(double share);        ///< "0.1 %"
std::string tolerance_word(double tolerance); ///< "1e-6"
/// "a", "a and b", "a, b and c"
std::string enumerated(const std::vector<std::string>& words);

/// In bold.
Html strong(const std::string& words);

} // namespace app
