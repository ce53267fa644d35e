#include "apps/commands/commands.hpp"

#include "apps/prompt/settings.hpp"

#include <algorithm>
#include <iostream>
#include <sstream>

namespace app {

const std::vector<Command>& commands() {
    static const std::vector<Command> all{
        {"contact", "press a rough profile on an elastic body: pressure, area and stiffness", contact},
        {"profile", "what a profile is: heights, solid (STL), picture, roughness, spectrum", profile},
        {"target", "make target files for a design, or check one", target},
        {"design", "find a rough profile that answers as a target asks", design},
        {"database", "keep genomes and their responses in a file, and ask it for a target", database},
        {"run", "run an experiment (.ini): design surfaces and report on them", run},
        {"report", "render the page of a result folder again", report},
        {"optimise", "optimise what a program in any language evaluates", optimise},
        {"compare", "compare pipelines on problems with known answers", compare},
        {"operators", "list what text pipelines are made of", operators},
        {"chart", "chart speed against accuracy for every contact solver", chart},
        {"stability", "try every contact solver where methods fail, and tabulate who fails", stability},
    };
    return all;
}

std::string command_line(const std::string& subcommand, const Words& words) {
    std::string line = "rugosa " + subcommand;
    for (const std::string& word : words)
        line += " " + word;
    return line;
}

namespace {

bool asks_help(const Words& words) {
    return std::any_of(words.begin(), words.end(),
                       [](const std::string& word) { return word == "--help" || word == "-h"; });
}

/// In lines of up to 100 letters.
std::string folded(const std::string& text) {
    constexpr std::size_t widest = 100;
    std::istringstream words(text);
    std::string lines, line;
    for (std::string word; words >> word; line += (line.empty() ? "" : " ") + word)
        if (!line.empty() && line.size() + 1 + word.size() > widest) {
            lines += line + "\n";
            line.clear();
        }
    return lines + line + "\n";
}

} // namespace

bool shows_help(const Words& words, const std::string& usage, const std::string& text,
                const std::vector<Setting>& settings, const std::vector<std::string>& examples) {
    if (!asks_help(words))
        return false;
    std::cout << "Usage: rugosa " << usage << "\n\n" << folded(text);
    if (!settings.empty())
        std::cout << "\n" << described(settings);
    if (!examples.empty())
        std::cout << "\nExamples:\n";
    for (const auto& example : examples)
        std::cout << "  rugosa " << example << "\n";
    return true;
}

} // namespace app
