#pragma once

#include <string>
#include <vector>

namespace app {

struct Setting;

using Words = std::vector<std::string>; ///< what follows the subcommand on the command line

/// A subcommand. Returns the program's exit code; throws rough::InputError on wrong use or bad input.
struct Command {
    const char* name;
    const char* summary; ///< one line
    int (*run)(const Words&);
};

int chart(const Words& words);
int compare(const Words& words);
int contact(const Words& words);
int design(const Words& words);
int database(const Words& words);
int profile(const Words& words);
int report(const Words& words);
int run(const Words& words);
int target(const Words& words);
int stability(const Words& words);
int operators(const Words& words);
int optimise(const Words& words);

/// All of them, in the order of the help page.
const std::vector<Command>& commands();

/// "rugosa design --target t.csv": the command as it was given, for a result to be repeated by.
std::string command_line(const std::string& subcommand, const Words& words);

/// True when --help or -h is among the words; then prints the page: usage, the text (in lines of its own),
/// the settings and the examples.
bool shows_help(const Words& words, const std::string& usage, const std::string& text,
                const std::vector<Setting>& settings, const std::vector<std::string>& examples);

} // namespace app
