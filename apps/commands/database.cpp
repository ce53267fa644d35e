#include "apps/commands/database/parts.hpp"
#include "apps/prompt/settings.hpp"
#include "domain/errors.hpp"
#include "ga/text/nearest.hpp"

#include <iostream>

namespace app {

int database(const Words& words) {
    const std::vector<Command> parts{
        {"build", "compute genomes and their responses into a file; goes on where it ended", database_build},
        {"info", "what a file holds and to which set-up it belongs", database_info},
        {"merge", "several files of one set-up and law as one", database_merge},
        {"query", "the stored genomes nearest to a target", database_query}};
    if (words.empty())
        throw rough::InputError(
            "database: nothing given, expected build, info, merge or query ('rugosa database "
            "--help' tells more)");
    if (words[0] == "--help" || words[0] == "-h") {
        std::cout << "Usage: rugosa database (build | info | merge | query) FILE [flags]\n\n"
                     "A genome database keeps computed responses, so that a new target is answered in a "
                     "second.\n\n";
        for (const Command& part : parts)
            std::cout << "  " << part.name << std::string(8 - std::string(part.name).size(), ' ')
                      << part.summary << "\n";
        std::cout << "\n'rugosa database build --help' and so on tell the flags.\n\nExamples:\n"
                     "  rugosa database build genomes.db --genomes 100000\n"
                     "  rugosa database info genomes.db\n"
                     "  rugosa database merge a.db b.db --out genomes.db\n"
                     "  rugosa database query genomes.db --target target.csv\n";
        return 0;
    }
    std::vector<std::string> names;
    for (const Command& part : parts) {
        if (words[0] == part.name)
            return part.run({words.begin() + 1, words.end()});
        names.push_back(part.name);
    }
    throw rough::InputError("database: '" + words[0] + "' given" + ga::suggestion(words[0], names));
}

} // namespace app
