#pragma once

#include "ga/text/registry.hpp"

namespace ga {

/// Lists every operator under its group, with its meaning in one line, and its parameters with defaults and
/// ranges. The named combinations and choices of genes follow.
template <Problem P>
std::string listing(const Registry<P>& registry) {
    constexpr std::size_t column = 44; // column of the meanings
    std::string text, group;
    const auto line = [&](const std::string& indent, const std::string& left, const std::string& right) {
        const std::string start = indent + left;
        text += start + std::string(start.size() < column ? column - start.size() : 1, ' ') + right + "\n";
    };
    for (const auto& entry : registry.entries()) {
        if (entry.group != group) {
            text += (group.empty() ? "" : "\n") + entry.group + "\n";
            group = entry.group;
        }
        std::string usage = entry.name;
        for (const auto& parameter : entry.parameters)
            usage += parameter.standard ? " [" + parameter.name + "]" : " " + parameter.name;
        line("  ", usage + (entry.bodies > 0 ? " { ... }" : ""), entry.meaning);
        for (const auto& parameter : entry.parameters)
            line("      ", parameter.name,
                 parameter.expected() +
                     (parameter.standard && !parameter.standard->empty() ? ", by default " + *parameter.standard : "") +
                     ": " + parameter.meaning);
        if (!entry.lacks.empty()) line("      ", "", "not for this genome: it needs " + entry.lacks);
    }
    line("  ", "pair(left, right, name)",
         "two pipelines on the same population; combines every left with every right individual");
    text += "\ncombinations, the names that pair takes\n";
    for (const auto& [combine, meaning] : registry.combines()) line("  ", combine.name, meaning);
    text += "\nchoices of genes, the names that refine takes for genes\n";
    for (const auto& [variables, meaning] : registry.variables()) line("  ", variables.name, meaning);
    if constexpr (Bounded<P>) line("  ", "all", "every gene within the problem's bounds");
    return text;
}

} // namespace ga
