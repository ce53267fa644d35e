#pragma once

#include "apps/report/record.hpp"

/// What larger databases are worth, as the page and the tables read it.
namespace app {

/// One of the paper's algorithms from a database of one size.
struct Grown {
    std::string variant;
    std::uint64_t size = 0;     ///< stored genomes
    std::size_t u1 = 0, u2 = 0; ///< genomes above 0.95 at low and at high pressure, "at least 3" included
    std::uint64_t pairs = 0;    ///< distinct ones that were tried: |U3| = u1 u2, where it is not capped
    long given_up = 0;          ///< of them, as an exact bound showed that they are not among the best
    double best_child = unset_number; ///< before refinement
    double similarity = unset_number,
           worst = unset_number;        ///< of the answer; its worst over grids and load steps
    std::vector<std::uint64_t> parents; ///< their numbers in the database
    long curves = 0; ///< paid: the database's, Algorithm 1's, the children's and the refinement's
    double seconds = 0;

    static constexpr double unset_number = std::numeric_limits<double>::quiet_NaN();
};

/// A search's best so far when so many curves and gradients were paid.
struct Course {
    std::uint64_t seed;
    std::vector<std::pair<double, double>> best; ///< paid, similarity
    double worst = 0;                            ///< of its answer
};

struct GrowthTarget {
    rough::Target target;
    std::vector<Grown> grown;       ///< size by size
    std::vector<Course> by_default; ///< the default search, a seed each
};

struct Growth {
    Origin origin;
    std::vector<GrowthTarget> targets;
    std::uint64_t most_pairs = 0;
    double seconds = 0;
};

/// What came out, in sentences; the page's first screen.
std::vector<std::string> growth_words(const Growth& growth);
/// The report as a web page.
std::string growth_page(const Growth& growth);

} // namespace app
