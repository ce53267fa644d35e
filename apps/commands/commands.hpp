#pragma once

#include "apps/prompt/settings.hpp"

#include <functional>
#include <string>
#include <vector>

namespace app {

using Words = std::vector<std::string>; ///< the words behind the subcommand on the command line

/// A subcommand. Its help page, and how its command line is read, follow from it.
struct Command {
    std::string name;
    std::string summary; ///< one line
    std::string usage;   ///< what follows the name, as its help page has it
    std::string text;    ///< of its help page
    std::vector<Setting> settings;
    std::vector<std::string> examples; ///< without the program's name
    /// Returns the program's exit code; `line` is the command as it was given, for a result to be repeated
    /// by. Throws rough::InputError on wrong use or bad input.
    std::function<int(const Settings& settings, const std::string& line)> run;
    std::vector<std::string> positional = {}; ///< settings that need no flag
    std::vector<Command> parts = {};          ///< subcommands of its own, in place of `run`
};

Command chart_command();
Command compare_command();
Command contact_command();
Command design_command();
Command database_command();
Command profile_command();
Command report_command();
Command run_command();
Command target_command();
Command stability_command();
Command operators_command();
Command optimise_command();

/// All of them, in the order of the help page.
const std::vector<Command>& commands();

/// Runs a command with the words that follow its name, or prints its help page where --help or -h is among
/// them. `before` is what stands before its name: "database " of a part. Returns the program's exit code.
int run_with(const Command& command, const Words& words, const std::string& before = "");

/// Commands as a help page lists them, names in a column of this width.
std::string listed(const std::vector<Command>& commands, std::size_t width);

} // namespace app
