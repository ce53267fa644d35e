#include "domain/problem/problem.hpp"

#include "domain/errors.hpp"
#include "domain/problem/drawn_start.hpp"
#include "domain/problem/prices.hpp"

#include <numbers>

namespace rough {
namespace {

/// Refinement aims this far inside the limits on shape, so that it need not end on their edge.
constexpr double limit_guard = 2e-3;
constexpr double limit_weight = 30; ///< a limit's excess in units of misfit

/// The work's result. Throws Stopped if the set-up's stop ended it, which is not the genome's fault.
template <class Work>
auto unless_stopped(const ContactOptions& contact, Work work) {
    try {
        return work();
    } catch (const NotConverged&) {
        if (is_stopped(contact)) throw ga::Stopped{"stop requested"};
        throw;
    }
}

/// All residuals r as r |r/unit|^(power - 1). The sum of their squares depends mostly on the largest ones,
/// as the similarity that 95 % of the draws keep does.
ga::Sensitivity in_power(const ga::Sensitivity& rows) {
    constexpr double power = 2.5, unit = 0.05;
    const Eigen::VectorXd factor = (rows.residuals / unit).cwiseAbs().array().pow(power - 1);
    return {rows.residuals.cwiseProduct(factor), power * factor.asDiagonal() * rows.jacobian};
}

std::string target_objective(std::size_t target) { return "goal" + std::to_string(target + 1); }

/// The points of a target that an objective uses.
std::vector<Index> points_of(const DesignSetup& setup, const std::string& objective, std::size_t target) {
    if (objective == "low" || objective == "high")
        return target == 0 ? points_of_half(setup, objective == "high") : std::vector<Index>();
    const bool other_target = objective.starts_with("goal") && objective != target_objective(target);
    std::vector<Index> points(other_target ? 0 : static_cast<std::size_t>(setup.targets[target].points()));
    std::iota(points.begin(), points.end(), Index{0});
    return points;
}

/// A number of a profile and its derivatives with respect to the heights.
struct Feature {
    double value;
    Eigen::RowVectorXd by_height;
};

/// log10 of the root mean square height, lengths in `length`.
Feature height(const Profile& profile, double length) {
    const Eigen::RowVectorXd z = profile.heights.transpose().array() - profile.heights.mean();
    return {std::log10(std::sqrt(z.squaredNorm() / static_cast<double>(z.size())) / length),
            z / (z.squaredNorm() * std::numbers::ln10)};
}

/// log10 of the root mean square slope, on a map of the gradient.
Feature slope(const Profile& surface, double) {
    const auto [columns, rows] = surface.shape();
    const auto z = surface.heights.reshaped(columns, rows);
    double square = 0;
    Eigen::MatrixXd by = Eigen::MatrixXd::Zero(columns, rows);
    const auto add = [&](const auto& after, const auto& before, auto by_after, auto by_before, double spacing) {
        const Eigen::MatrixXd slopes = (after - before) / spacing;
        const double share = 1 / static_cast<double>(slopes.size());
        square += share * slopes.squaredNorm();
        by_after += share / spacing * slopes;
        by_before -= share / spacing * slopes;
    };
    add(z.bottomRows(columns - 1), z.topRows(columns - 1), by.bottomRows(columns - 1), by.topRows(columns - 1),
        surface.spacing);
    if (surface.is_2d())
        add(z.rightCols(rows - 1), z.leftCols(rows - 1), by.rightCols(rows - 1), by.leftCols(rows - 1),
            surface.row_spacing);
    return {0.5 * std::log10(square), by.reshaped().transpose() / (square * std::numbers::ln10)};
}

Feature wavelength(const Profile& profile, double length) {
    const Feature of_height = height(profile, length), of_slope = slope(profile, length);
    return {std::log10(2 * std::numbers::pi) + of_height.value - of_slope.value,
            of_height.by_height - of_slope.by_height};
}

Feature skewness(const Profile& profile, double) {
    const Eigen::RowVectorXd z = profile.heights.transpose().array() - profile.heights.mean();
    const auto n = static_cast<double>(z.size());
    const double variance = z.squaredNorm() / n, third = z.array().cube().sum() / n;
    const double scale = std::pow(variance, 1.5);
    return {third / scale, 3 / (n * scale) * ((z.array().square() - variance).matrix() - third / variance * z)};
}

ga::Descriptor<Genome> descriptor(const std::string& name, Feature (*feature)(const Profile&, double), double lower,
                                  double upper, const Grid& grid) {
    return {name, [=](const Genome& genome) { return feature(sample(genome, grid), grid.length).value; }, lower, upper,
            [=](const Genome& genome) {
                const Eigen::RowVectorXd by_gene =
                    pulled_back(feature(sample(genome, grid), grid.length).by_height, genome, grid);
                return std::vector<double>(by_gene.begin(), by_gene.end());
            }};
}

} // namespace

DesignProblem::DesignProblem(DesignSetup setup, std::shared_ptr<ResponseMemory> memory, int threads)
    : DesignProblem(setup, std::make_shared<Verifier>(as_reported(setup), threads), std::move(memory)) {}

DesignProblem DesignProblem::with(DesignSetup setup) const {
    return {std::move(setup), verifier_, std::shared_ptr<ResponseMemory>()};
}

DesignProblem::DesignProblem(DesignSetup setup, std::shared_ptr<const Verifier> verifier,
                             std::shared_ptr<ResponseMemory> memory)
    : setup_(std::make_shared<DesignSetup>(std::move(setup))), verifier_(std::move(verifier)),
      memory_(std::move(memory)), descriptors_(surface_descriptors(setup_->model.grid)) {
    validate(*setup_);
    errors_ = std::make_shared<CommonErrors>(*setup_);
    int points = 0;
    for (const Target& target : setup_->targets) points += static_cast<int>(target.points());
    levels_ = level_prices(setup_->model, verifier_->setup().model, points,
                           errors_->noise.size() + errors_->tilts.size(), setup_->smooth_area);
    // A genome over the limits is ranked below every genome within them, by its excess.
    const auto limited = [](double similarity, const Outcome& outcome) {
        return outcome.excess > 0 ? std::min(similarity, 0.0) - 1 - outcome.excess : similarity;
    };
    const auto part = [limited, this](bool high) {
        return [limited, points = points_of_half(*setup_, high)](const Outcome& outcome) {
            const Eigen::VectorXd& misfits = outcome.misfits.front();
            return limited(points.empty() ? 1 : rough::similarity(misfits(points)), outcome);
        };
    };
    const auto lowest = [limited](const Outcome& outcome) { return limited(outcome.similarity, outcome); };
    objectives_ = {{"similarity", lowest},
                   {"verified", lowest, false, level::verified},
                   {"made", lowest, false, level::made},
                   {"low", part(false)},
                   {"high", part(true)}};
    for (std::size_t t = 0; t < setup_->targets.size(); ++t)
        objectives_.push_back({target_objective(t), [=](const Outcome& outcome) {
                                   return limited(rough::similarity(outcome.misfits[t]), outcome);
                               }});
}

DesignOutcome DesignProblem::evaluate(const Genome& genome, ga::Level level) const {
    Outcome outcome;
    if (level == level::verified) {
        Verification found = verifier_->of(genome);
        if (std::isnan(found.worst)) throw ga::Stopped{"stop requested"};
        outcome.scale = eq_11(verifier_->setup(), found.on_grid.front());
        outcome.misfits = std::move(found.misfits[3]);
        outcome.similarity = found.worst;
    } else {
        const DesignResponse response = design_response(*setup_, search_responses(genome));
        outcome = {response.scale, misfits_of(*setup_, response)};
        outcome.similarity = min_similarity(outcome.misfits);
    }
    const Genome final = final_genome(genome, outcome);
    if (level == level::made) outcome.similarity = std::min(outcome.similarity, errors_->similarity({*setup_, final}));
    outcome.excess = excess(final, setup_->model.grid, setup_->limits);
    return outcome;
}

std::vector<Response> DesignProblem::search_responses(const Genome& genome) const {
    auto responses = memory_ ? memory_->find(key(genome)) : std::nullopt;
    if (!responses) {
        responses = unless_stopped(setup_->model.contact, [&] { return responses_of(*setup_, genome, setup_->model); });
        if (memory_) memory_->keep(key(genome), *responses);
    }
    return *responses;
}

bool DesignProblem::valid(const Genome& genome) const {
    try {
        validate(genome, "genome");
        return true;
    } catch (const InputError&) {
        return false;
    }
}

bool DesignProblem::valid_outcome(const Outcome& outcome) const {
    return outcome.scale > 0 && std::isfinite(outcome.scale) &&
           std::ranges::equal(outcome.misfits, setup_->targets, {}, &Eigen::VectorXd::size, &Target::points);
}

std::string DesignProblem::key(const Genome& genome) const { return key_of(*setup_, genome); }

Genome DesignProblem::final_genome(Genome genome, const Outcome& outcome) const {
    if (setup_->max_pressure) genome.scale = outcome.scale;
    return genome;
}

Genome DesignProblem::sample(ga::Stream& random, ga::Work& work) const {
    work.price += levels_[0].evaluation * fitting_price(*setup_);
    return unless_stopped(setup_->model.contact,
                          [&] { return with_fitting_amplitude(*setup_, drawn_start(*setup_, ga::Stream(random()))); });
}

double DesignProblem::distance(const Genome& a, const Genome& b) const {
    const Grid& grid = setup_->model.grid;
    return difference(rough::sample(a, grid), rough::sample(b, grid));
}

std::vector<ga::Variable> DesignProblem::bounds(const Genome& genome) const {
    if (setup_->phases) return phase_variables(genome, *setup_->phases);
    const GeneBounds& within = setup_->bounds;
    const auto places = gene_places(genome);
    const auto values = genes(genome);
    std::vector<ga::Variable> variables;
    for (std::size_t g = 0; g < places.size(); ++g) {
        const Series& series = genome.series[places[g].series];
        const int last = std::ranges::max(series.chromosomes, {}, &Chromosome::n).n;
        const double slack = setup_->limits.shortest_wave > 0
                                 ? std::max(0.0, std::log(wave_length(series, last) / setup_->limits.shortest_wave))
                                 : 10;
        double from = 0, to = 0;
        const GenePlace::Kind kind = places[g].kind;
        switch (kind) {
        case GenePlace::Kind::A:
            std::tie(from, to) = std::minmax({0.1 * values[g], 10 * values[g]});
            break;
        case GenePlace::Kind::H:
            from = within.H_from, to = within.H_to;
            break;
        case GenePlace::Kind::gamma:
            from = within.gamma_from;
            to = last > 1 ? std::min(within.gamma_to, values[g] * std::exp(0.5 * slack / (last - 1))) : within.gamma_to;
            break;
        case GenePlace::Kind::lambda:
            from = std::max(within.lambda_from, values[g] * std::exp(-0.5 * slack));
            to = within.lambda_to;
            break;
        case GenePlace::Kind::phase:
            from = values[g] - std::numbers::pi;
            to = values[g] + std::numbers::pi;
            break;
        }
        // On a periodic grid every wave stays a harmonic of its length.
        const bool harmonic =
            setup_->model.grid.periodic && (kind == GenePlace::Kind::gamma || kind == GenePlace::Kind::lambda);
        // In a single chromosome, H has the effect of A, and gamma that of lambda.
        const bool redundant =
            series.chromosomes.size() == 1 && (kind == GenePlace::Kind::H || kind == GenePlace::Kind::gamma);
        if (!harmonic && !redundant && from <= values[g] && values[g] <= to) variables.push_back({g, from, to});
    }
    return variables;
}

ga::Sensitivity DesignProblem::sensitivity(const Genome& genome, const std::string& objective) const {
    Genome shape = at_scale_one(genome, *setup_);
    const Rows all =
        objective == "verified" ? verifier_->misfit_rows(shape) : misfit_rows(*setup_, shape, setup_->model);
    std::vector<Index> chosen;
    Index first = 0;
    for (std::size_t t = 0; t < setup_->targets.size(); first += setup_->targets[t++].points())
        for (const Index k : points_of(*setup_, objective, t)) chosen.push_back(first + k);
    ga::Sensitivity rows{Eigen::VectorXd(all.misfits.residuals(chosen)),
                         Eigen::MatrixXd(all.misfits.jacobian(chosen, Eigen::all))};
    if (setup_->max_pressure) shape.scale = all.factor;
    if (objective == "made") {
        const SurfaceWithErrors made(*setup_, shape);
        std::vector<ga::Sensitivity> parts{in_power(rows)};
        for (const auto* errors : {&errors_->noise, &errors_->tilts})
            for (const Eigen::VectorXd& heights : *errors) parts.push_back(in_power(made.misfits(heights, all)));
        rows = stacked(parts);
    }
    if (setup_->limits.any_shape()) {
        const ga::Sensitivity limits = limit_rows(shape, setup_->model.grid, setup_->limits, limit_guard, all.d_factor);
        rows = stacked({rows, {limit_weight * limits.residuals, limit_weight * limits.jacobian}});
    }
    return rows;
}

std::vector<ga::Descriptor<Genome>> surface_descriptors(const Grid& grid) {
    return {descriptor("height", height, -5, -1, grid), descriptor("slope", slope, -4, 0, grid),
            descriptor("wavelength", wavelength, -2, 0.5, grid), descriptor("skewness", skewness, -2, 2, grid)};
}

} // namespace rough
