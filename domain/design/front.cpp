#include "domain/design/front.hpp"

#include "domain/design/search.hpp"
#include "domain/errors.hpp"
#include "ga/problem/comparison.hpp"

#include <algorithm>
#include <limits>

namespace rough {

std::vector<Genome> genomes_on_front(const ga::Population<Genome>& population) {
    std::vector<Genome> front;
    if (!ga::comparable(population))
        return front;
    for (const auto& individual : ga::front_of(population))
        if (individual.fitness.several())
            front.push_back(individual.genome);
    return front;
}

std::vector<Compromise> compromises(const DesignSetup& searched, const std::vector<Genome>& genomes,
                                    std::size_t most, int threads) {
    const DesignSetup setup = as_reported(searched);
    const auto each = [&](std::vector<Compromise>& all, auto work) {
        ga::parallel_for(all.size(), ga::thread_count(threads), [&](std::size_t i) {
            try {
                work(all[i]);
            } catch (const NotConverged&) {
                if (!is_stopped(setup.model.contact))
                    throw;
            }
        });
    };
    std::vector<Compromise> all;
    for (const Genome& genome : genomes)
        all.push_back({genome, {}, {}});
    each(all, [&](Compromise& one) {
        const DesignResponse response = respond(setup, one.genome, setup.model);
        one.similarity = similarities(setup, response);
        if (setup.max_pressure)
            one.genome.scale = response.scale;
        one.genome = folded(one.genome);
    });
    std::erase_if(all, [&](const Compromise& one) {
        return one.similarity.empty() || !holds_limits(setup, one.genome);
    });
    std::vector<ga::Point> points;
    for (const Compromise& one : all)
        points.push_back(one.similarity);
    const std::vector<std::size_t> ranks = ga::pareto_ranks(points);
    std::vector<Compromise> front;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (ranks[i] == 0)
            front.push_back(all[i]);
    std::stable_sort(front.begin(), front.end(),
                     [](const Compromise& a, const Compromise& b) { return a.similarity < b.similarity; });
    front.erase(
        std::unique(front.begin(), front.end(),
                    [](const Compromise& a, const Compromise& b) { return a.similarity == b.similarity; }),
        front.end());
    if (front.size() > most) {
        std::vector<Compromise> spread;
        for (std::size_t i = 0; i < most; ++i)
            spread.push_back(front[i * (front.size() - 1) / (most - 1)]);
        front = std::move(spread);
    }
    each(front, [&](Compromise& one) {
        one.similarity_refined.assign(setup.targets.size(), std::numeric_limits<double>::quiet_NaN());
        one.similarity_refined = similarities(setup, respond(setup, one.genome, refined(setup.model, 4)));
    });
    return front;
}

} // namespace rough
