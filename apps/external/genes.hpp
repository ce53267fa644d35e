#pragma once

#include "ga/problem/problem.hpp"
#include "ga/text/parser.hpp"

#include <string>
#include <vector>

namespace app {

/// What a genome is made of, as --genes says it: real:5:-5:5, bits:40 or permutation:20.
struct Genes {
    enum class Kind { real, bits, permutation };
    Kind kind = Kind::real;
    std::size_t count = 1;
    double lower = 0, upper = 1; ///< of every real gene
};

/// The range of every real gene; none of other kinds.
std::vector<ga::Variable> range_of(const Genes& genes);

/// Throws rough::InputError on anything else.
Genes genes_from(const std::string& text);

/// "f1", "f2", ...: what pipelines call the objectives.
std::vector<std::string> objective_names(std::size_t count);

/// Whether less is better, by the value of --minimise: "" for none, "all", or numbers from 1. Throws
/// rough::InputError on others.
std::vector<bool> minimised(const std::string& text, std::size_t objectives);

/// The pipelines that have a name: ga (one objective) and nsga2 (several), for real genes bipop-cma-es and
/// lshade. They end with the run's budget.
ga::Variants outside_variants(const Genes& genes, std::size_t objectives);

} // namespace app
