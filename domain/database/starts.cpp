#include "domain/database/starts.hpp"

#include "domain/database/screen.hpp"
#include "domain/errors.hpp"
#include "domain/problem/response.hpp"
#include "ga/base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace rough {

namespace {

/// The wanted length if the two differ only by rounding.
double settled(double stretched, double wanted) {
    return std::abs(stretched - wanted) <= 1e-12 * std::abs(wanted) ? wanted : stretched;
}

/// A match and its genome, stretched and with the match's amplitude.
struct Stored {
    Match match;
    Genome genome;
};

std::vector<Stored> nearest(const GenomeStore& store, const DesignSetup& setup, std::size_t count,
                            int threads) {
    const DatabaseScale scale = scale_to(store, setup.model);
    std::vector<Target> targets;
    for (const Target& target : setup.targets)
        targets.push_back(unscaled(target, scale));
    const ScreenOptions options{setup.max_pressure.value_or(0) / scale.pressure, count, threads};
    std::vector<Stored> all;
    for (const Match& match :
         screen(store.curves(need_fractions(targets)), store.setup().model, targets, options)) {
        all.push_back({match, drawn_out(store.genome(match.index), scale.length)});
        all.back().genome.scale *= match.scale;
    }
    return all;
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
        throw InputError(store.file().string() + ": a database of another set-up: its " + differs +
                         "; use another");
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
    std::vector<Genome> genomes;
    for (Stored& stored : nearest(store, setup, count, threads))
        genomes.push_back(folded(std::move(stored.genome)));
    return genomes;
}

std::vector<StoredAnswer> stored_answers(const GenomeStore& store, const DesignSetup& given,
                                         std::size_t count, int threads) {
    constexpr std::size_t min_verified = 16;
    const DesignSetup setup = completed(given);
    validate(setup);
    const std::vector<Stored> stored = nearest(store, setup, std::max(count, min_verified), threads);
    std::vector<std::optional<StoredAnswer>> verified(stored.size());
    const DesignSetup reported = as_reported(setup);
    ga::parallel_for(stored.size(), ga::thread_count(threads), [&](std::size_t i) {
        const auto& [match, genome] = stored[i];
        try {
            verified[i] = {match.index, match.scale, verified_answer(reported, genome)};
        } catch (const NotConverged&) { // omitted
        } catch (const InputError&) {   // omitted: the response on a finer grid ends before the target
        }
    });
    std::vector<StoredAnswer> answers;
    for (auto& one : verified)
        if (one)
            answers.push_back(std::move(*one));
    std::stable_sort(answers.begin(), answers.end(), [](const StoredAnswer& a, const StoredAnswer& b) {
        return a.answer.lowest() > b.answer.lowest();
    });
    answers.resize(std::min(answers.size(), count));
    return answers;
}

} // namespace rough
