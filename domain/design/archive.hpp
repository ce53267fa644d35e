#pragma once

#include "domain/mwm/stored.hpp"
#include "domain/problem/problem.hpp"
#include "ga/individual.hpp"

#include <algorithm>

namespace rough {

/// The best individuals of all stages of a search, each genome once, best first.
class Archive {
  public:
    /// One of them.
    struct Kept {
        double value;    ///< its similarity
        Genome genome;   ///< as it was scored
        std::string key; ///< equal for equal genomes
    };

    /// Holds `most` individuals.
    explicit Archive(std::size_t most) : most_(most) {}

    /// Takes an individual whose fitness is a similarity, whole or judged.
    void offer(const DesignProblem& problem, const ga::Individual<Genome>& individual) {
        if (!individual.fitness.known() || individual.fitness.has_failed())
            return;
        const std::string& objective = individual.fitness.objective();
        if (objective != "similarity" && objective != "judged")
            return;
        const double value = individual.value();
        if (best.size() == most_ && value <= best.back().value)
            return;
        const std::string key = problem.key(individual.genome);
        if (std::any_of(best.begin(), best.end(), [&](const Kept& kept) { return kept.key == key; }))
            return;
        best.insert(std::upper_bound(best.begin(), best.end(), value,
                                     [](double v, const Kept& kept) { return v > kept.value; }),
                    {value, individual.genome, key});
        if (best.size() > most_)
            best.pop_back();
    }

    std::vector<Kept> best; ///< those so far, best first

  private:
    std::size_t most_;
};

/// As checkpoints hold it, without loss.
inline void to_json(nlohmann::json& j, const Archive::Kept& kept) {
    j = {kept.value, kept.genome, nlohmann::json::binary({kept.key.begin(), kept.key.end()})};
}
/// As to_json wrote it.
inline void from_json(const nlohmann::json& j, Archive::Kept& kept) {
    const auto& key = j.at(2).get_binary();
    kept = {j.at(0), j.at(1).get<Genome>(), std::string(key.begin(), key.end())};
}

} // namespace rough
