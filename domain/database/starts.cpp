#include "domain/database/starts.hpp"

#include "domain/database/screen.hpp"
#include "domain/errors.hpp"

#include <cmath>

namespace rough {

namespace {

/// The wanted length where the two differ by rounding alone.
double settled(double drawn_out, double wanted) {
    return std::abs(drawn_out - wanted) <= 1e-12 * std::abs(wanted) ? wanted : drawn_out;
}

} // namespace

DatabaseScale scale_to(const GenomeStore& store, const Model& given) {
    const Model wanted = completed(given);
    Model own = completed(store.setup().model);
    const double length = wanted.grid.length / own.grid.length;
    const DatabaseScale scale{length, wanted.body.effective_modulus / own.body.effective_modulus / length};
    own.grid.length = wanted.grid.length;
    own.body.effective_modulus = wanted.body.effective_modulus;
    own.body.datum = settled(own.body.datum * length, wanted.body.datum);
    own.body.strip_width = settled(own.body.strip_width * length, wanted.body.strip_width);
    const std::string differs = difference(fields(own), fields(wanted));
    if (!differs.empty())
        throw InputError(store.file().string() + ": a database of another set-up: its " + differs);
    return scale;
}

Target unscaled(Target target, const DatabaseScale& scale) {
    if (target.against_pressure())
        target.x /= scale.pressure;
    if (!is_contact_fraction(target.quantity))
        for (Eigen::VectorXd* values : {&target.y, &target.lower, &target.upper})
            *values /= scale.pressure;
    return target;
}

Genome drawn_out(Genome genome, double factor) {
    for (Series& series : genome.series) {
        series.lambda *= factor;
        series.A *= std::pow(factor, -series.H); // Eq. 2: G_n ~ A lambda^H
    }
    return genome;
}

std::vector<Genome> stored_starts(const GenomeStore& store, const DesignSetup& setup, std::size_t count,
                                  int threads) {
    const DatabaseScale scale = scale_to(store, setup.model);
    std::vector<Target> targets;
    for (const Target& target : setup.targets)
        targets.push_back(unscaled(target, scale));
    const ScreenOptions options{setup.max_pressure.value_or(0) / scale.pressure, count, threads};
    std::vector<Genome> genomes;
    for (const Match& match :
         screen(store.curves(need_fractions(targets)), store.setup().model, targets, options)) {
        Genome genome = drawn_out(store.genome(match.index), scale.length);
        genome.scale *= match.scale;
        genomes.push_back(folded(std::move(genome)));
    }
    return genomes;
}

} // namespace rough
