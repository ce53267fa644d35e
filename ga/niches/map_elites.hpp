#pragma once

#include "ga/niches/descriptors.hpp"
#include "ga/pipeline/stage.hpp"

#include <map>

namespace ga {

/// MAP-Elites (Mouret and Clune 2015, Illuminating search spaces by mapping elites): the range of each
/// descriptor is divided into `cells`, and of the generation's start and the population together the best of
/// every cell stays. Beyond its range a descriptor counts to the outermost cell. The population is the
/// archive: what goes before chooses among the elites and varies them.
struct MapElites : Operator {
    std::vector<std::string> descriptors; ///< of the problem, one at least
    std::size_t cells = 10;               ///< of each descriptor, >= 1

    ///@{
    /// What every operator has (Operator).
    static Words words() {
        return {"map-elites", "niches",
                "the best in every cell of the descriptors' ranges, the start included"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.descriptors, word_list("descriptors", "of the problem"));
        visit(self.cells, whole("cells", "10", 1, "of each descriptor").up_to(1e6).keyed().quiet());
    }
    std::size_t reads_of_start() const { return everyone; }
    void check(CheckState& known) const {
        known.need_comparable_start(text_of(*this));
        known.need_one_objective(text_of(*this));
    }

    template <Problem P>
    requires Describing<P> PopulationOf<P>
    operator()(PopulationOf<P> population, Context<P>& context) const {
        const auto by = descriptors_of(context.problem(), descriptors, text_of(*this));
        PopulationOf<P> all = joined_with(context.generation_start(), std::move(population));
        std::vector<std::vector<std::size_t>> cell(all.size());
        parallel_for(all.size(), context.threads(), [&](std::size_t i) {
            for (const auto* descriptor : by) {
                const double share = (descriptor->of(all[i].genome) - descriptor->lower) /
                                     (descriptor->upper - descriptor->lower);
                if (std::isnan(share))
                    return;
                cell[i].push_back(static_cast<std::size_t>(
                    std::clamp(share * static_cast<double>(cells), 0.0, static_cast<double>(cells) - 1)));
            }
        });
        std::map<std::vector<std::size_t>, std::size_t> elites;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (cell[i].size() != by.size() || all[i].fitness.has_failed())
                continue;
            const auto [held, fresh] = elites.try_emplace(cell[i], i);
            if (!fresh && better(all[i].fitness, all[held->second].fitness))
                held->second = i;
        }
        PopulationOf<P> archive;
        for (const auto& [place, i] : elites)
            archive.push_back(std::move(all[i]));
        if (archive.empty())
            throw NothingLeft(context.path() + ": nobody has descriptors that are numbers");
        return archive;
    }
    ///@}
};

/// The stage `map-elites descriptors cells=cells`.
inline MapElites map_elites(std::vector<std::string> descriptors, std::size_t cells = 10) {
    return checked(MapElites{{}, std::move(descriptors), cells});
}

} // namespace ga
