#include "apps/commands.hpp"
#include "apps/settings.hpp"
#include "domain/variants/paper.hpp"
#include "ga/text/listing.hpp"

#include <iostream>

namespace app {

int operators(const Words& words) {
    if (shows_help(words, "operators",
                   "Lists every operator of text pipelines with its parameters, their defaults and ranges, "
                   "and one line\n"
                   "of meaning. Stages are joined by '|'; pair(left, right, unite) sends the same genomes "
                   "down two ways.",
                   {}, {"operators"}))
        return 0;
    read_command_line(words, {});
    const rough::Vocabulary vocabulary{std::make_shared<rough::DominanceRule>(rough::Model{})};
    std::cout << ga::listing(rough::paper_registry(vocabulary))
              << "\nvariants, as they may stand in a pipeline\n";
    for (const auto& [name, text] : rough::paper_variants(vocabulary))
        std::cout << "  " << name << " = " << text << "\n";
    return 0;
}

} // namespace app
