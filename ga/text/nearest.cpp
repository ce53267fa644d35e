#include "ga/text/nearest.hpp"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <numeric>

namespace ga {

std::size_t edits(const std::string& a, const std::string& b) {
    std::vector<std::size_t> before, last(b.size() + 1), now(b.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        now[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1] ? 1 : 0)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                now[j] = std::min(now[j], before[j - 2] + 1);
        }
        before = last;
        last = now;
    }
    return last[b.size()];
}

std::string suggestion(const std::string& given, const std::vector<std::string>& names) {
    const auto nearest = std::ranges::min_element(names, {}, [&](const auto& name) { return edits(given, name); });
    const auto root = std::ranges::find_if(names, [&](const auto& name) { // crossover: cross
        const auto shorter = std::min(given.size(), name.size());
        return shorter >= 4 && given.compare(0, shorter, name, 0, shorter) == 0;
    });
    if (root != names.end() && edits(given, *nearest) > 1) return "; did you mean '" + *root + "'?";
    if (nearest != names.end() && edits(given, *nearest) <= std::max<std::size_t>(1, given.size() / 3))
        return "; did you mean '" + *nearest + "'?";
    return names.empty() ? "; define one first" : "; use one of " + boost::algorithm::join(names, ", ");
}

} // namespace ga
