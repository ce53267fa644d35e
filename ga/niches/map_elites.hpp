#pragma once

#include "ga/base/errors.hpp"
#include "ga/pipeline/stage.hpp"
#include "ga/problem/problem.hpp"

#include <map>

namespace ga {

/// The problem's descriptors of these names, in their order. Throws UsageError on an unknown one.
template <Describing P>
std::vector<const Descriptor<typename P::Genome>*>
descriptors_of(const P& problem, const std::vector<std::string>& names, const std::string& stage) {
    std::vector<const Descriptor<typename P::Genome>*> found;
    for (const std::string& name : names) {
        std::string list;
        for (const auto& each : problem.descriptors()) {
            if (each.name == name)
                found.push_back(&each);
            list += (list.empty() ? "" : ", ") + each.name;
        }
        if (found.empty() || found.back()->name != name)
            throw UsageError("stage '" + stage + "': unknown descriptor '" + name + "'; expected one of " +
                             list);
    }
    return found;
}

/// MAP-Elites (Mouret and Clune 2015, Illuminating search spaces by mapping elites). The range of each
/// descriptor is divided into `cells`. Of the generation's start and the population together, the best of
/// every cell stays. A descriptor beyond its range counts for the outermost cell. The population is the
/// archive: the stages before it choose elites and vary them.
struct MapElites : Operator {
    std::vector<std::string> descriptors; ///< the problem's, one at least
    std::size_t cells = 10;               ///< per descriptor, >= 1

    ///@{ What every operator has (Operator).
    static Words words() {
        return {"map-elites", "niches",
                "the best in every cell of the descriptors' ranges, the start included"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.descriptors, word_list("descriptors", "names of the problem's descriptors"));
        visit(self.cells, whole("cells", "10", 1, "per descriptor").up_to(1e6).keyed().quiet());
    }
    std::size_t reads_of_start() const { return everyone; }
    void check(CheckState& known) const {
        known.need_comparable_start(text_of(*this));
        known.need_one_objective(text_of(*this));
    }

    template <Describing P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
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
            throw NothingLeft(context.path() + ": no individual has descriptors that are numbers");
        return archive;
    }
    ///@}
};

/// The stage `map-elites descriptors cells=cells`.
inline MapElites map_elites(std::vector<std::string> descriptors, std::size_t cells = 10) {
    return checked(MapElites{{}, std::move(descriptors), cells});
}

} // namespace ga
