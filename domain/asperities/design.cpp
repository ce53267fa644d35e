#include "domain/asperities/design.hpp"

#include "domain/errors.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/problem/response.hpp"

namespace rough {

double GeneRange::nearest(double value) const {
    const double inside = std::clamp(value, from, to);
    return step > 0 ? std::min(from + step * std::round((inside - from) / step), to) : inside;
}

double value_of(const CapSetup& setup, Quantity quantity, double load, double area, double stiffness) {
    const double nominal = setup.array.nominal_area();
    if (quantity == Quantity::load_at_displacement) return load / nominal;
    if (is_contact_fraction(quantity)) return area / nominal;
    if (quantity == Quantity::stiffness) return stiffness / nominal;
    const Grid grid = grid_of(setup.array);
    const double full = full_contact_stiffness(
        {Eigen::VectorXd::Zero(grid.shape().nodes()), grid.spacing(), grid.rows, grid.row_spacing()},
        {.kernel = Kernel::free, .effective_modulus = setup.effective_modulus});
    return interface_of(stiffness / nominal, full);
}

Caps caps_of(const CapSetup& setup, const CapGenome& genome) {
    const Index n = setup.array.caps();
    const Eigen::Map<const Eigen::VectorXd> genes(genome.data(), static_cast<Index>(genome.size()));
    return {setup.array, genes.head(n),
            setup.radii.is_free() ? Eigen::VectorXd(genes.tail(n)) : Eigen::VectorXd::Constant(n, setup.radii.from)};
}

CapCurve curve_of(const CapSetup& setup, const Target& target, const CapGenome& genome, CapModel model,
                  bool with_derivatives) {
    const Caps caps = caps_of(setup, genome);
    const CapContact contact(setup.array, setup.effective_modulus, model);
    const double nominal = setup.array.nominal_area();
    const Index n = setup.array.caps();
    const Index points = target.points(), genes = static_cast<Index>(genome.size());
    CapCurve curve{Eigen::VectorXd(points), Eigen::MatrixXd(with_derivatives ? points : 0, genes)};
    Index highest = 0;
    const double top = caps.heights.maxCoeff(&highest);
    std::optional<CapState> before;
    for (Index k = 0; k < points; ++k) {
        const CapState* start = before ? &*before : nullptr;
        CapState state = target.against_pressure() ? contact.at_load(caps, target.x[k] * nominal, start)
                                                   : contact.at_plane(caps, top - target.x[k], start);
        curve.values[k] = value_of(setup, target.quantity, state.load(), state.total_area(), state.stiffness);
        if (with_derivatives) {
            const CapSlopes slopes = contact.slopes(caps, state);
            const CapSlope& of = target.quantity == Quantity::load_at_displacement ? slopes.load
                                 : is_contact_fraction(target.quantity)            ? slopes.area
                                                                                   : slopes.stiffness;
            // The plane moves so that the load stays, or with the highest summit.
            const double per_load = target.against_pressure() ? -of.by_plane() / slopes.load.by_plane() : 0;
            Eigen::VectorXd by_heights = of.by_heights + per_load * slopes.load.by_heights;
            if (!target.against_pressure()) by_heights[highest] += of.by_plane();
            const double scale = target.quantity == Quantity::interface_stiffness
                                     ? std::pow(curve.values[k] * nominal / state.stiffness, 2) / nominal
                                     : 1 / nominal;
            curve.by_genes.row(k).head(n) = scale * by_heights;
            if (setup.radii.is_free())
                curve.by_genes.row(k).tail(n) = scale * (of.by_radii + per_load * slopes.load.by_radii);
        }
        before = std::move(state);
    }
    return curve;
}

Eigen::ArrayXd interaction_factor(const CapSetup& setup, const Target& target, const CapGenome& genome) {
    const Eigen::ArrayXd alone = curve_of(setup, target, genome, CapModel::independent).values;
    return alone / curve_of(setup, target, genome, CapModel::interacting).values.array();
}

CapSetup with_independent_caps(CapSetup setup, const CapGenome* like) {
    if (!only_areas(setup) || setup.model == CapModel::independent) return setup;
    for (Target& target : setup.targets)
        if (like) {
            const Eigen::VectorXd factor = interaction_factor(setup, target, *like);
            for (Eigen::VectorXd* values : {&target.y, &target.lower, &target.upper})
                *values = values->cwiseProduct(factor.head(values->size()));
        }
    setup.model = CapModel::independent;
    return setup;
}

CapProblem::CapProblem(CapSetup setup) : setup_(std::move(setup)) {
    const auto expect_range = [](const std::string& name, const GeneRange& range, double lowest) {
        const double width = range.to - range.from;
        if (!(range.from >= lowest && width >= 0 && std::isfinite(width) && range.step >= 0) ||
            range.step > std::max(width, 1e-300))
            refuse_value(name, range.from, ":", range.to, ":", range.step,
                         " is not a range; give FROM:TO or FROM:TO:STEP with ", lowest,
                         " <= FROM <= TO and STEP <= TO - FROM");
    };
    const CapArray& array = setup_.array;
    if (array.columns < 1 || array.rows < 1 || array.caps() > 4096)
        refuse_value("asperities", array.columns, "x", array.rows, " is out of range; give 1 to 4096 caps");
    if (!(array.pitch > 0)) refuse_value("pitch", array.pitch, " mm is not above 0; give a distance");
    expect_range("heights", setup_.heights, -1e6);
    expect_range("radii", setup_.radii, 1e-9);
    if (setup_.targets.empty()) throw InputError("target: none given; give at least one");
    for (const Target& target : setup_.targets) validate(target);
    objectives_ = {{"similarity", min_similarity}};
    for (std::size_t t = 0; t < setup_.targets.size(); ++t)
        objectives_.push_back(
            {"goal" + std::to_string(t + 1), [t](const Outcome& outcome) { return rough::similarity(outcome[t]); }});
    const auto caps = static_cast<std::size_t>(setup_.array.caps());
    for (std::size_t g = 0; g < (setup_.radii.is_free() ? 2 : 1) * caps; ++g)
        bounds_.push_back({g, range(g).from, range(g).to});
}

const GeneRange& CapProblem::range(std::size_t gene) const {
    return gene < static_cast<std::size_t>(setup_.array.caps()) ? setup_.heights : setup_.radii;
}

CapProblem::Outcome CapProblem::evaluate(const Genome& genome) const {
    Outcome outcome;
    for (const Target& target : setup_.targets)
        outcome.push_back(misfit(target, curve_of(setup_, target, genome, setup_.model).values));
    return outcome;
}

ga::Sensitivity CapProblem::sensitivity(const Genome& genome, const std::string& objective) const {
    std::vector<ga::Sensitivity> parts;
    for (std::size_t t = 0; t < setup_.targets.size(); ++t) {
        if (objective != "similarity" && objective != objectives_[t + 1].name) continue;
        const Target& target = setup_.targets[t];
        const CapCurve curve = curve_of(setup_, target, genome, setup_.model, true);
        ga::Sensitivity rows{misfit(target, curve.values), curve.by_genes};
        for (Index k = 0; k < target.points(); ++k)
            rows.jacobian.row(k) *= target.has_band() && rows.residuals[k] == 0 ? 0 : target.weight / target.y[k];
        parts.push_back(std::move(rows));
    }
    return stacked(parts);
}

CapGenome CapProblem::sample(ga::Stream& random) const {
    const auto caps = static_cast<double>(setup_.array.caps());
    const bool grouped = random.chance(0.5), alike = random.chance(0.5);
    const double share = random.uniform(0.2, 1), power = std::exp(random.uniform(-1.5, 1)),
                 high = std::exp(random.uniform(0, std::log(0.5 * caps + 1))) / caps,
                 step = share * random.uniform(0.1, 0.9), top = std::pow(random.uniform(), 3),
                 bottom = std::pow(random.uniform(), 2);
    Genome genome;
    for (const ga::Variable& variable : bounds_) {
        const GeneRange& of = range(variable.gene);
        double depth = random.uniform(); // share of the range
        if (&of == &setup_.radii && alike)
            depth = 0; // the largest radius
        else if (&of == &setup_.heights && !grouped)
            depth = share * std::pow(depth, power);
        else if (&of == &setup_.heights)
            depth = random.chance(high) ? top * step * depth : step + bottom * (share - step) * depth;
        genome.push_back(of.nearest(of.to - depth * (of.to - of.from)));
    }
    return genome;
}

bool CapProblem::mutate(Genome& genome, double rate, ga::Stream& random) const {
    bool changed = false;
    for (std::size_t g = 0; g < genome.size(); ++g)
        if (random.chance(rate)) {
            const GeneRange& of = range(g);
            const double drawn = 0.1 * (of.to - of.from) * random.normal();
            const double step = std::copysign(std::max(std::abs(drawn), of.step), drawn);
            const double before = std::exchange(genome[g], of.nearest(genome[g] + step));
            changed |= genome[g] != before;
        }
    return changed;
}

std::vector<OutOfReach> out_of_reach(const CapSetup& setup) {
    std::vector<OutOfReach> found;
    const double nominal = setup.array.nominal_area(), modulus = setup.effective_modulus;
    const auto caps = static_cast<double>(setup.array.caps());
    for (const Target& target : setup.targets) {
        if (target.quantity != Quantity::area_at_pressure) continue;
        OutOfReach worst;
        for (Index k = 0; k < target.points(); ++k) {
            const double force = target.x[k] * nominal, area = target.y[k] * nominal;
            const double min = hertz_area(force, setup.radii.from, modulus),
                         max = caps * hertz_area(force / caps, setup.radii.to, modulus),
                         nearest = std::clamp(area, min, max),
                         bound = 1 - std::abs(misfit(target, k, nearest / nominal));
            if (bound < worst.bound)
                worst = {line_with_digits(5, "area ", area, " mm² under ", force, " N is ",
                                          area < min ? "below the least, " : "above the largest, ", nearest,
                                          " mm², of ", setup.array.caps(), " caps"),
                         {target.x[k]},
                         bound,
                         false};
        }
        if (worst.bound < 1 - 1e-6) found.push_back(worst);
    }
    return found;
}

std::vector<HeightTolerance> height_tolerance(const CapSetup& setup, const CapGenome& genome, std::uint64_t seed,
                                              int draws, int threads) {
    const CapProblem problem(with_independent_caps(setup, &genome)); // takes less time
    const auto error_under = [&](double rms) {
        std::vector<double> errors(static_cast<std::size_t>(draws));
        ga::parallel_for(errors.size(), ga::thread_count(threads), [&](std::size_t draw) {
            ga::Stream random(ga::fold(ga::fold(seed, "heights"), static_cast<std::uint64_t>(draw)));
            CapGenome made = genome;
            for (Index cap = 0; cap < setup.array.caps(); ++cap)
                made[static_cast<std::size_t>(cap)] += rms * random.normal();
            errors[draw] = 1 - min_similarity(problem.evaluate(made));
        });
        return quantile(errors, 0.95);
    };
    std::vector<HeightTolerance> all{{0.02}, {0.05}, {0.1}};
    const double range = std::max(setup.heights.to - setup.heights.from, 1e-6);
    double kept = 0; // the largest standard deviation that keeps the limit
    for (HeightTolerance& one : all) {
        double lost = range;
        if (error_under(0) <= one.error)
            while (lost > 1.01 * kept + 1e-5 * range) {
                const double middle = (kept + lost) / 2;
                (error_under(middle) <= one.error ? kept : lost) = middle;
            }
        one.rms = kept;
    }
    return all;
}

} // namespace rough
