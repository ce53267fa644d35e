#pragma once

#include "apps/commands/optimise/genes.hpp"
#include "apps/commands/optimise/solution.hpp"
#include "ga/number.hpp"
#include "ga/problem.hpp"
#include "ga/variation/permutation.hpp"

#include <stdexcept>

namespace app {

/// A problem whose evaluations are made outside: genomes are drawn here, and no more is known of them.
template <class G>
struct OutsideProblem {
    using Genome = G;
    using Outcome = Answer;

    Genes genes;
    std::vector<ga::Objective<Answer>> list;
    std::vector<ga::Variable> range; ///< of real genes

    OutsideProblem(const Genes& of, const std::vector<bool>& minimise) : genes(of) {
        const auto names = objective_names(minimise.size());
        for (std::size_t k = 0; k < names.size(); ++k)
            list.push_back(
                {names[k], [k](const Answer& answer) { return answer.objectives.at(k); }, minimise[k]});
        for (std::size_t i = 0; i < genes.count; ++i)
            range.push_back({i, genes.lower, genes.upper});
    }

    Answer evaluate(const G&) const { throw std::logic_error("evaluated here, expected outside"); }
    const std::vector<ga::Objective<Answer>>& objectives() const { return list; }
    double violation(const Answer& answer) const { return answer.violation; }
    std::size_t bytes(const Answer& answer) const { return answer.objectives.size() * sizeof(double); }
    const std::vector<ga::Variable>& bounds(const G&) const requires std::same_as<G, std::vector<double>> {
        return range;
    }
    G sample(ga::Stream& stream) const {
        if constexpr (std::same_as<G, ga::Permutation>) {
            return ga::Permutation::random(genes.count, stream);
        } else {
            G genome(genes.count);
            for (std::size_t i = 0; i < genes.count; ++i)
                if constexpr (std::same_as<G, std::vector<bool>>)
                    genome[i] = stream.chance(0.5);
                else
                    genome[i] = stream.uniform(range[i].lower, range[i].upper);
            return genome;
        }
    }
};

/// "[0.5,1]": 17 digits where they are needed.
template <class G>
std::string genes_text(const G& genome) {
    std::string text;
    for (const auto gene : genome)
        text += (text.empty() ? "[" : ",") + ga::number(static_cast<double>(gene));
    return text + "]";
}

} // namespace app
