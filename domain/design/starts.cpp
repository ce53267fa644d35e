#include "domain/design/starts.hpp"

#include "domain/design/inverse.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/sobol.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/problem/prices.hpp"
#include "domain/problem/response.hpp"
#include "domain/profile/spectrum.hpp"
#include "ga/base/parallel.hpp"

#include <Eigen/Cholesky>

#include <numbers>

namespace rough {
namespace {

/// The order in which nodes touch: by distance from the nearest peak, relative to the peak's width. In half
/// of the cases there is one peak, else up to eight of equal height and similar width.
std::vector<int> drawn_order(const Grid& grid, ga::Stream& random) {
    struct Peak {
        double x, y, width;
    };
    const bool is_map = grid.is_2d();
    const std::size_t count = random.chance(0.5) ? 1 : 2 + random.below(7);
    // A single peak is near the middle, so that its contact does not reach the ends.
    const double margin = count == 1 ? 0.4 : is_map ? 0.1 : 0.25;
    std::vector<Peak> peaks(count);
    for (std::size_t p = 0; p < count; ++p) {
        const double place = random.uniform(margin, 1 - margin);
        peaks[p].x = is_map ? grid.length * place : (static_cast<double>(p) + place) / static_cast<double>(count);
        peaks[p].y = is_map ? grid.width * random.uniform(margin, 1 - margin) : 0;
        peaks[p].width = count == 1 ? 1 : random.uniform(0.7, 1);
    }
    const auto away = [&](double from, double to, double period) {
        const double straight = std::abs(from - to);
        return grid.periodic ? std::min(straight, period - straight) : straight;
    };
    std::vector<double> distance;
    for (Index i = 0; i < grid.shape().nodes(); ++i) { // on a line in units of its length
        const double column = static_cast<double>(i % grid.nodes), row = static_cast<double>(i / grid.nodes),
                     x = is_map ? grid.first_x() + grid.spacing() * column
                                : column / static_cast<double>(grid.nodes - (grid.periodic ? 0 : 1)),
                     y = grid.first_y() + grid.row_spacing() * row;
        double nearest = HUGE_VAL;
        for (const Peak& peak : peaks)
            nearest =
                std::min(nearest, std::hypot(away(x, peak.x, is_map ? grid.length : 1), away(y, peak.y, grid.width)) /
                                      peak.width);
        distance.push_back(nearest);
    }
    const auto order = ascending(distance);
    return {order.begin(), order.end()};
}

/// The order in which nodes touch if contact is on tips at an even pitch, with valleys between them that
/// touch last. A tip's contact hardly widens under load, so noise changes the stiffness less. The first tips
/// to touch are one or two near the middle. The pitch is at least twice `finest` (mm).
std::vector<int> tips_order(const Grid& grid, double finest, ga::Stream& random) {
    const double pitch = finest * random.uniform(2, 6), width = pitch * random.uniform(0.25, 0.6),
                 middle = grid.length * random.uniform(0.4, 0.6), shift = random.chance(0.5) ? 0.5 : 0;
    std::vector<double> rank;
    for (Index i = 0; i < grid.nodes; ++i) {
        const double x = grid.spacing() * static_cast<double>(i) - middle,
                     tip = pitch * (std::round(x / pitch - shift) + shift), off = std::abs(x - tip);
        rank.push_back(std::abs(tip) + 0.05 * off + (off > width / 2 ? grid.length : 0));
    }
    const auto order = ascending(rank);
    return {order.begin(), order.end()};
}

constexpr Index shaping_nodes = 256, shaping_side = 24;
/// Depth of valleys below contact over the last displacement, in free amplitude on a periodic body.
constexpr double valley_depth = 0.5;

/// The series with A = 1 and chromosomes 1 to n_f, whose phases are 0.
Series with_chromosomes(Series law, double shortest, std::size_t phases) {
    law.A = 1;
    law.chromosomes.clear();
    for (int n = 1; n <= last_chromosome(law.lambda, law.gamma, shortest); ++n)
        law.chromosomes.push_back({n, std::vector<double>(phases, 0.0)});
    if (law.chromosomes.empty())
        throw InputError("series: its longest wave is " + std::to_string(law.lambda) +
                         " mm, shorter than allowed; use at least " + std::to_string(shortest) + " mm");
    return law;
}

/// Weights of the waves, fitted with a constant by damped least squares.
Eigen::VectorXd fitted(const Eigen::MatrixXd& waves, const Eigen::VectorXd& heights, double damping) {
    Eigen::MatrixXd basis(waves.rows(), 1 + waves.cols());
    basis << Eigen::VectorXd::Ones(waves.rows()), waves;
    Eigen::MatrixXd normal = basis.transpose() * basis;
    normal.diagonal().tail(waves.cols()).array() += damping * static_cast<double>(heights.size());
    return normal.ldlt().solve(basis.transpose() * heights).tail(waves.cols());
}

/// R and theta of -R cos(k x + theta) = c cos(k x) + s sin(k x).
struct Cosine {
    double R, theta;
    Cosine(double c, double s) : R(std::hypot(c, s)), theta(std::atan2(s, -c)) {}

    /// The A that gives R with two ridges of this amplitude at A = 1, with a tenth to spare.
    double least_A(double amplitude) const { return R / (2 * 0.9 * amplitude); }
    /// The angle between the phase of either ridge and theta: R = 2 G cos(angle).
    double half_between(double amplitude) const { return std::acos(std::min(1.0, R / (2 * amplitude))); }
};
/// The cosines of pairs of weights.
std::vector<Cosine> cosines_of(const Eigen::VectorXd& weights) {
    std::vector<Cosine> all;
    for (Index w = 0; w < weights.size(); w += 2) all.emplace_back(weights[w], weights[w + 1]);
    return all;
}

constexpr double unseen = 0.02;  ///< weight of a node that does not touch; the weight of one that touches is 1
constexpr int rounds = 4;        ///< rounds of fitting; after each, the nodes below the sum get the weight 1
constexpr double damping = 1e-4; ///< damping of the waves, relative to the sum of the nodes' weights
/// Longer scans are divided into parts, whose highest nodes are fitted, because contact is on peaks.
constexpr Index max_points = 2048;

/// The points of a scan that are fitted.
struct Points {
    Eigen::VectorXd x, z; ///< mm
    Eigen::VectorXd weight;
};

Points points_of(const Profile& scan, const std::vector<int>& touching) {
    const Index n = scan.nodes(), part = (n + max_points - 1) / max_points, count = (n + part - 1) / part;
    Points points{Eigen::VectorXd(count), Eigen::VectorXd(count), Eigen::VectorXd::Constant(count, unseen)};
    for (Index k = 0; k < count; ++k) {
        Index highest = 0;
        points.z[k] = scan.heights.segment(k * part, std::min(part, n - k * part)).maxCoeff(&highest);
        points.x[k] = scan.spacing * static_cast<double>(k * part + highest);
    }
    for (const int node : touching) points.weight[node / part] = 1;
    return points;
}

std::vector<int> touching(const DesignSetup& setup) {
    const Body& body = setup.model.body;
    double last = 0;
    for (const Loading& loading : loadings_of(setup, setup.model.loading))
        last = std::max(last, step_displacements(*setup.measured, body, loading, setup.model.contact).back());
    ContactOptions contact = setup.model.contact;
    contact.states = true;
    return solve_contact(*setup.measured, body, {last}, contact).states.front().nodes;
}

double longest_wave(const DesignSetup& setup) { return (setup.model.grid.periodic ? 1 : 2) * setup.model.grid.length; }

} // namespace

Genome shaped_start(const DesignSetup& setup, ga::Stream random) {
    const Target& target = setup.targets.front();
    Grid grid = setup.model.grid;
    grid.nodes = std::min(grid.nodes, grid.is_2d() ? shaping_side : shaping_nodes);
    grid.rows = std::min(grid.rows, shaping_side);
    const Profile surface{Eigen::VectorXd(grid.shape().nodes()), grid.spacing(), grid.rows, grid.row_spacing()};
    // A coarser grid requires a farther datum; a start need only be near the target.
    Body body = setup.model.body;
    if (body.kernel == Kernel::free)
        body.datum = std::max(*body.datum, 1.02 * grid.spacing() * static_cast<double>(grid.nodes) / 4);
    const double L = grid.length, infinity = std::numeric_limits<double>::infinity();
    const double last_pressure = setup.max_pressure          ? *setup.max_pressure
                                 : target.against_pressure() ? target.last()
                                                             : infinity;
    const double shortest = setup.limits.shortest_wave;
    const bool tips = setup.errors.noise > 0 && !grid.is_2d();
    const std::vector<int> order =
        tips ? tips_order(grid, std::max(shortest, setup.errors.noise_length), random) : drawn_order(grid, random);
    InverseProfile inverse = inverse_profile(surface, body, order, advance_for(target, surface.nodes()), last_pressure,
                                             target.against_pressure() ? infinity : target.last());
    const bool periodic_line = grid.periodic && !grid.is_2d();
    if (periodic_line && setup.max_pressure)
        inverse = with_mean_at_full_approach(std::move(inverse), *setup.model.loading.reach);
    else if (setup.max_pressure)
        inverse = with_range_at_last(std::move(inverse));
    else if (periodic_line) // stiffness has no upper limit, so the valleys would have none
        inverse.profile.heights = inverse.profile.heights.cwiseMax(
            (inverse.lowest_free.array() - valley_depth * inverse.last_displacement).matrix());
    const Eigen::VectorXd& heights = inverse.profile.heights;
    if (!(heights.maxCoeff() - heights.minCoeff() > 1e-9 * inverse.last_displacement))
        return drawn_start(setup, random); // the whole target is above full contact: a flat profile is best
    const double gamma = random.uniform(1.3, 1.6);
    const double H = random.uniform(0.8, 1.6);
    if (grid.is_2d())
        return shaped_as(inverse.profile, drawn_series(setup, H, gamma, L * random.uniform(0.9, 1.5)), setup.ridges,
                         grid, shortest);
    if (grid.periodic) return shaped_as(inverse.profile, harmonic_series(L, shortest, H), shortest);
    const double lambda = L * random.uniform(1.2, 2.0);
    if (tips) // needs more waves than a series has
        return shaped_as(inverse.profile, harmonic_series(lambda, shortest, H), shortest);
    const double second_lambda = lambda * random.uniform(0.6, 0.9), second_gamma = gamma * random.uniform(1.05, 1.2),
                 second_H = H * random.uniform(0.8, 1.2);
    const std::vector<Series> series{drawn_series(setup, H, gamma, lambda),
                                     drawn_series(setup, second_H, second_gamma, second_lambda)};
    return shaped_as(inverse.profile, series, shortest);
}

Genome fitting_grid(const DesignSetup& setup, const Genome& genome) {
    const bool takes_harmonics = setup.model.grid.periodic && !setup.model.grid.is_2d() && !setup.phases;
    return takes_harmonics ? in_harmonics(genome, setup.model.grid.length) : genome;
}

std::vector<Genome> database_starts(const DesignSetup& setup, int threads) {
    DatabaseLayout layout;
    layout.lambda = std::clamp(setup.model.grid.length, setup.bounds.lambda_from, setup.bounds.lambda_to);
    layout.H_from = std::clamp(layout.H_from, setup.bounds.H_from, setup.bounds.H_to);
    layout.H_to = std::clamp(layout.H_to, setup.bounds.H_from, setup.bounds.H_to);
    layout.gamma_from = std::clamp(layout.gamma_from, setup.bounds.gamma_from, setup.bounds.gamma_to);
    layout.gamma_to = std::clamp(layout.gamma_to, setup.bounds.gamma_from, setup.bounds.gamma_to);
    layout.shortest = setup.limits.shortest_wave;
    layout.ridges = setup.ridges;
    std::vector<Genome> genomes = sobol_database(layout);
    ga::parallel_for(genomes.size(), ga::thread_count(threads), [&](std::size_t i) {
        genomes[i] = with_fitting_amplitude(setup, fitting_grid(setup, genomes[i]));
    });
    return genomes;
}

Genome shaped_as(const Profile& profile, const std::vector<Series>& series, double shortest, double damping) {
    Genome genome{1, {}};
    for (const Series& law : series) genome.series.push_back(with_chromosomes(law, shortest, 2));
    const Grid grid{profile.nodes(), profile.spacing * static_cast<double>(profile.nodes()), true};
    const std::vector<Cosine> wanted = cosines_of(fitted(wave_basis(genome, grid), profile.heights, damping));
    auto next = wanted.begin();
    for (Series& one : genome.series) {
        const auto first = next;
        double A = 1e-300;
        for (const Chromosome& each : one.chromosomes) A = std::max(A, next++->least_A(amplitude(one, each.n, 2)));
        one.A = A;
        next = first;
        for (Chromosome& each : one.chromosomes) {
            const double half = next->half_between(amplitude(one, each.n, 2));
            each.phases = {next->theta + half, next->theta - half};
            ++next;
        }
    }
    return genome;
}

Genome shaped_as(const Profile& map, const Series& law, int ridges, const Grid& grid, double shortest, double damping) {
    const auto count = static_cast<std::size_t>(ridges);
    Series one = with_chromosomes(law, shortest, count);
    const std::vector<PlaneWave> waves = plane_waves({1, {one}}, grid);
    const Index columns = map.shape().columns;
    Eigen::MatrixXd basis(map.nodes(), 2 * static_cast<Index>(waves.size()));
    for (std::size_t w = 0; w < waves.size(); ++w) {
        const Eigen::ArrayXd angle = Eigen::ArrayXd::NullaryExpr(map.nodes(), [&](Index i) {
            return waves[w].k_x * (grid.first_x() + map.spacing * static_cast<double>(i % columns)) +
                   waves[w].k_y * (grid.first_y() + map.row_spacing * static_cast<double>(i / columns));
        });
        basis.col(2 * static_cast<Index>(w)) = angle.cos();
        basis.col(2 * static_cast<Index>(w) + 1) = angle.sin();
    }
    const std::vector<Cosine> wanted = cosines_of(fitted(basis, map.heights, damping));
    double A = 1e-300;
    for (std::size_t w = 0; w < waves.size(); ++w) A = std::max(A, wanted[w].least_A(waves[w].amplitude));
    one.A = A;
    Series twin = one;
    for (std::size_t w = 0; w < waves.size(); ++w) {
        const double half = wanted[w].half_between(A * waves[w].amplitude);
        one.chromosomes[w / count].phases[w % count] = wanted[w].theta + half;
        twin.chromosomes[w / count].phases[w % count] = wanted[w].theta - half;
    }
    return {1, {std::move(one), std::move(twin)}};
}

Index max_scan_waves(const DesignSetup& setup) {
    return static_cast<Index>(longest_wave(setup) /
                              std::max(setup.limits.shortest_wave, 2 * setup.model.grid.spacing()) * (1 + 1e-12));
}

double scan_waves_price(const DesignSetup& setup) {
    Model one_step = setup.model;
    one_step.grid.nodes = setup.measured->nodes();
    one_step.loading.steps = 1;
    return relative_price(one_step, setup.model);
}

Genome scan_waves(const DesignSetup& setup, Index waves) {
    if (!setup.measured) throw InputError("own: a measured profile is missing; design like a scan");
    if (setup.measured->is_2d()) throw InputError("own: the measured surface is a map; use a profile");
    const double longest = longest_wave(setup);
    const Index count = std::max<Index>(1, waves);
    Points points = points_of(*setup.measured, touching(setup));
    Eigen::MatrixXd basis(points.x.size(), 1 + 2 * count);
    basis.col(0).setOnes();
    for (Index k = 1; k <= count; ++k) {
        const Eigen::ArrayXd angle = 2 * std::numbers::pi * static_cast<double>(k) / longest * points.x;
        basis.col(2 * k - 1) = angle.cos();
        basis.col(2 * k) = angle.sin();
    }
    Eigen::VectorXd parts;
    for (int round = 0; round < rounds; ++round) {
        const Eigen::MatrixXd rows = points.weight.cwiseSqrt().asDiagonal() * basis;
        Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(basis.cols(), basis.cols());
        normal.selfadjointView<Eigen::Lower>().rankUpdate(rows.transpose());
        normal.diagonal().tail(2 * count).array() += damping * points.weight.sum();
        parts = normal.llt().solve(basis.transpose() * points.weight.cwiseProduct(points.z));
        const Eigen::ArrayXd above = basis * parts - points.z;
        points.weight = (above > 0).select(1, points.weight);
    }
    Genome genome{1, {}};
    for (Index k = 1; k <= count; ++k) {
        const Cosine wave(parts[2 * k - 1], parts[2 * k]);
        Series series{1,
                      std::clamp(1.0, setup.bounds.H_from, setup.bounds.H_to),
                      std::clamp(2.0, setup.bounds.gamma_from, setup.bounds.gamma_to),
                      longest / static_cast<double>(k),
                      {{1, {wave.theta}}}};
        series.A = wave.R / amplitude(series, 1, 1);
        if (series.A > 0) genome.series.push_back(std::move(series));
    }
    return genome;
}

Genome waves_like(const DesignSetup& setup, ga::Stream random) {
    if (!setup.measured || !setup.measured->is_2d())
        throw InputError("own: a measured map is missing; design like a map");
    constexpr double ratio = 1.25;      // of neighbouring wavelengths
    constexpr double negligible = 1e-4; // share of the power
    const Profile& map = *setup.measured;
    const Eigen::ArrayXXd powers = wave_powers(map, setup.model.grid.periodic);
    const double length = map.spacing * static_cast<double>(map.shape().columns),
                 width = map.row_spacing * static_cast<double>(map.rows), longest = std::max(length, width),
                 shortest = setup.limits.shortest_wave * std::pow(ratio, random.uniform(0, 1));
    const Index bands = 1 + static_cast<Index>(std::max(0.0, std::log(longest / shortest) / std::log(ratio))),
                ridges = setup.ridges;
    Eigen::ArrayXXd power = Eigen::ArrayXXd::Zero(bands, ridges); // of each wavelength and direction
    for (Index j = 0; j < powers.cols(); ++j)
        for (Index i = 0; i < powers.rows(); ++i) {
            const double x = static_cast<double>(i) / length,
                         y = static_cast<double>(2 * j > map.rows ? j - map.rows : j) / width;
            const double band = std::round(-std::log(std::hypot(x, y) * shortest) / std::log(ratio)),
                         angle = std::atan2(y, x) / std::numbers::pi * static_cast<double>(ridges);
            if (i + j > 0 && band >= 0)
                power(std::min(static_cast<Index>(std::min(band, 1e6)), bands - 1),
                      (std::lround(angle) + ridges) % ridges) += powers(i, j);
        }
    Genome genome{1, {}};
    for (Index b = 0; b < bands; ++b) {
        if (!(power.row(b).sum() > negligible * power.sum())) continue;
        Series series{1,
                      std::clamp(1.0, setup.bounds.H_from, setup.bounds.H_to),
                      std::clamp(2.0, setup.bounds.gamma_from, setup.bounds.gamma_to),
                      shortest * std::pow(ratio, static_cast<double>(b)),
                      {{1, {}}}};
        const double unit = amplitude(series, 1, static_cast<std::size_t>(ridges));
        series.A = 0;
        std::vector<Cosine> waves;
        for (Index m = 0; m < ridges; ++m) {
            const double angle = random.uniform(0, 2 * std::numbers::pi), R = std::sqrt(2 * power(b, m));
            waves.emplace_back(R * std::cos(angle), R * std::sin(angle));
            series.A = std::max(series.A, waves.back().least_A(unit));
        }
        Series twin = series;
        for (const Cosine& wave : waves) {
            const double half = wave.half_between(series.A * unit);
            series.chromosomes[0].phases.push_back(wave.theta + half);
            twin.chromosomes[0].phases.push_back(wave.theta - half);
        }
        genome.series.push_back(std::move(series));
        genome.series.push_back(std::move(twin));
    }
    if (genome.series.empty())
        throw InputError("own: the measured map has no waves of " + std::to_string(shortest) +
                         " mm or longer; allow shorter ones");
    return genome;
}

} // namespace rough
