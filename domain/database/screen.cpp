#include "domain/database/screen.hpp"

#include "domain/contact/full_contact.hpp"
#include "domain/errors.hpp"
#include "domain/response/curve.hpp"
#include "domain/target/similarity.hpp"
#include "ga/base/parallel.hpp"

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

/// Points of a curve at scale 1, as curve_of gives them; a genome's scale stretches x, and the load's y.
struct Points {
    std::vector<double> x, y;
    bool stretches_y = false;
};

/// One genome's stored curves, in the targets' order.
using Curves = std::vector<Points>;

void take_secants(Points& points, const double* pressure, std::size_t steps, double displacement_step) {
    points.x.resize(steps);
    points.y.resize(steps);
    double last = 0;
    for (std::size_t j = 0; j < steps; ++j) {
        points.x[j] = 0.5 * (pressure[j] + last);
        points.y[j] = (pressure[j] - last) / displacement_step;
        last = pressure[j];
    }
}

void take_from_origin(Points& points, const double* x, double x_factor, const double* y, std::size_t steps) {
    points.x.assign(1, 0);
    points.y.assign(1, 0);
    for (std::size_t j = 0; j < steps; ++j) {
        points.x.push_back(x_factor * x[j]);
        points.y.push_back(y[j]);
    }
}

/// Reads the stored numbers of a genome as the targets ask.
class Reader {
  public:
    Reader(const StoredCurves& curves, const Model& model, const std::vector<Target>& targets)
        : curves_(curves), targets_(targets), steps_(static_cast<std::size_t>(model.loading.steps)),
          of_range_(load_displacements(1, model.loading, model.body.kernel)),
          full_stiffness_(full_contact_stiffness(model.grid.nodes, model.grid.spacing(), model.body)) {}

    void read(std::size_t g, Curves& into) const {
        const double* pressure = &curves_.pressure[g * steps_];
        const double* fraction = curves_.fraction.empty() ? nullptr : &curves_.fraction[g * steps_];
        const double range = curves_.range[g];
        into.resize(targets_.size());
        for (std::size_t i = 0; i < targets_.size(); ++i)
            switch (targets_[i].quantity) {
            case Quantity::stiffness:
                take_secants(into[i], pressure, steps_, of_range_.front() * range);
                break;
            case Quantity::area_at_pressure:
                take_from_origin(into[i], pressure, 1, fraction, steps_);
                break;
            case Quantity::area_at_displacement:
                take_from_origin(into[i], of_range_.data(), range, fraction, steps_);
                break;
            case Quantity::load_at_displacement:
                take_from_origin(into[i], of_range_.data(), range, pressure, steps_);
                into[i].stretches_y = true;
                break;
            case Quantity::interface_stiffness:
                take_secants(into[i], pressure, steps_, of_range_.front() * range);
                for (double& K : into[i].y)
                    K = interface_of(K, full_stiffness_);
                break;
            }
    }
    /// Where a genome's curve ends for a target, at scale 1.
    double end(std::size_t g, const Target& target) const {
        return target.against_pressure() ? curves_.pressure[(g + 1) * steps_ - 1]
                                         : of_range_.back() * curves_.range[g];
    }

  private:
    const StoredCurves& curves_;
    const std::vector<Target>& targets_;
    std::size_t steps_;
    std::vector<double> of_range_; ///< displacements of the load steps over the height range
    double full_stiffness_;        ///< of the model's full contact, MPa/mm
};

/// The similarity at a scale; stops below `bar`, where the exact value does not matter.
double similarity_above(const Curves& curves, const std::vector<Target>& targets, double scale, double bar) {
    double worst = 0;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const Target& target = targets[i];
        const Points& points = curves[i];
        std::size_t left = 0;
        const std::size_t last = points.x.size() - 2;
        for (Index k = 0; k < target.points() && 1 - worst >= bar; ++k) {
            const double at = target.x[k] / scale;
            while (left < last && at >= points.x[left + 1])
                ++left;
            const double share = (at - points.x[left]) / (points.x[left + 1] - points.x[left]);
            const double y = ((1 - share) * points.y[left] + share * points.y[left + 1]) *
                             (points.stretches_y ? scale : 1);
            worst = std::max(worst, std::abs(misfit(target, k, y)));
        }
    }
    return 1 - worst;
}

constexpr int amplitudes = 33;
double amplitude(double smallest, double step) { return smallest * std::exp2(step / 8); }

/// Narrows a free amplitude between the neighbours of the best of the coarse ones (golden section).
Match settled(Match match, const Curves& curves, const std::vector<Target>& targets, double smallest) {
    const double golden = (std::sqrt(5.0) - 1) / 2;
    double low = std::max(match.scale / amplitude(1, 1), smallest), high = match.scale * amplitude(1, 1);
    for (int turn = 0; turn < 30; ++turn) {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        const double at_a = similarity_above(curves, targets, a, -HUGE_VAL);
        const double at_b = similarity_above(curves, targets, b, -HUGE_VAL);
        const double best = std::max(at_a, at_b);
        if (best > match.similarity)
            match = {match.index, best, at_a >= at_b ? a : b};
        (at_a >= at_b ? high : low) = at_a >= at_b ? b : a;
    }
    return match;
}

void check(const StoredCurves& curves, const std::vector<Target>& targets, const ScreenOptions& options) {
    for (const Target& target : targets) {
        validate(target);
        if (options.max_pressure > 0 && target.against_pressure() &&
            target.last() > options.max_pressure * (1 + 1e-9))
            refuse("target ", target.name, ": reaches ", target.last(),
                   " MPa, expected at most the pressure that genomes are rescaled to, ", options.max_pressure,
                   " MPa");
    }
    if (targets.empty())
        throw InputError("genome database: no target given, expected one to screen for");
    if (curves.index.empty())
        throw InputError("genome database: nothing is stored in it, expected genomes to screen");
    if (need_fractions(targets) && curves.fraction.size() != curves.pressure.size())
        throw InputError("genome database: contact fractions were not read, but the target needs them");
}

} // namespace

bool need_fractions(const std::vector<Target>& targets) {
    return std::any_of(targets.begin(), targets.end(),
                       [](const Target& target) { return is_contact_fraction(target.quantity); });
}

std::vector<Match> screen(const StoredCurves& curves, const Model& model, const std::vector<Target>& targets,
                          const ScreenOptions& options) {
    check(curves, targets, options);
    const bool rescaled = options.max_pressure > 0;
    const Reader reader(curves, model, targets);
    const auto steps = static_cast<std::size_t>(model.loading.steps);
    const auto covering = [&](std::size_t g) {
        double scale = 0;
        for (const Target& target : targets)
            scale = std::max(scale, target.last() / reader.end(g, target));
        return scale;
    };
    // The margin lets the same genome on a finer grid, whose curve ends elsewhere, cover the targets too.
    const auto smallest = [&](std::size_t g) {
        return rescaled ? options.max_pressure / curves.pressure[(g + 1) * steps - 1] : 1.02 * covering(g);
    };

    const int threads = ga::thread_count(options.threads);
    const std::size_t parts = static_cast<std::size_t>(threads);
    // A coarse amplitude can hide a good genome: many more are narrowed than returned.
    const std::size_t candidates =
        rescaled ? std::max<std::size_t>(options.best, 1) : 200 + 20 * options.best;
    std::vector<Best> best(parts, Best(candidates));
    ga::parallel_for(parts, threads, [&](std::size_t part) {
        Curves stored;
        for (std::size_t g = part * curves.index.size() / parts; g < (part + 1) * curves.index.size() / parts;
             ++g) {
            if (std::isnan(curves.range[g]) || smallest(g) < (1 - 1e-9) * covering(g))
                continue;
            reader.read(g, stored);
            Match match{g, -HUGE_VAL, 1};
            for (int a = 0; a < (rescaled ? 1 : amplitudes); ++a) {
                const double scale = amplitude(smallest(g), a);
                const double bar = std::max(best[part].bar(), match.similarity);
                const double similarity = similarity_above(stored, targets, scale, bar);
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
    Curves stored;
    for (Match& match : matches) {
        const auto g = static_cast<std::size_t>(match.index);
        if (!rescaled) {
            reader.read(g, stored);
            match = settled(match, stored, targets, smallest(g));
        }
        match.index = curves.index[g];
    }
    std::sort(matches.begin(), matches.end(), better);
    matches.resize(std::min(matches.size(), options.best));
    return matches;
}

} // namespace rough
