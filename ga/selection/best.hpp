#pragma once

#include "ga/stage.hpp"

#include <numeric>

namespace ga {

/// Positions of the individuals from best to worst; equal ones in the population's order.
template <class G>
std::vector<std::size_t> ranking(const Population<G>& population) {
    std::vector<std::size_t> order(population.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return population[a].value() > population[b].value();
    });
    return order;
}

/// The n best, best first, failed ones last; all when there are fewer.
template <class G>
Population<G> best_of(const Population<G>& population, std::size_t n) {
    std::vector<std::size_t> order = ranking(population);
    order.resize(std::min(n, order.size()));
    Population<G> chosen;
    chosen.reserve(order.size());
    for (const std::size_t i : order)
        chosen.push_back(population[i]);
    return chosen;
}

/// Keeps the n best, best first. n >= 1.
struct Best : Operator {
    std::size_t n;

    explicit Best(std::size_t count) : n(count) {
        if (n == 0)
            throw UsageError("best 0 keeps nobody; expected at least 1");
    }
    std::string text() const { return "best " + std::to_string(n); }
    void check(Known& known) const { known.need_score(text()); }

    template <Problem P>
    Population<typename P::Genome> operator()(Population<typename P::Genome> population, Context<P>&) const {
        return best_of(population, n);
    }
};

inline Best best(std::size_t n) { return Best(n); }

} // namespace ga
