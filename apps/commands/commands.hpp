#pragma once

#include "apps/prompt/settings.hpp"

namespace app {

using Words = std::vector<std::string>; ///< the words after the subcommand on the command line

/// A subcommand. Its help page has the words of help/NAME.txt (for a part, help/COMMAND-NAME.txt) and the
/// settings, from which the reading of its command line follows too.
struct Command {
    std::string name;
    std::vector<Setting> settings;
    /// Returns the program's exit code. `line` is the command as it was typed, which results record. Throws
    /// rough::InputError on wrong use or bad input.
    std::function<int(const Settings& settings, const std::string& line)> run;
    std::vector<std::string> positional = {}; ///< settings that need no flag
    std::vector<Command> parts = {};          ///< its subcommands; `run` is empty then
};

/// The command that runs experiments of a kind under its name.
Command short_command(const std::string& kind);
Command contact_command();
Command design_command();
Command database_command();
Command profile_command();
Command report_command();
Command run_command();
Command target_command();
Command operators_command();
Command optimise_command();

/// All subcommands, in the order of the help page.
const std::vector<Command>& commands();

/// Runs the command that the first word names, or prints its help page if --help or -h is among the words.
/// `before` precedes its name: "database " for a part. Returns the program's exit code.
int run_part(const std::vector<Command>& commands, const Words& words, const std::string& before = "");

/// The lines of a help page that list commands, with names in a column of this width. `before` as above.
std::string listed(const std::vector<Command>& commands, std::size_t width, const std::string& before = "");

} // namespace app
