#pragma once

#include "ga/problem/fitness.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace ga {

/// A number that names an individual within a run, the same for any number of threads.
using Identity = std::uint64_t;

/// The identities an individual descends from: none, one or two.
class Parents {
  public:
    Parents() = default;
    /// Of a mutation.
    explicit Parents(Identity only) : identities_{only, 0}, count_(1) {}
    /// Of a cross-over.
    Parents(Identity first, Identity second) : identities_{first, second}, count_(2) {}
    const Identity* begin() const { return identities_.data(); } ///< the first
    const Identity* end() const { return begin() + count_; }     ///< behind the last
    std::size_t size() const { return count_; }                  ///< 0, 1 or 2
    /// The same, in the same order.
    bool operator==(const Parents&) const = default;

  private:
    std::array<Identity, 2> identities_{};
    std::size_t count_ = 0;
};

/// A genome on its way through the stages. Its identity stays when it is scored, refined or transformed; a
/// scored individual that is crossed or mutated begets another, which names it as a parent.
template <class G>
struct Individual {
    G genome{};                      ///< what is evolved
    Identity identity = 0;           ///< names it within the run
    Parents parents;                 ///< whom it was made of
    Fitness fitness;                 ///< unscored until a stage scores it
    std::shared_ptr<const G> origin; ///< the genome as it was when this identity was first refined, or none

    /// Its fitness' value under one objective. Throws UsageError when unscored.
    double value() const { return fitness.value(); }
};

/// Individuals in an order that stages may rely on.
template <class G>
using Population = std::vector<Individual<G>>;

/// Unscored individuals with identities 0, 1, ... in the order given.
template <class G>
Population<G> population(std::vector<G> genomes) {
    Population<G> individuals(genomes.size());
    for (std::size_t i = 0; i < genomes.size(); ++i) {
        individuals[i].genome = std::move(genomes[i]);
        individuals[i].identity = i;
    }
    return individuals;
}

} // namespace ga
