#pragma once

#include "ga/base/errors.hpp"
#include "ga/problem/problem.hpp"

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

} // namespace ga
