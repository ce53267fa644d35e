#include "domain/problem/making_errors.hpp"

#include "domain/errors.hpp"
#include "domain/numerics/fourier.hpp"
#include "ga/base/budget.hpp"

#include <numbers>

namespace rough {
namespace {

/// The number of fixed draws of noise. Searches begin on coarser grids, with fewer draws.
std::uint64_t fixed_draws(const Grid& grid) {
    return static_cast<std::uint64_t>(std::clamp<Index>(3 * grid.shape().nodes() / 4, 48, 384));
}

/// Load steps that end at the pressure or displacement of the search's last step. Under Eq. 11 all targets
/// are against pressure.
std::vector<Loading> loadings_of_made(const DesignSetup& given, const DesignSetup& made) {
    std::vector<Loading> loadings = loadings_of(made, made.model.loading);
    if (!given.max_pressure) return loadings;
    const double last = std::ranges::max(given.targets, {}, &Target::last).last(); // pressure
    for (Loading& loading : loadings) *loading.to_pressure *= std::max(1., *given.max_pressure / last);
    return loadings;
}

DesignSetup without_eq_11(DesignSetup setup) {
    setup.max_pressure.reset();
    return setup;
}

} // namespace

SurfaceWithErrors::SurfaceWithErrors(DesignSetup setup, Genome genome)
    : setup_(without_eq_11(setup)), genome_(std::move(genome)), surface_(sample(genome_, setup.model.grid)),
      loadings_(loadings_of_made(setup, setup_)) {}

DesignResponse SurfaceWithErrors::response(const Eigen::VectorXd& errors) const {
    Profile made = surface_;
    made.heights += errors;
    std::vector<Response> responses;
    for (const Loading& loading : loadings_)
        responses.push_back(
            respond(made, setup_.model.body, up_to_full_contact(loading, made, setup_.model), setup_.model.contact));
    return design_response(setup_, std::move(responses));
}

double SurfaceWithErrors::similarity(const Eigen::VectorXd& errors) const {
    try {
        return rough::similarity(setup_, response(errors));
    } catch (const std::exception&) {
        if (is_stopped(setup_.model.contact)) throw ga::Stopped{"stop requested"};
        return -HUGE_VAL;
    }
}

ga::Sensitivity SurfaceWithErrors::misfits(const Eigen::VectorXd& errors, const Rows& plain) const {
    Profile made = surface_;
    made.heights += errors;
    const auto in_genes = [&](const Eigen::MatrixXd& by_heights) {
        Eigen::MatrixXd by_genes = pulled_back(by_heights, genome_, setup_.model.grid);
        if (plain.d_factor.size() > 0) by_genes += by_heights * surface_.heights / plain.factor * plain.d_factor;
        return by_genes;
    };
    return misfit_rows(setup_, made, loadings_, setup_.model, in_genes).misfits;
}

std::vector<Eigen::VectorXd> unit_tilts(const Grid& grid) {
    const auto rise = [](Index nodes, double spacing, double over) {
        return Eigen::ArrayXd::LinSpaced(nodes, 0, spacing * static_cast<double>(nodes - 1) / over);
    };
    Eigen::ArrayXXd plane(grid.nodes, grid.rows);
    plane.colwise() = rise(grid.nodes, grid.spacing(), grid.length);
    std::vector<Eigen::VectorXd> tilts{plane.reshaped()};
    if (grid.is_2d()) {
        plane.rowwise() = rise(grid.rows, grid.row_spacing(), grid.width).transpose();
        tilts.emplace_back(plane.reshaped());
    }
    return tilts;
}

CommonErrors::CommonErrors(const DesignSetup& setup) {
    const MakingErrors& errors = setup.errors;
    const Grid& grid = setup.model.grid;
    for (std::uint64_t draw = 0; errors.noise > 0 && draw < fixed_draws(grid); ++draw)
        noise.push_back(errors.noise *
                        height_noise(grid, errors.noise_length, ga::fold(ga::fold(0, "common draws"), draw)));
    if (errors.tilt > 0)
        for (const Eigen::VectorXd& tilt : unit_tilts(grid))
            tilts.insert(tilts.end(), {errors.tilt * tilt, -errors.tilt * tilt});
}

double CommonErrors::similarity(const SurfaceWithErrors& made) const {
    std::vector<double> with_noise{1}, with_tilts{1};
    for (const Eigen::VectorXd& heights : tilts) with_tilts.push_back(made.similarity(heights));
    for (const Eigen::VectorXd& heights : noise) with_noise.push_back(made.similarity(heights));
    std::sort(with_noise.begin(), with_noise.end());
    const auto worst = static_cast<std::ptrdiff_t>(std::max<std::size_t>(1, noise.size() / 10));
    return std::min(std::accumulate(with_noise.begin(), with_noise.begin() + worst, 0.) / static_cast<double>(worst),
                    *std::min_element(with_tilts.begin(), with_tilts.end()));
}

Eigen::VectorXd height_noise(const Grid& grid, double length, std::uint64_t seed) {
    constexpr double cut = 12; // value of q l beyond which amplitudes are below 2e-8 of the largest
    const double period = grid.periodic ? 1 : 2, pi = std::numbers::pi;
    const auto elements = [&](Index nodes) {
        return grid.periodic ? nodes : 2 * std::max<Index>(1, grid.has_cells() ? nodes : nodes - 1);
    };
    const Extent shape{elements(grid.nodes), grid.is_2d() ? elements(grid.rows) : 1};
    const double dq = 2 * pi * length / (period * grid.length), // step of q l
        dq_y = grid.is_2d() ? 2 * pi * length / (period * grid.width) : 0;
    const auto last = static_cast<Index>(cut / dq), last_y = grid.is_2d() ? static_cast<Index>(cut / dq_y) : 0;
    const auto folded = [](Index k, Index n) { return (k % n + n) % n; };
    Eigen::ArrayXXcd waves = Eigen::ArrayXXcd::Zero(shape.columns, shape.rows);
    ga::Stream random(seed);
    double power = 0;
    for (Index j = -last_y; j <= last_y; ++j)
        for (Index i = -last; i <= last; ++i) {
            const double ql = std::hypot(dq * static_cast<double>(i), dq_y * static_cast<double>(j));
            if (ql > cut) continue;
            const double amplitude = std::exp(-ql * ql / 8), a = random.normal(), b = random.normal();
            power += amplitude * amplitude;
            const double angle = dq / length * static_cast<double>(i) * grid.first_x() +
                                 dq_y / length * static_cast<double>(j) * grid.first_y();
            waves(folded(i, shape.columns), folded(j, shape.rows)) += std::polar(amplitude, angle) * std::complex(a, b);
        }
    const Eigen::ArrayXXd heights = inverse_complex_transform(waves).real();
    return heights.topLeftCorner(grid.nodes, grid.rows).reshaped() / std::sqrt(power);
}

} // namespace rough
