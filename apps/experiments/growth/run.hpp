#pragma once

#include "apps/report/page.hpp"
#include "domain/target/target.hpp"

#include <nlohmann/json.hpp>

/// What larger databases are worth, as the page and the tables read it.
namespace app {

struct GrowthTarget {
    rough::Target target;
    nlohmann::json grown;    ///< rows of growth.csv: one of the paper's algorithms from one size each
    nlohmann::json searched; ///< the default search, a seed each: {seed, best: [[paid, similarity]], worst}
};

/// What came out, in sentences; the page's first screen.
std::vector<std::string> growth_words(const std::vector<GrowthTarget>& targets);
/// The picture, a table a target.
void fill_growth_page(Page& page, const std::vector<GrowthTarget>& targets);

} // namespace app
