#include "apps/commands/commands.hpp"

#include "ga/text/nearest.hpp"

#include <algorithm>
#include <iostream>
#include <sstream>

namespace app {

const std::vector<Command>& commands() {
    static const std::vector<Command> all{
        contact_command(),
        profile_command(),
        target_command(),
        design_command(),
        database_command(),
        run_command(),
        report_command(),
        optimise_command(),
        short_command("compare", "compare pipelines on problems with known answers"),
        operators_command(),
        short_command("chart", "chart speed against accuracy for every contact solver"),
        short_command("stability", "try every contact solver on difficult cases, and tabulate which fail"),
    };
    return all;
}

std::string listed(const std::vector<Command>& commands, std::size_t width) {
    std::string lines;
    for (const Command& command : commands)
        lines += "  " + command.name + std::string(width - command.name.size(), ' ') + command.summary + "\n";
    return lines;
}

namespace {

/// A text in lines of up to 100 letters.
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

void print_help(const Command& command, const std::string& name) {
    std::cout << "Usage: rugosa " << name << (command.usage.empty() ? "" : " ") << command.usage << "\n\n"
              << folded(command.text);
    if (!command.parts.empty())
        std::cout << "\n"
                  << listed(command.parts, 8) << "\n'rugosa " << name << " " << command.parts.front().name
                  << " --help' and so on list the flags.\n";
    if (!command.settings.empty())
        std::cout << "\n" << described(command.settings);
    std::cout << "\nExamples:\n";
    for (const auto& example : command.examples)
        std::cout << "  rugosa " << example << "\n";
}

int run_with(const Command& command, const Words& words, const std::string& before) {
    const std::string name = before + command.name;
    const bool is_for_part = !command.parts.empty() && (words.empty() || !words[0].starts_with("-"));
    const auto asks_help = [](const std::string& word) { return word == "--help" || word == "-h"; };
    if (!is_for_part && std::ranges::any_of(words, asks_help)) {
        print_help(command, name);
        return 0;
    }
    if (!command.parts.empty())
        return run_part(command.parts, words, name + " ");
    std::string line = "rugosa " + name;
    for (const std::string& word : words)
        line += " " + word;
    return command.run(read_command_line(words, command.settings, command.positional), line);
}

} // namespace

int run_part(const std::vector<Command>& commands, const Words& words, const std::string& before) {
    Words names;
    for (const Command& command : commands)
        if (names.push_back(command.name); !words.empty() && words[0] == command.name)
            return run_with(command, {words.begin() + 1, words.end()}, before);
    if (words.empty())
        rough::refuse("no subcommand given", ga::suggestion("", names), " ('rugosa ", before,
                      "--help' lists more)");
    names.emplace_back("--help");
    rough::refuse("'", words[0], "' is not a subcommand", ga::suggestion(words[0], names));
}

} // namespace app
