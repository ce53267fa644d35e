#include "domain/database/screen.hpp"

#include "domain/errors.hpp"
#include "domain/response/curve.hpp"
#include "domain/response/similarity.hpp"
#include "ga/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace rough {
namespace {

bool better(const Match& left, const Match& right) {
    return left.similarity != right.similarity ? left.similarity > right.similarity
                                               : left.index < right.index;
}

/// The best matches of some genomes, kept as a heap whose front is the worst.
class Best {
  public:
    explicit Best(std::size_t most) : most_(most) {}
    double bar() const { return kept_.size() < most_ ? -HUGE_VAL : kept_.front().similarity; }
    void offer(const Match& match) {
        if (kept_.size() == most_ && !better(match, kept_.front()))
            return;
        if (kept_.size() == most_) {
            std::pop_heap(kept_.begin(), kept_.end(), better);
            kept_.pop_back();
        }
        kept_.push_back(match);
        std::push_heap(kept_.begin(), kept_.end(), better);
    }
    const std::vector<Match>& kept() const { return kept_; }

  private:
    std::size_t most_;
    std::vector<Match> kept_;
};

/// Secants of a stored response, as secant_stiffness gives them.
struct Secants {
    std::vector<double> pressure, stiffness;
};

void take_secants(Secants& secants, const double* pressure, double displacement_step) {
    double last = 0;
    for (std::size_t j = 0; j < secants.pressure.size(); ++j) {
        secants.pressure[j] = 0.5 * (pressure[j] + last);
        secants.stiffness[j] = (pressure[j] - last) / displacement_step;
        last = pressure[j];
    }
}

/// Eq. 12 with the secants' pressures times `factor`; stops below `bar`, where the exact value does not
/// matter.
double similarity_above(const Secants& secants, const Target& target, double factor, double bar) {
    double worst = 0;
    std::size_t left = 0;
    const std::size_t last = secants.pressure.size() - 2;
    for (Index k = 0; k < target.points() && 1 - worst >= bar; ++k) {
        const double at = target.pressure[k] / factor;
        while (left < last && at >= secants.pressure[left + 1])
            ++left;
        const double share =
            (at - secants.pressure[left]) / (secants.pressure[left + 1] - secants.pressure[left]);
        const double K = (1 - share) * secants.stiffness[left] + share * secants.stiffness[left + 1];
        worst = std::max(worst, std::abs(K / target.stiffness[k] - 1));
    }
    return 1 - worst;
}

constexpr int amplitudes = 33;
double amplitude(double smallest, double step) { return smallest * std::exp2(step / 8); }

/// Narrows a free amplitude between the neighbours of the best of the coarse ones (golden section).
Match settled(Match match, const Secants& secants, const Target& target, double smallest) {
    const double golden = (std::sqrt(5.0) - 1) / 2;
    double low = std::max(match.scale / amplitude(1, 1), smallest), high = match.scale * amplitude(1, 1);
    for (int turn = 0; turn < 30; ++turn) {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        const double at_a = similarity_above(secants, target, a, -HUGE_VAL);
        const double at_b = similarity_above(secants, target, b, -HUGE_VAL);
        const double best = std::max(at_a, at_b);
        if (best > match.similarity)
            match = {match.index, best, at_a >= at_b ? a : b};
        (at_a >= at_b ? high : low) = at_a >= at_b ? b : a;
    }
    return match;
}

} // namespace

std::vector<Match> screen(const StoredCurves& curves, const Model& model, const Target& target,
                          const ScreenOptions& options) {
    validate(target);
    const double highest = target.highest_pressure();
    const bool rescaled = options.max_pressure > 0;
    if (rescaled && highest > options.max_pressure * (1 + 1e-9))
        throw InputError("target " + target.name + ": reaches " + std::to_string(highest) +
                         " MPa, expected at most the pressure that genomes are rescaled to, " +
                         std::to_string(options.max_pressure) + " MPa");
    if (curves.index.empty())
        throw InputError("genome database: nothing is stored in it, expected genomes to screen");

    const auto steps = static_cast<std::size_t>(model.loading.steps);
    const double step_of_range = load_displacements(1, model.loading, model.body.kernel).front();
    const int threads = ga::thread_count(options.threads);
    const std::size_t parts = static_cast<std::size_t>(threads);
    const auto secants_of = [&](std::size_t g, Secants& secants) {
        take_secants(secants, &curves.pressure[g * steps], step_of_range * curves.range[g]);
    };
    // The margin lets the same genome on a finer grid, whose last pressure differs, cover the target too.
    const double covered = rescaled ? options.max_pressure : 1.02 * highest;
    const auto smallest = [&](std::size_t g) { return covered / curves.pressure[(g + 1) * steps - 1]; };
    // A coarse amplitude can hide a good genome: many more are narrowed than returned.
    const std::size_t candidates =
        rescaled ? std::max<std::size_t>(options.best, 1) : 200 + 20 * options.best;
    std::vector<Best> best(parts, Best(candidates));
    ga::parallel_for(parts, threads, [&](std::size_t part) {
        Secants secants{std::vector<double>(steps), std::vector<double>(steps)};
        for (std::size_t g = part * curves.index.size() / parts; g < (part + 1) * curves.index.size() / parts;
             ++g) {
            if (std::isnan(curves.range[g]))
                continue;
            secants_of(g, secants);
            Match match{g, -HUGE_VAL, 1};
            for (int a = 0; a < (rescaled ? 1 : amplitudes); ++a) {
                const double scale = amplitude(smallest(g), a);
                const double bar = std::max(best[part].bar(), match.similarity);
                const double similarity = similarity_above(secants, target, scale, bar);
                if (similarity > match.similarity)
                    match = {g, similarity, scale};
            }
            best[part].offer(match);
        }
    });
    std::vector<Match> matches;
    for (const Best& some : best)
        matches.insert(matches.end(), some.kept().begin(), some.kept().end());
    std::sort(matches.begin(), matches.end(), better);
    matches.resize(std::min(matches.size(), candidates));
    Secants secants{std::vector<double>(steps), std::vector<double>(steps)};
    for (Match& match : matches) {
        const auto g = static_cast<std::size_t>(match.index);
        secants_of(g, secants);
        if (!rescaled)
            match = settled(match, secants, target, smallest(g));
        match.index = curves.index[g];
    }
    std::sort(matches.begin(), matches.end(), better);
    matches.resize(std::min(matches.size(), options.best));
    return matches;
}

} // namespace rough
