// Designs a profile for a target file, and prints its genome file.
#include <iostream>
#include <rugosa/domain.hpp>

int main(int, char** arguments) {
    const rough::DesignSetup setup{.targets = {rough::read_target(arguments[1])}};
    const rough::SearchResult found = search(setup, {.pipeline = "shape 8 | score | best 2 | refine lm 10 | best 1"});
    std::cout << genome_file_text(found.best.genome, setup.model.grid.length);
    std::cerr << "similarity " << found.best.lowest() << "\n";
}
