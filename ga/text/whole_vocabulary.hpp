#pragma once

#include "ga/adaptation/adaptation.hpp"
#include "ga/refinement/refinement.hpp"
#include "ga/text/vocabulary.hpp"

namespace ga {

/// The stage that refines the named choice of genes; `all` is every gene within the problem's bounds.
template <Problem P, class M>
Pipeline<P> refined(M method, const Arguments& a, const Registry<P>& registry) {
    std::vector<std::string> names;
    for (const auto& [variables, meaning] : registry.variables()) {
        if (variables.name == a.word("genes")) return Pipeline<P>(refine(std::move(method), variables));
        names.push_back(variables.name);
    }
    if constexpr (Bounded<P>) {
        if (a.word("genes") == EveryGene().name) return Pipeline<P>(refine(std::move(method)));
        names.push_back(EveryGene().name);
    }
    a.refuse("genes", "unknown genes '" + a.word("genes") + "'" + suggestion(a.word("genes"), names));
}

/// Adds `refine NAME` for a method that describes itself (method_of).
template <class V, Problem P>
void add_method(Registry<P>& registry) {
    using M = decltype(method_of(V()));
    auto entry = Registry<P>::template entry_of<V>();
    entry.name = "refine " + entry.name;
    entry.parameters.push_back(word("genes", "all", "which genes move, and how far"));
    if constexpr (Refinable<P, M>) {
        registry.add(
            std::move(entry), +[](const Arguments& a, const std::vector<Pipeline<P>>&, const Registry<P>& r) {
                V values;
                a.fill(values);
                return refined(method_of(std::move(values)), a, r);
            });
    } else {
        entry.lacks = V::on_residuals ? "residuals with their derivatives: sensitivity" : real_genes;
        registry.add(std::move(entry), {});
    }
}

/// Adds the engine's methods of refinement to a vocabulary.
template <Problem P>
Registry<P> with_refinement(Registry<P> registry) {
    add_method<Minimax>(registry);
    add_method<Mma>(registry);
    add_method<LevenbergMarquardt>(registry);
    add_method<Nlopt>(registry);
    return registry;
}

/// Every operator of the engine: vocabulary() with refinement, with operators that learn from one generation
/// to the next, and with those that keep niches. Includes Eigen and NLopt.
template <Problem P>
Registry<P> whole_vocabulary() {
    Registry<P> registry = with_refinement(vocabulary<P>());
    registry.template add<CmaEs, DifferentialEvolution, LShade, SelfAdaptive, Duel, Epsilon, Proportional<Sharing>,
                          Clearing, Crowding, MapElites, Emit>();
    return registry;
}

} // namespace ga
