#include "apps/experiments/chart/words.hpp"

#include "apps/report/units.hpp"

#include <cmath>

namespace app {

std::string time_words(double seconds) {
    return seconds < 1e-3 ? brief(1e6 * seconds, 3) + "\u00a0µs"
           : seconds < 1  ? brief(1e3 * seconds, 3) + "\u00a0ms"
                          : brief(seconds, 3) + "\u00a0s";
}

std::string share_words(double share) { return brief(100 * share) + " %"; }

std::string tolerance_word(double tolerance) {
    return "1e" + std::to_string(std::lround(std::log10(tolerance)));
}

std::string enumerated(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t k = 0; k < words.size(); ++k)
        text += (k == 0 ? "" : k + 1 == words.size() ? " and " : ", ") + words[k];
    return text;
}

Html strong(const std::string& words) { return Html::raw("<b>") + words + Html::raw("</b>"); }

} // namespace app
