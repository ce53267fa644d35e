#include "domain/database/build.hpp"

#include "domain/accuracy/respond.hpp"
#include "domain/errors.hpp"
#include "ga/parallel.hpp"

#include <algorithm>
#include <limits>

namespace rough {
namespace {

Response no_response(int steps) {
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    const Eigen::VectorXd column = Eigen::VectorXd::Constant(steps, nothing);
    return {nothing, column, column, column, column, column, Solver::automatic};
}

} // namespace

void build(GenomeStore& store, const BuildOptions& options) {
    const Model& model = store.setup().model;
    const GenomeLaw& law = store.setup().law;
    validate(law);
    const int threads = ga::thread_count(options.threads);
    // A batch is held in memory and stored as one cell.
    constexpr double most_numbers = 1e7;
    const double a_genome = std::max(2 * most_phases(law) + 100, 2. * model.loading.steps + 1);
    const auto batch = std::clamp<std::uint64_t>(static_cast<std::uint64_t>(most_numbers / a_genome), 1,
                                                 std::max<std::uint64_t>(options.batch, 1));
    const auto stopped = [&] { return options.stop && options.stop->load(); };
    while (const auto span = store.take(options.genomes, batch)) {
        std::vector<Genome> genomes(span->count);
        std::vector<Response> responses(span->count);
        ga::parallel_for(span->count, threads, [&](std::size_t i) {
            if (stopped())
                return;
            genomes[i] = drawn(law, span->first + i);
            try {
                responses[i] = respond(genomes[i], model);
            } catch (const NotConverged&) {
                responses[i] = no_response(model.loading.steps);
            }
        });
        if (stopped())
            return;
        store.add(*span, genomes, responses);
        if (!options.go_on(store.stored()))
            return;
    }
}

} // namespace rough
