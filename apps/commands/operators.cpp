#include "apps/commands/commands.hpp"
#include "apps/prompt/settings.hpp"
#include "domain/design/pipelines.hpp"
#include "ga/text/listing.hpp"

#include <iostream>

namespace app {

int operators(const Words& words) {
    if (shows_help(words, "operators",
                   "Lists every operator of text pipelines with its parameters, their defaults and ranges, "
                   "and one line of meaning. Stages are joined by '|'; pair(left, right, unite) sends the "
                   "same genomes through two pipelines.",
                   {}, {"operators"}))
        return 0;
    read_command_line(words, {});
    rough::DesignSetup two_targets;
    two_targets.targets.resize(2);
    std::cout << ga::listing(rough::design_registry(two_targets));
    std::cout << "\nvariants\n";
    for (const auto& [name, text] : rough::design_variants())
        std::cout << "  " << name << " = " << text << "\n";
    return 0;
}

} // namespace app
