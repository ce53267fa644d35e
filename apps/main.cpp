#include "apps/commands.hpp"
#include "apps/settings.hpp"
#include "apps/voice.hpp"
#include "domain/errors.hpp"
#include "ga/errors.hpp"
#include "ga/text/nearest.hpp"

#include <algorithm>
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
    std::cout << "\n'rugosa SUBCOMMAND --help' tells its flags.\n"
                 "--quiet leaves out remarks and progress, --verbose adds details.\n"
                 "Exit codes: 0 done; 2 wrong use or bad input; 3 asked for more than was found; 130 "
                 "interrupted.\n";
}

int dispatch(app::Words words) {
    app::take_voice(words);
    if (words.empty() || words[0] == "--help" || words[0] == "help") {
        print_help();
        return words.empty() ? 2 : 0;
    }
    if (words[0] == "--version") {
        std::cout << "rugosa " RUGOSA_VERSION "\n";
        return 0;
    }
    std::vector<std::string> names;
    for (const auto& command : app::commands()) {
        if (words[0] == command.name)
            return command.run({words.begin() + 1, words.end()});
        names.push_back(command.name);
    }
    throw rough::InputError("'" + words[0] + "' is no subcommand" + ga::suggestion(words[0], names));
}

} // namespace

int main(int count, char** values) {
    try {
        return dispatch({values + 1, values + count});
    } catch (const rough::InputError& error) {
        std::cerr << app::error_mark() << error.what() << "\n";
        return 2;
    } catch (const ga::UsageError& error) {
        std::cerr << "rugosa: " << error.what() << "\n";
        return 2;
    } catch (const rough::NotConverged& error) {
        std::cerr << app::error_mark() << error.what() << "\n";
        return 3;
    } catch (const std::bad_alloc&) {
        std::cerr << app::error_mark()
                  << "not enough memory for this grid, expected fewer nodes or --solver active-set\n";
        return 2;
    } catch (const std::exception& error) {
        std::cerr << app::error_mark() << "internal error: " << error.what() << "\n";
        return 1;
    }
}
