#include "domain/database/screen.hpp"

#include "domain/errors.hpp"

#include <queue>

namespace rough {
namespace {

bool better(const Match& left, const Match& right) {
    return left.similarity != right.similarity ? left.similarity > right.similarity : left.index < right.index;
}

/// Some matches, the worst on top.
using WorstFirst = std::priority_queue<Match, std::vector<Match>, decltype(&better)>;

/// The similarity at a scale. Below `bar` the exact value does not matter, and the evaluation stops.
double similarity_above(const std::vector<Curve>& curves, const std::vector<Target>& targets, double scale,
                        double bar) {
    double worst = 0;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const Target& target = targets[i];
        const Curve& points = curves[i];
        const double y_scale = target.quantity == Quantity::load_at_displacement ? scale : 1;
        Index left = 0;
        const Index last = points.x.size() - 2;
        for (Index k = 0; k < target.points() && 1 - worst >= bar; ++k) {
            const double at = target.x[k] / scale;
            while (left < last && at >= points.x[left + 1]) ++left;
            const double share = (at - points.x[left]) / (points.x[left + 1] - points.x[left]);
            const double y = ((1 - share) * points.y[left] + share * points.y[left + 1]) * y_scale;
            worst = std::max(worst, std::abs(misfit(target, k, y)));
        }
    }
    return 1 - worst;
}

constexpr int amplitudes = 33;
double amplitude(double smallest, double step) { return smallest * std::exp2(step / 8); }

/// Narrows a free amplitude between the neighbours of the best coarse one (golden section).
Match with_best_scale(Match match, const std::vector<Curve>& curves, const std::vector<Target>& targets,
                      double smallest) {
    const double golden = (std::sqrt(5.0) - 1) / 2;
    double low = std::max(match.scale / amplitude(1, 1), smallest), high = match.scale * amplitude(1, 1);
    for (int turn = 0; turn < 30; ++turn) {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        const double at_a = similarity_above(curves, targets, a, -HUGE_VAL);
        const double at_b = similarity_above(curves, targets, b, -HUGE_VAL);
        const double best = std::max(at_a, at_b);
        if (best > match.similarity) match = {match.index, best, at_a >= at_b ? a : b};
        (at_a >= at_b ? high : low) = at_a >= at_b ? b : a;
    }
    return match;
}

bool need_fractions(const std::vector<Target>& targets) {
    return std::ranges::any_of(targets, is_contact_fraction, &Target::quantity);
}

void check(const StoredCurves& curves, const std::vector<Target>& targets, const ScreenOptions& options) {
    for (const Target& target : targets) {
        validate(target);
        if (options.max_pressure && target.against_pressure() && target.last() > *options.max_pressure * (1 + 1e-9))
            refuse("target ", target.name, ": reaches ", target.last(), " MPa; give pressures up to ",
                   *options.max_pressure, " MPa");
    }
    if (targets.empty()) throw InputError("genome database: has no target to screen for; give one");
    if (curves.index.empty()) throw InputError("genome database: holds no genomes; build it first");
    if (need_fractions(targets) && curves.fraction.size() != curves.pressure.size())
        throw InputError("genome database: the target needs contact fractions; read the curves with them");
}

/// Multiplies a length by `factor`. Sets it to the wanted length if the two then differ only by rounding.
void stretch(std::optional<double>& length, double factor, std::optional<double> wanted) {
    if (length && wanted) length = std::abs(*length * factor - *wanted) <= 1e-12 * *wanted ? *wanted : *length * factor;
}

/// Exact factors from a database's responses to another length and modulus (README.md, "The file").
struct DatabaseScale {
    double length;   ///< factor on lengths; heights are kept
    double pressure; ///< factor on pressures, and on stiffness
};

DatabaseScale scale_to(const GenomeStore& store, const Model& wanted) {
    Model stored = store.setup().model;
    const double length = wanted.grid.length / stored.grid.length;
    const DatabaseScale scale{length, wanted.body.effective_modulus / stored.body.effective_modulus / length};
    stored.grid.length = wanted.grid.length;
    stored.body.effective_modulus = wanted.body.effective_modulus;
    std::optional width = stored.grid.width;
    stretch(width, length, wanted.grid.width);
    stored.grid.width = *width;
    stretch(stored.body.datum, length, wanted.body.datum);
    stretch(stored.body.strip_width, length, wanted.body.strip_width);
    const std::string differs = difference(named_values(stored), named_values(wanted));
    if (!differs.empty())
        refuse(store.file().string(), ": a database of another set-up: its ", differs, "; use another");
    return scale;
}

/// A target in the units of the database's model.
Target unscaled(Target target, const DatabaseScale& scale) {
    if (target.against_pressure()) target.x /= scale.pressure;
    if (!is_contact_fraction(target.quantity))
        for (Eigen::VectorXd* values : {&target.y, &target.lower, &target.upper}) *values /= scale.pressure;
    return target;
}

/// A genome stretched to `factor` times its wavelengths, with its heights kept.
Genome drawn_out(Genome genome, double factor) {
    for (Series& series : genome.series) {
        series.lambda *= factor;
        series.A *= std::pow(factor, -series.H); // Eq. 2: G_n ~ A lambda^H
    }
    return genome;
}

/// A match and its genome, stretched and with the match's amplitude.
struct Stored {
    Match match;
    Genome genome;
};

std::vector<Stored> nearest(const GenomeStore& store, const DesignSetup& setup, std::size_t count, int threads) {
    const DatabaseScale scale = scale_to(store, setup.model);
    std::vector<Target> targets;
    for (const Target& target : setup.targets) targets.push_back(unscaled(target, scale));
    ScreenOptions options{setup.max_pressure, count, threads};
    if (options.max_pressure) *options.max_pressure /= scale.pressure;
    std::vector<Stored> all;
    for (const Match& match : screen(store.curves(need_fractions(targets)), store.setup().model, targets, options)) {
        all.push_back({match, drawn_out(store.genome(match.index), scale.length)});
        all.back().genome.scale *= match.scale;
    }
    return all;
}

} // namespace

std::vector<Match> screen(const StoredCurves& curves, const Model& model, const std::vector<Target>& targets,
                          const ScreenOptions& options) {
    check(curves, targets, options);
    const bool rescaled = options.max_pressure.has_value();
    const auto displacements = load_displacements(1, model.loading, model.body.kernel); // for a height range of 1
    const auto steps = static_cast<Index>(displacements.size());
    const double full_stiffness = full_contact_stiffness(sample(Genome{}, model.grid), model.body);
    // A genome's curve for each target, at scale 1.
    const auto read = [&](std::size_t g) {
        const auto row = [&](const std::vector<double>& numbers) {
            return Eigen::VectorXd::Map(&numbers[g * displacements.size()], steps);
        };
        Response response;
        response.displacement = curves.range[g] * Eigen::VectorXd::Map(displacements.data(), steps);
        response.pressure = row(curves.pressure);
        if (!curves.fraction.empty()) response.contact_fraction = row(curves.fraction);
        response.full_stiffness = full_stiffness;
        std::vector<Curve> stored;
        for (const Target& target : targets) stored.push_back(curve_of(target.quantity, response));
        return stored;
    };
    // The scale from which on a genome's curves cover the targets.
    const auto covering = [&](const std::vector<Curve>& stored) {
        double scale = 0;
        for (std::size_t t = 0; t < targets.size(); ++t) scale = std::max(scale, targets[t].last() / stored[t].to);
        return scale;
    };
    // On a finer grid the genome's curve ends elsewhere: with this margin it still covers the targets.
    const auto smallest = [&](std::size_t g, const std::vector<Curve>& stored) {
        return rescaled ? *options.max_pressure / curves.pressure[(g + 1) * displacements.size() - 1]
                        : 1.02 * covering(stored);
    };

    const int threads = ga::thread_count(options.threads);
    const std::size_t parts = static_cast<std::size_t>(threads);
    // A coarse amplitude can hide a good genome. Therefore many more genomes are narrowed than returned.
    const std::size_t candidates = rescaled ? std::max<std::size_t>(options.best, 1) : 200 + 20 * options.best;
    std::vector<WorstFirst> best(parts, WorstFirst(better));
    ga::parallel_for(parts, threads, [&](std::size_t part) {
        WorstFirst& kept = best[part];
        for (std::size_t g = part * curves.index.size() / parts; g < (part + 1) * curves.index.size() / parts; ++g) {
            if (std::isnan(curves.range[g])) continue;
            const std::vector<Curve> stored = read(g);
            const double first = smallest(g, stored);
            if (first < (1 - 1e-9) * covering(stored)) continue;
            Match match{g, -HUGE_VAL, 1};
            for (int a = 0; a < (rescaled ? 1 : amplitudes); ++a) {
                const double scale = amplitude(first, a);
                const double worst = kept.size() < candidates ? -HUGE_VAL : kept.top().similarity;
                const double bar = std::max(worst, match.similarity);
                const double similarity = similarity_above(stored, targets, scale, bar);
                if (similarity > match.similarity) match = {g, similarity, scale};
            }
            kept.push(match);
            if (kept.size() > candidates) kept.pop();
        }
    });
    std::vector<Match> matches;
    for (WorstFirst& kept : best)
        for (; !kept.empty(); kept.pop()) matches.push_back(kept.top());
    std::sort(matches.begin(), matches.end(), better);
    matches.resize(std::min(matches.size(), candidates));
    for (Match& match : matches) {
        const auto g = static_cast<std::size_t>(match.index);
        if (!rescaled) {
            const std::vector<Curve> stored = read(g);
            match = with_best_scale(match, stored, targets, smallest(g, stored));
        }
        match.index = curves.index[g];
    }
    std::sort(matches.begin(), matches.end(), better);
    matches.resize(std::min(matches.size(), options.best));
    return matches;
}

std::vector<Genome> stored_starts(const GenomeStore& store, const DesignSetup& setup, std::size_t count, int threads) {
    std::vector<Genome> genomes;
    for (Stored& stored : nearest(store, setup, count, threads)) genomes.push_back(folded(std::move(stored.genome)));
    return genomes;
}

std::vector<StoredAnswer> stored_answers(const GenomeStore& store, const DesignSetup& setup, std::size_t count,
                                         int threads) {
    const std::size_t min_verified = setup.model.grid.is_2d() ? 1 : 16; // a map's verification takes seconds
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
        if (one) answers.push_back(std::move(*one));
    std::ranges::stable_sort(answers, std::ranges::greater{},
                             [](const StoredAnswer& one) { return one.answer.lowest(); });
    answers.resize(std::min(answers.size(), count));
    return answers;
}

} // namespace rough
