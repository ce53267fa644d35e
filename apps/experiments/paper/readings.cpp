#include "apps/experiments/paper/readings.hpp"

#include "apps/experiments/paper/lookup.hpp"
#include "domain/paper/dominance.hpp"
#include "domain/target/similarity.hpp"
#include "ga/base/parallel.hpp"

#include <algorithm>
#include <limits>

namespace app {

namespace {

using rough::Curve;
using rough::Genome;

Curve at_pressure(const rough::Response& response, double max_pressure) {
    return stretched(secant_stiffness(response),
                     max_pressure / response.pressure[response.steps() - 1]); // Eq. 11
}

Reduction reduction_of(const Genome& genome, const Curve& whole, const PaperRun& run,
                       const rough::DominanceRule& rule) {
    const rough::Dominance dominance = rule(genome);
    const Genome kept = reduced(genome, dominance);
    return {static_cast<double>(waves(kept).size()) / static_cast<double>(waves(genome).size()),
            similarity(whole, at_pressure(respond(kept, run.model), run.max_pressure)), dominance.only_best};
}

/// The coarser (longer) or the finer half of a genome's waves alone.
Genome half_of(const Genome& genome, bool coarse) {
    return filtered(genome, [&](std::size_t s, std::size_t c) {
        return (2 * c < genome.series[s].chromosomes.size()) == coarse;
    });
}

/// How the whole's curves change to those of what is left; NaN where that has no height at the nodes.
Removal removal(const rough::Response& whole, const Genome& left, const rough::Model& model) {
    const rough::Profile profile = sample(left, model.grid);
    if (is_flat(profile, left))
        return {};
    const rough::Response rest = respond(profile, model.body, model.loading, model.contact);
    return {relative_gap(secant_stiffness(whole), secant_stiffness(rest)),
            relative_gap(area_against_pressure(whole), area_against_pressure(rest))};
}

} // namespace

std::vector<Reduction> reductions(const PaperRun& run, const rough::DominanceRule& rule) {
    std::vector<Reduction> rows(run.database.size());
    ga::parallel_for(rows.size(), run.origin.threads, [&](std::size_t i) {
        const Answered& member = run.database[i];
        rows[i] = reduction_of(member.genome, secant_stiffness(member.response), run, rule);
    });
    return rows;
}

void add_removals(const PaperRun& run, Readings& readings) {
    readings.without_coarse.resize(run.database.size());
    readings.without_fine.resize(run.database.size());
    ga::parallel_for(run.database.size(), run.origin.threads, [&](std::size_t i) {
        const Answered& member = run.database[i];
        readings.without_fine[i] = removal(member.response, half_of(member.genome, true), run.model);
        readings.without_coarse[i] = removal(member.response, half_of(member.genome, false), run.model);
    });
}

Readings readings_of(const PaperRun& run) {
    const auto responses = std::make_shared<rough::LoneResponses>(run.model);
    const auto kept_by = [&](rough::DominanceReading reading) {
        return reductions(run, rough::DominanceRule(responses, reading, rough::dominance_threshold));
    };
    const std::size_t count = run.database.size();
    Readings readings;
    readings.same_pressure = kept_by(rough::DominanceReading::same_pressure);
    readings.same_step = kept_by(rough::DominanceReading::same_step);
    add_removals(run, readings);
    rough::Model other = run.model;
    other.body.datum *= readings.datum_factor;
    readings.datum_similarity.resize(count);
    std::vector<Curve> elsewhere(count);
    ga::parallel_for(count, run.origin.threads, [&](std::size_t i) {
        const Answered& member = run.database[i];
        elsewhere[i] = at_pressure(respond(member.genome, other), run.max_pressure);
        readings.datum_similarity[i] = similarity(secant_stiffness(member.response), elsewhere[i]);
    });
    for (const TargetRun& target : run.targets) {
        double best = -std::numeric_limits<double>::infinity();
        for (const Curve& curve : elsewhere)
            best = std::max(best, similarity(target.target, curve));
        readings.datum_best.push_back(best);
    }
    return readings;
}

} // namespace app
