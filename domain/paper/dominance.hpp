#pragma once

#include "domain/problem/setup.hpp"

namespace rough {

/// The parts of a profile that dominate its curve (paper, Algorithm 1).
struct DominantParts {
    std::vector<double> correlation; ///< Pearson's correlation of each part with the whole; NaN: undefined
    std::vector<char> dominant;      ///< whether each part is dominant; at least one is
    bool only_best = false;          ///< whether no part exceeds the threshold, so that only the best is kept
};
/// Algorithm 1 for curves of any kind, with the paper's threshold of 0.95. `parts` are the curves of each
/// part alone, compared at the whole's points (our choice; the paper does not state them). A part's curve is
/// constant beyond its ends. An entry is empty if the part is flat or has no response. If no correlation is
/// defined, all parts are dominant.
DominantParts dominant_parts(const Curve& whole, const std::vector<std::optional<Curve>>& parts);

/// The length scales that dominate a genome's K. The correlation is NaN for a flat scale or constant K.
struct Dominance : DominantParts {
    std::vector<LengthScale> scales; ///< the genome's length scales, in the order of the parts
    double price = 0;                ///< price of the curves that were compared, in curves of the rule's model

    /// Whether a chromosome is in a dominant length scale, by the indices of its series and in this series.
    bool at(std::size_t series, std::size_t chromosome) const;
};

/// Algorithm 1 on genomes. Several threads may call it.
class DominanceRule {
  public:
    /// The rule for a model, whose accuracy applies only to whole genomes. A map's grid is halved while a
    /// side has more than 64 nodes, because curves are only correlated here.
    explicit DominanceRule(Model model);

    /// Chromosomes of equal wavenumber, of any series, count as one.
    Dominance operator()(const Genome& genome) const;

  private:
    Model model_;
    double price_; ///< price of a curve of model_, in curves of the given model
};

/// The genome with only its dominant chromosomes.
Genome reduced(const Genome& genome, const Dominance& dominance);

/// The genome with only the length scales whose curve alone follows a target (Cinat, Paggi and Gnecco 2019),
/// by dominant_parts() at the target's points. Each length scale keeps the genome's amplitude and is loaded
/// as far as the target. The price of its curves, in curves of the set-up's model, is added to `work`.
Genome reduced_to_target(const DesignSetup& setup, const Genome& genome, std::size_t target, ga::Work& work);

} // namespace rough
