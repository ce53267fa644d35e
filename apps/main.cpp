#include "apps/commands/commands.hpp"
#include "apps/prompt/settings.hpp"
#include "apps/prompt/voice.hpp"
#include "domain/errors.hpp"
#include "domain/text/lines.hpp"
#include "ga/errors.hpp"
#include "ga/text/nearest.hpp"

#include <exception>
#include <iostream>
#include <new>

namespace {

void print_help() {
    std::cout << "rugosa " RUGOSA_VERSION ": rough profiles with the contact behaviour that you ask for\n\n"
                 "Usage: rugosa SUBCOMMAND [flags]\n\nSubcommands:\n";
    for (const auto& command : app::commands())
        std::cout << "  " << command.name << std::string(12 - std::string(command.name).size(), ' ')
                  << command.summary << "\n";
    std::cout
        << "\n'rugosa SUBCOMMAND --help' tells its flags and gives examples. To begin with:\n"
           "  rugosa profile --profile SCAN.txt            what a measured surface is, and a solid to print\n"
           "  rugosa design --like SCAN.txt --seconds 10   a designed surface that behaves like it\n\n"
           "--quiet leaves out remarks and progress, --verbose adds details.\n"
           "Exit codes: 0 done; 2 wrong use or bad input; 3 asked for more than was found; 130 "
           "interrupted.\n";
}

int dispatch(app::Words words) {
    app::take_voice(words);
    std::vector<std::string> names;
    for (const auto& command : app::commands())
        names.push_back(command.name);
    if (words.empty())
        throw rough::InputError("no subcommand given" + ga::suggestion("", names) +
                                " ('rugosa --help' tells more)");
    if (words[0] == "help" && words.size() > 1)
        words = {words[1], "--help"};
    if (words[0] == "--help" || words[0] == "-h" || words[0] == "help") {
        print_help();
        return 0;
    }
    if (words[0] == "--version") {
        std::cout << "rugosa " RUGOSA_VERSION "\n";
        return 0;
    }
    for (const auto& command : app::commands())
        if (words[0] == command.name)
            return command.run({words.begin() + 1, words.end()});
    if (words[0].starts_with("-"))
        throw rough::InputError("'" + words[0] + "' given, expected a subcommand before its flags" +
                                ga::suggestion(words[0], {"--help", "--version"}));
    throw rough::InputError("'" + words[0] + "' is no subcommand" + ga::suggestion(words[0], names));
}

/// One line whatever is in it: what was read from a file may hold anything.
void complain(const std::string& message) {
    std::string line;
    for (const std::string& part : rough::text_lines(message, ""))
        line += (line.empty() ? "" : " ") + part;
    for (char& c : line)
        if ((c >= 0 && c < ' ') || c == '\x7f')
            c = '?';
    std::cerr << app::error_mark() << line << "\n";
}

} // namespace

int main(int count, char** values) {
    try {
        return dispatch({values + 1, values + count});
    } catch (const rough::InputError& error) {
        complain(error.what());
        return 2;
    } catch (const ga::UsageError& error) {
        complain(error.what());
        return 2;
    } catch (const rough::NotConverged& error) {
        complain(error.what());
        return 3;
    } catch (const std::bad_alloc&) {
        complain("not enough memory for this grid, expected fewer nodes or --solver active-set");
        return 2;
    } catch (const std::exception& error) {
        complain(std::string("internal error: ") + error.what());
        return 1;
    }
}
