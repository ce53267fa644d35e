#include "apps/commands.hpp"

#include "apps/settings.hpp"

#include <algorithm>
#include <iostream>

namespace app {

const std::vector<Command>& commands() {
    static const std::vector<Command> all{
        {"chart", "chart speed against accuracy for every contact solver", chart},
        {"contact", "press a rough profile on an elastic body: pressure, area and stiffness", contact},
        {"database", "keep genomes and their responses in a file, and ask it for a target", database},
        {"profile", "what a profile is: heights, solid (STL), picture, roughness, spectrum", profile},
        {"run", "run an experiment (.ini): design surfaces and report on them", run},
        {"stability", "try every contact solver where methods fail, and tabulate who fails", stability},
        {"design", "find a rough profile that answers as a target asks", design},
        {"operators", "list what text pipelines are made of", operators},
        {"target", "make target files for a design, or check one", target},
    };
    return all;
}

bool shows_help(const Words& words, const std::string& usage, const std::string& text,
                const std::vector<Setting>& settings, const std::vector<std::string>& examples) {
    if (std::find(words.begin(), words.end(), "--help") == words.end())
        return false;
    std::cout << "Usage: rugosa " << usage << "\n\n" << text << "\n\nFlags:\n" << described(settings);
    if (!examples.empty())
        std::cout << "\nExamples:\n";
    for (const auto& example : examples)
        std::cout << "  rugosa " << example << "\n";
    return true;
}

} // namespace app
