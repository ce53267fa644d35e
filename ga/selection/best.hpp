#pragma once

#include "ga/stage.hpp"

#include <numeric>

namespace ga {

/// Positions of the n best individuals, best first, failed ones last; equal ones in the population's order.
template <class G>
std::vector<std::size_t> ranking(const Population<G>& population, std::size_t n = everyone) {
    std::vector<std::size_t> order(population.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(std::min(n, order.size()));
    std::partial_sort(order.begin(), end, order.end(), [&](std::size_t a, std::size_t b) {
        const double first = population[a].value(), second = population[b].value();
        return first != second ? first > second : a < b;
    });
    order.erase(end, order.end());
    return order;
}

/// The n best, best first, failed ones last; all when there are fewer.
template <class G>
Population<G> best_of(const Population<G>& population, std::size_t n) {
    Population<G> chosen;
    chosen.reserve(std::min(n, population.size()));
    for (const std::size_t i : ranking(population, n))
        chosen.push_back(population[i]);
    return chosen;
}

/// What a block keeps of a generation's start: as many of the best as its stages read.
template <class G>
Population<G> start_of_generation(const Population<G>& population, std::size_t reads) {
    return reads == 0 ? Population<G>() : reads == everyone ? population : best_of(population, reads);
}

/// Keeps the n best, best first. n >= 1.
struct Best : Operator {
    std::size_t n; ///< how many stay, >= 1

    /// Throws UsageError on 0.
    explicit Best(std::size_t count) : n(count) {
        if (n == 0)
            throw UsageError("best 0 keeps nobody; expected at least 1");
    }
    ///@{
    /// What every operator has (Operator).
    std::string text() const { return "best " + std::to_string(n); }
    void check(Known& known) const { known.need_score(text()); }

    Demand demand() const { return {.best = n}; }

    template <Problem P>
    Population<typename P::Genome> operator()(Population<typename P::Genome> population, Context<P>&) const {
        return best_of(population, n);
    }
    ///@}
};

/// The stage `best n`.
inline Best best(std::size_t n) { return Best(n); }

} // namespace ga
