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
    if (quantity == Quantity::load_at_displacement)
        return load / nominal;
    if (is_contact_fraction(quantity))
        return area / nominal;
    if (quantity == Quantity::stiffness)
        return stiffness / nominal;
    Grid grid{.periodic = true}; // its area is the nominal area
    grid.nodes = std::min<Index>(128, 16 * setup.array.columns);
    grid.length = setup.array.pitch * static_cast<double>(setup.array.columns);
    grid.rows = std::min<Index>(128, 16 * setup.array.rows);
    grid.width = setup.array.pitch * static_cast<double>(setup.array.rows);
    const double full = full_contact_stiffness(
        {Eigen::VectorXd::Zero(grid.shape().nodes()), grid.spacing(), grid.rows, grid.row_spacing()},
        {.kernel = Kernel::free, .effective_modulus = setup.effective_modulus});
    return interface_of(stiffness / nominal, full);
}

Caps caps_of(const CapSetup& setup, const CapGenome& genome) {
    const Index n = setup.array.caps();
    const Eigen::Map<const Eigen::VectorXd> genes(genome.data(), static_cast<Index>(genome.size()));
    return {setup.array, genes.head(n),
            setup.radii.is_free() ? Eigen::VectorXd(genes.tail(n))
                                  : Eigen::VectorXd::Constant(n, setup.radii.from)};
}

CapCurve curve_of(const CapSetup& setup, const Target& target, const CapGenome& genome, CapModel model,
                  bool with_derivatives) {
    const Caps caps = caps_of(setup, genome);
    const CapContact contact(setup.array, setup.effective_modulus, model);
    const double nominal = setup.array.nominal_area();
    const Index n = setup.array.caps();
    CapCurve curve{Eigen::VectorXd(target.points()), {}, {}};
    if (with_derivatives)
        curve.by_genes.resize(target.points(), static_cast<Index>(genome.size()));
    Index highest = 0;
    const double top = caps.heights.maxCoeff(&highest);
    std::optional<PressedCaps> before;
    for (Index k = 0; k < target.points(); ++k) {
        const PressedCaps* start = before ? &*before : nullptr;
        PressedCaps pressed = target.against_pressure() ? contact.at_load(caps, target.x[k] * nominal, start)
                                                        : contact.at_plane(caps, top - target.x[k], start);
        curve.values[k] =
            value_of(setup, target.quantity, pressed.load(), pressed.total_area(), pressed.stiffness);
        curve.loads.push_back(pressed.load());
        if (with_derivatives) {
            const CapSlopes slopes = contact.slopes(caps, pressed);
            const CapSlope& of = target.quantity == Quantity::load_at_displacement ? slopes.load
                                 : is_contact_fraction(target.quantity)            ? slopes.area
                                                                                   : slopes.stiffness;
            // The plane moves so that the load stays, or with the highest summit.
            const double per_load = target.against_pressure() ? -of.by_plane() / slopes.load.by_plane() : 0;
            Eigen::VectorXd by_heights = of.by_heights + per_load * slopes.load.by_heights;
            if (!target.against_pressure())
                by_heights[highest] += of.by_plane();
            const double scale = target.quantity == Quantity::interface_stiffness
                                     ? std::pow(curve.values[k] * nominal / pressed.stiffness, 2) / nominal
                                     : 1 / nominal;
            curve.by_genes.row(k).head(n) = scale * by_heights;
            if (setup.radii.is_free())
                curve.by_genes.row(k).tail(n) = scale * (of.by_radii + per_load * slopes.load.by_radii);
        }
        before = std::move(pressed);
    }
    return curve;
}

CapSetup with_independent_caps(CapSetup setup, const CapGenome* like) {
    if (!only_areas(setup))
        return setup;
    for (Target& target : setup.targets)
        if (like) {
            const Eigen::ArrayXd factor =
                curve_of(setup, target, *like, CapModel::independent).values.array() /
                curve_of(setup, target, *like, setup.model).values.array();
            for (Eigen::VectorXd* values : {&target.y, &target.lower, &target.upper})
                if (values->size() > 0)
                    values->array() *= factor;
        }
    setup.model = CapModel::independent;
    return setup;
}

double CapOutcome::similarity() const { return least_similarity(misfits); }

CapProblem::CapProblem(CapSetup setup) : setup_(std::move(setup)) {
    validate(setup_);
    objectives_ = {{"similarity", [](const Outcome& outcome) { return outcome.similarity(); }}};
    for (std::size_t t = 0; t < setup_.targets.size(); ++t)
        objectives_.push_back({"goal" + std::to_string(t + 1), [t](const Outcome& outcome) {
                                   return rough::similarity(outcome.misfits[t]);
                               }});
    const auto caps = static_cast<std::size_t>(setup_.array.caps());
    for (std::size_t g = 0; g < (setup_.radii.is_free() ? 2 : 1) * caps; ++g)
        bounds_.push_back({g, range(g).from, range(g).to});
}

const GeneRange& CapProblem::range(std::size_t gene) const {
    return gene < static_cast<std::size_t>(setup_.array.caps()) ? setup_.heights : setup_.radii;
}

CapOutcome CapProblem::evaluate(const Genome& genome) const {
    Outcome outcome;
    for (const Target& target : setup_.targets)
        outcome.misfits.push_back(misfit(target, curve_of(setup_, target, genome, setup_.model).values));
    return outcome;
}

ga::Sensitivity CapProblem::sensitivity(const Genome& genome, const std::string& objective) const {
    ga::Sensitivity all;
    for (std::size_t t = 0; t < setup_.targets.size(); ++t) {
        if (objective != "similarity" && objective != objectives_[t + 1].name)
            continue;
        const Target& target = setup_.targets[t];
        const CapCurve curve = curve_of(setup_, target, genome, setup_.model, true);
        ga::Sensitivity rows{misfit(target, curve.values), curve.by_genes};
        for (Index k = 0; k < target.points(); ++k)
            rows.jacobian.row(k) *=
                target.has_band() && rows.residuals[k] == 0 ? 0 : target.weight / target.y[k];
        all = all.residuals.size() == 0 ? rows : stacked(all, rows);
    }
    return all;
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
    for (std::size_t g = 0; g < genome.size(); ++g) {
        if (!random.chance(rate))
            continue;
        const GeneRange& of = range(g);
        double step = 0.1 * (of.to - of.from) * random.normal();
        if (of.step > 0 && std::abs(step) < of.step)
            step = std::copysign(of.step, step);
        const double to = of.nearest(genome[g] + step);
        changed |= to != genome[g];
        genome[g] = to;
    }
    return changed;
}

void validate(const CapSetup& setup) {
    const auto expect_range = [](const std::string& name, const GeneRange& range, double lowest) {
        if (!(range.from >= lowest) || !(range.to >= range.from) || !std::isfinite(range.to))
            refuse_value(name, range.from, ":", range.to, " is not a range; give FROM:TO with ", lowest,
                         " <= FROM <= TO");
        if (!(range.step >= 0) || range.step > std::max(range.to - range.from, 1e-300))
            refuse_value(name, range.step, " is not a step of the range; give one up to ",
                         range.to - range.from);
    };
    const CapArray& array = setup.array;
    if (array.columns < 1 || array.rows < 1 || array.caps() > 4096)
        refuse_value("asperities", array.columns, "x", array.rows, " is out of range; give 1 to 4096 caps");
    if (!(array.pitch > 0))
        refuse_value("pitch", array.pitch, " mm is not above 0; give a distance");
    expect_range("heights", setup.heights, -1e6);
    expect_range("radii", setup.radii, 1e-9);
    if (setup.targets.empty())
        throw InputError("target: none given; give at least one");
    for (const Target& target : setup.targets)
        validate(target);
}

AreaLimits area_limits(const CapSetup& setup, double force) {
    const double modulus = setup.effective_modulus, caps = static_cast<double>(setup.array.caps());
    AreaLimits limits{hertz_area(force, setup.radii.from, modulus),
                      caps * hertz_area(force / caps, setup.radii.to, modulus)};
    if (setup.model != CapModel::independent)
        return limits;
    // For an approach D, cap i has an indentation between max(0, D - range) and D, so a force between f_lo
    // and f_hi. Its area is a concave function of its force, so it is no smaller than the chord between both.
    const double range = setup.heights.to - setup.heights.from, factor = 4.0 / 3 * modulus;
    const auto force_at = [&](double radius, double depth) {
        return depth > 0 ? factor * std::sqrt(radius) * std::pow(depth, 1.5) : 0;
    };
    const double deepest = std::pow(force / force_at(setup.radii.from, 1), 2.0 / 3);
    double least = limits.max;
    constexpr int tried = 4000;
    for (int i = 1; i <= tried; ++i) {
        const double approach = deepest * i / tried;
        const double low = force_at(setup.radii.from, approach - range),
                     high = force_at(setup.radii.to, approach);
        if (caps * low > force || caps * high < force)
            continue;
        const double area_low = hertz_area(low, setup.radii.from, modulus),
                     slope = (hertz_area(high, setup.radii.from, modulus) - area_low) / (high - low);
        least = std::min(least, caps * area_low + slope * (force - caps * low));
    }
    limits.min = std::max(limits.min, 0.999 * least); // between the tried approaches it may be lower
    return limits;
}

std::vector<OutOfReach> out_of_reach(const CapSetup& setup) {
    std::vector<OutOfReach> found;
    const double nominal = setup.array.nominal_area();
    for (const Target& target : setup.targets) {
        if (target.quantity != Quantity::area_at_pressure)
            continue;
        OutOfReach worst;
        for (Index k = 0; k < target.points(); ++k) {
            const double force = target.x[k] * nominal, area = target.y[k] * nominal;
            const AreaLimits limits = area_limits(setup, force);
            const double nearest = std::clamp(area, limits.min, limits.max);
            const double bound = 1 - std::abs(misfit(target, k, nearest / nominal));
            if (bound >= worst.bound)
                continue;
            worst = {line_of("area ", area, " mm2 under ", force, " N is ",
                             area < limits.min ? "below the least, " : "above the largest, ", nearest,
                             " mm2, of ", setup.array.caps(), " caps"),
                     {target.x[k]},
                     bound,
                     false};
        }
        if (worst.bound < 1 - 1e-6)
            found.push_back(worst);
    }
    return found;
}

std::vector<HeightTolerance> height_tolerance(const CapSetup& setup, const CapGenome& genome,
                                              std::uint64_t seed, int draws, int threads) {
    const CapProblem problem(with_independent_caps(setup, &genome)); // takes less time
    const auto caps = static_cast<std::size_t>(setup.array.caps());
    const auto lost = static_cast<double>(draws) / 20; // draws that may miss the law
    std::vector<HeightTolerance> all{{0.02}, {0.05}, {0.1}};
    const double range = std::max(setup.heights.to - setup.heights.from, 1e-6);
    double below = 0; // the largest error tried so far with its misfit
    double kept = 1 - problem.evaluate(genome).similarity();
    constexpr int sizes = 24;
    for (int i = 0; i < sizes && kept <= all.back().error; ++i) {
        const double rms = range * std::pow(10.0, -4 + 4.0 * i / (sizes - 1));
        std::vector<double> misfits(static_cast<std::size_t>(draws));
        ga::parallel_for(misfits.size(), ga::thread_count(threads), [&](std::size_t draw) {
            ga::Stream random(ga::fold(ga::fold(seed, "heights"), static_cast<std::uint64_t>(draw)));
            CapGenome made = genome;
            for (std::size_t g = 0; g < caps; ++g)
                made[g] += rms * random.normal();
            misfits[draw] = 1 - problem.evaluate(made).similarity();
        });
        const double now = quantile(misfits, 1 - lost / draws);
        for (HeightTolerance& one : all)
            if (kept <= one.error)
                one.rms = now <= one.error ? rms : below + (rms - below) * (one.error - kept) / (now - kept);
        below = rms;
        kept = std::max(now, kept);
    }
    return all;
}

} // namespace rough
