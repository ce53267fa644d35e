#pragma once

#include "ga/errors.hpp"
#include "ga/problem.hpp"

namespace ga {

/// A feature of a genome that costs nothing to compare with an evaluation, by which surfaces, shapes or
/// programs of the same worth may differ. A pure function; called from several threads.
template <class G>
struct Descriptor {
    std::string name;                   ///< as pipelines call it
    std::function<double(const G&)> of; ///< of a genome
    double lower;                       ///< of the range that is divided into cells
    double upper;                       ///< of that range, above `lower`
    /// Its derivatives with respect to all genes; where there is none, differences stand for them.
    std::function<std::vector<double>(const G&)> gradient = {};
};

/// Optional: features by which genomes differ, for `map-elites` and `emit`.
template <class P>
concept Describing = requires(const P& problem) {
    { problem.descriptors() } -> std::same_as<const std::vector<Descriptor<typename P::Genome>>&>;
};

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

} // namespace ga
