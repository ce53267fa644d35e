#include "domain/design/search.hpp"
#include "domain/design/starts.hpp"
#include "domain/mwm/test_surfaces.hpp"
#include "domain/profile/preparation.hpp"
#include "tests/catch.hpp"

#include <numbers>

using namespace rough;

/// Ten surfaces as a stylus would measure them, two of each kind.
namespace ten_scans {

const Grid grid{1024, 4, false}; ///< 4 mm

/// Normal heights smoothed over `correlation` (mm), rms 1.
Eigen::VectorXd smoothed(double correlation, ga::Stream random) {
    const double h = grid.spacing();
    const auto reach = static_cast<Index>(3 * correlation / h);
    Eigen::VectorXd noise(grid.nodes + 2 * reach), z = Eigen::VectorXd::Zero(grid.nodes);
    for (double& one : noise) one = random.normal();
    for (Index j = -reach; j <= reach; ++j) {
        const double t = static_cast<double>(j) * h / correlation;
        z += std::exp(-t * t) * noise.segment(reach + j, grid.nodes);
    }
    return z / std::sqrt(z.squaredNorm() / static_cast<double>(grid.nodes));
}

/// Grooves of a round tool at distances `feed`, with roughness of rms `rest`.
Profile turned(double feed, double rest, std::uint64_t seed) {
    Eigen::VectorXd z = rest * smoothed(0.02, ga::Stream(seed));
    for (Index i = 0; i < grid.nodes; ++i) {
        const double x = grid.spacing() * static_cast<double>(i) / feed, t = x - std::floor(x) - 0.5;
        z[i] += 4e-3 * 4 * t * t;
    }
    return {z, grid.spacing()};
}

Profile ground(double correlation, std::uint64_t seed) {
    const Eigen::VectorXd coarse = smoothed(correlation, ga::Stream(seed)),
                          fine = smoothed(0.1 * correlation + 0.005, ga::Stream(seed + 100));
    return {1e-3 * (0.8 * coarse + 0.3 * fine), grid.spacing()};
}

/// Plateaux with grooves cut across them.
Profile honed(int grooves, std::uint64_t seed) {
    ga::Stream random(seed);
    Eigen::VectorXd z = 2e-4 * smoothed(0.03, ga::Stream(seed + 100));
    for (int g = 0; g < grooves; ++g) {
        const double at = random.uniform(0, grid.length), width = random.uniform(0.02, 0.08),
                     depth = random.uniform(1e-3, 4e-3);
        for (Index i = 0; i < grid.nodes; ++i)
            z[i] -= depth * std::max(0.0, 1 - std::abs(grid.spacing() * static_cast<double>(i) - at) / width);
    }
    return {z, grid.spacing()};
}

/// Roughness whose peaks above the share `cut` of all heights are worn to 3 % of their height.
Profile plateau(double correlation, double cut, std::uint64_t seed) {
    Eigen::VectorXd z = 1e-3 * smoothed(correlation, ga::Stream(seed)), sorted = z;
    std::ranges::sort(sorted);
    const double top = sorted[static_cast<Index>(cut * static_cast<double>(z.size()))];
    z = z.array().min(0.97 * top + 0.03 * z.array()).matrix() + 5e-5 * smoothed(0.012, ga::Stream(seed + 1));
    return {z, grid.spacing()};
}

Profile walk(std::uint64_t seed) {
    ga::Stream random(seed);
    Eigen::VectorXd z(grid.nodes);
    double height = 0;
    for (double& one : z) one = height += 1e-4 * random.normal();
    return {detrended({z, grid.spacing()}, Detrend::line), grid.spacing()};
}

std::vector<std::pair<std::string, Profile>> all() {
    return {{"turned, feed 0.33 mm", turned(0.33, 2e-4, 1)},
            {"turned, feed 0.125 mm", turned(0.125, 4e-4, 2)},
            {"ground, fine", ground(0.03, 3)},
            {"ground, coarse", ground(0.1, 4)},
            {"fractured, H = 0.8", fractal_profile(grid, 0.8, 1e-3, 5)},
            {"fractured, H = 0.6", fractal_profile(grid, 0.6, 1e-3, 6)},
            {"honed, 15 grooves", honed(15, 7)},
            {"honed, 40 grooves", honed(40, 8)},
            {"plateau, coarse", plateau(0.05, 0.6, 9)},
            {"plateau, fine", plateau(0.02, 0.4, 11)}};
}

} // namespace ten_scans

namespace {

/// Stiffness and contact area of a scan as targets, on a grid with these nodes.
DesignSetup like_scan(const Profile& scan, std::optional<Extent> nodes, double length, Kernel kernel = Kernel::free,
                      Resolution resolution = Resolution::off) {
    const Model model{.grid = {scan.nodes(), length}, .body = {.kernel = kernel}};
    return design_like(scan, completed(model), "scan", likeness_named("both"), 20, nodes, resolution);
}

} // namespace

TEST_CASE("the waves of a scan of few waves are these waves, on either body") {
    for (const Kernel kernel : {Kernel::free, Kernel::periodic}) {
        const bool periodic = kernel == Kernel::periodic;
        const Grid grid{periodic ? 128 : 2500, 2, periodic}; // parts of two nodes are fitted by one
        const Profile scan = sampled(grid, [&](double x) {
            const double q = 2 * std::numbers::pi / (periodic ? 2.0 : 4.0);
            return 1e-3 * (std::cos(q * x + 0.4) + 0.5 * std::cos(3 * q * x + 2) + 0.2 * std::cos(7 * q * x));
        });
        const DesignSetup setup = like_scan(scan, {{grid.nodes}}, 2, kernel);
        const Profile sum = sample(scan_waves(setup, 10), grid);
        const Eigen::ArrayXd off = (sum.heights - scan.heights).array();
        CHECK((off - off.mean()).abs().maxCoeff() < 2e-2 * 3.4e-3);
        CHECK(similarity(setup, scan_waves(setup, 10)) > 0.9);
        CHECK(std::abs(jump_at_ends(scan_waves(setup, 10), 2)) < (periodic ? 1e-12 : 1.0));
    }
}

TEST_CASE("refined waves of a scan have its stiffness and contact area") {
    const DesignSetup setup =
        like_scan(fractal_profile(ten_scans::grid, 0.8, 1e-3, 5), {{512}}, ten_scans::grid.length);
    // The first stages of the variant `like`.
    const Answer answer =
        search(setup, {.pipeline = "own 1 | score | refine lm 30 sharpen=8 | score verified | refine lm 30 sharpen=4",
                       .alternatives = 1})
            .best;
    CHECK(answer.lowest() > 0.85);
    CHECK(answer.within_limits);
}

TEST_CASE("the variant like improves its answer until its evaluations are spent") {
    const DesignSetup setup = like_scan(ten_scans::walk(9), {{256}}, ten_scans::grid.length);
    SearchOptions options{.pipeline = "like", .evaluations = 130, .alternatives = 1};
    const SearchResult once = search(setup, options);
    REQUIRE(once.best.lowest() < default_required_similarity);
    options.evaluations += 1500;
    const SearchResult longer = search(setup, options);
    CHECK(longer.counters.requested > once.counters.requested);
    CHECK(longer.counters.requested <= options.evaluations);
    CHECK(longer.best.lowest() > once.best.lowest());
}

TEST_CASE("at least eight of ten scans are met to 0.9 in stiffness and area together", "[long]") {
    int met = 0;
    for (const auto& [name, profile] : ten_scans::all()) {
        const DesignSetup setup = like_scan(profile, {}, ten_scans::grid.length, Kernel::free, Resolution::on);
        const SearchResult found = search(setup, {.pipeline = "like"});
        CHECK(found.stopped.empty());
        // Against the scan itself, on a grid four times finer and at 16 times the load steps.
        const DesignSetup finer =
            in_finer_steps(like_scan(profile, {{setup.model.grid.nodes}}, ten_scans::grid.length), 16);
        const auto similar = similarities(finer, respond(finer, found.best.genome, refined(finer.model, 4)));
        WARN(name << ": " << similar[0] << ", " << similar[1] << "; stated " << found.best.worst);
        met += std::ranges::min(similar) >= 0.9;
    }
    CHECK(met >= 8);
}

TEST_CASE("finer load steps keep a measured profile's band about its values") {
    for (const auto& [name, profile] : ten_scans::all()) {
        const DesignSetup setup = like_scan(profile, {{256}}, ten_scans::grid.length, Kernel::free, Resolution::on);
        for (const int times : {2, 3, 4, 7}) {
            INFO(name << ", " << times << " times the load steps");
            CHECK_NOTHROW(validate(in_finer_steps(setup, times)));
        }
    }
}
