#include "apps/commands/commands.hpp"
#include "apps/prompt/settings.hpp"
#include "domain/design/pipelines.hpp"
#include "domain/design/search.hpp"
#include "domain/paper/variants.hpp"
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
    const auto list = [](const std::string& title, const ga::Variants& variants) {
        std::cout << "\n" << title << "\n";
        for (const auto& [name, text] : variants)
            std::cout << "  " << name << " = " << text << "\n";
    };
    list("variants of rugosa design and of experiments of kind variants", rough::design_variants());
    const rough::Vocabulary vocabulary{std::make_shared<rough::DominanceRule>(rough::Model{})};
    list("variants of the paper's experiment, where shape, fit and a second target are not to be had",
         rough::paper_variants(vocabulary));
    return 0;
}

} // namespace app
