// Presses the profile of a genome file and prints its last pressure and tangent stiffness, then its
// roughness.
#include "domain/accuracy/respond.hpp"
#include "domain/mwm/genome_json.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/profile/roughness.hpp"

#include <cstdio>

int main(int, char** arguments) {
    const rough::Genome genome = rough::read_genome(arguments[1]);
    const rough::Model model;
    const rough::Response response = respond(genome, model);
    const rough::Index last = response.steps() - 1;
    std::printf("%.17g,%.17g\n", response.pressure[last], response.tangent_stiffness[last]);
    std::printf("Rq %.6g mm\n", rough::roughness(sample(genome, model.grid)).Rq);
}
