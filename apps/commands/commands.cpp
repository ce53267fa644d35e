#include "apps/commands/commands.hpp"

#include "apps/report/render.hpp"
#include "ga/text/nearest.hpp"

#include <boost/algorithm/string.hpp>

#include <iostream>

namespace app {

const std::vector<Command>& commands() {
    static const std::vector<Command> all{
        contact_command(),        profile_command(),   target_command(),       design_command(),
        database_command(),       run_command(),       report_command(),       optimise_command(),
        short_command("compare"), operators_command(), short_command("chart"), short_command("stability"),
    };
    return all;
}

namespace {

/// The lines of help/NAME.txt: a summary, and the words after the name in the usage line if there are any.
/// After an empty line comes the text, and after another one the examples.
std::vector<std::string> help_lines(const std::string& name) {
    const std::string& text = builtin_files().at(boost::replace_all_copy(name, " ", "-") + ".txt");
    std::vector<std::string> lines;
    return boost::split(lines, boost::trim_copy(text), boost::is_any_of("\n"));
}

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
    const std::vector<std::string> lines = help_lines(name);
    const auto text = std::ranges::find(lines, ""), examples = std::find(text + 1, lines.end(), "");
    std::cout << "Usage: rugosa " << name << (text == lines.begin() + 1 ? "" : " " + lines[1]) << "\n\n"
              << folded(boost::join(std::vector(text + 1, examples), " "));
    if (!command.parts.empty())
        std::cout << "\n"
                  << listed(command.parts, 8, name + " ") << "\n'rugosa " << name << " " << command.parts.front().name
                  << " --help' and so on list the flags.\n";
    if (!command.settings.empty()) std::cout << "\n" << described(command.settings);
    std::cout << "\nExamples:\n";
    for (auto example = examples + 1; example != lines.end(); ++example) std::cout << "  rugosa " << *example << "\n";
}

int run_with(const Command& command, const Words& words, const std::string& before) {
    const std::string name = before + command.name;
    const bool is_for_part = !command.parts.empty() && (words.empty() || !words[0].starts_with("-"));
    const auto asks_help = [](const std::string& word) { return word == "--help" || word == "-h"; };
    if (!is_for_part && std::ranges::any_of(words, asks_help)) {
        print_help(command, name);
        return 0;
    }
    if (!command.parts.empty()) return run_part(command.parts, words, name + " ");
    std::string line = "rugosa " + name;
    for (const std::string& word : words) line += " " + word;
    return command.run(read_command_line(words, command.settings, command.positional), line);
}

} // namespace

std::string listed(const std::vector<Command>& commands, std::size_t width, const std::string& before) {
    std::string lines;
    for (const auto& [name, settings, run, positional, parts] : commands)
        lines += "  " + name + std::string(width - name.size(), ' ') + help_lines(before + name)[0] + "\n";
    return lines;
}

int run_part(const std::vector<Command>& commands, const Words& words, const std::string& before) {
    Words names;
    for (const Command& command : commands)
        if (names.push_back(command.name); !words.empty() && words[0] == command.name)
            return run_with(command, {words.begin() + 1, words.end()}, before);
    if (words.empty())
        rough::refuse("no subcommand given", ga::suggestion("", names), " ('rugosa ", before, "--help' lists more)");
    names.emplace_back("--help");
    rough::refuse("'", words[0], "' is not a subcommand", ga::suggestion(words[0], names));
}

} // namespace app
