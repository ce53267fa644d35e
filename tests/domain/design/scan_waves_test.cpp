#include "domain/design/scan_waves.hpp"
#include "domain/design/search.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/test_surfaces.hpp"
#include "domain/target/like.hpp"
#include "tests/domain/design/ten_scans.hpp"

#include <catch2/catch.hpp>

using namespace rough;

namespace {

/// Stiffness and contact area as a scan has them, on a grid of so many nodes.
DesignSetup like(const Profile& scan, Index nodes, double length, Kernel kernel = Kernel::free) {
    DesignSetup setup;
    setup.like = scan;
    setup.model.body.kernel = kernel;
    setup.model.grid = {scan.nodes(), length, kernel == Kernel::periodic};
    setup.model = completed(setup.model);
    setup.targets = {target_like(scan, setup.model, "stiffness"),
                     target_like(scan, setup.model, "area", Quantity::area_at_pressure)};
    setup.model.grid.nodes = nodes;
    return completed(setup);
}

std::vector<int> touching(const DesignSetup& setup) {
    ContactOptions options;
    options.states = true;
    const double range = displacement_range(*setup.like, setup.model.body.kernel);
    return solve_contact(*setup.like, setup.model.body, {range}, options).states.front().nodes;
}

} // namespace

TEST_CASE("a scan that is a sum of few waves is that sum, on either body") {
    for (const Kernel kernel : {Kernel::free, Kernel::periodic}) {
        const bool periodic = kernel == Kernel::periodic;
        const Grid grid{128, 2, periodic};
        const Profile scan = sampled(grid, [&](double x) {
            const double q = 2 * std::numbers::pi / (periodic ? 2.0 : 4.0);
            return 1e-3 * (std::cos(q * x + 0.4) + 0.5 * std::cos(3 * q * x + 2) + 0.2 * std::cos(7 * q * x));
        });
        const DesignSetup setup = like(scan, 128, 2, kernel);
        const Profile sum = sample(scan_waves(setup, 10), grid);
        const Eigen::ArrayXd off = (sum.heights - scan.heights).array();
        CHECK((off - off.mean()).abs().maxCoeff() < 2e-2 * 3.4e-3);
        CHECK(similarity(setup, scan_waves(setup, 10)) > 0.9);
        CHECK(std::abs(jump_at_ends(scan_waves(setup, 10), 2)) < (periodic ? 1e-12 : 1.0));
    }
}

TEST_CASE("nodes that touch are followed more closely than those that contact does not see") {
    const Profile scan = ten_scans::walk(9);
    const DesignSetup setup = like(scan, scan.nodes(), ten_scans::grid.length);
    const Eigen::VectorXd off = sample(scan_waves(setup, 128), setup.model.grid).heights - scan.heights;
    const std::vector<int> nodes = touching(setup);
    double seen = 0, all = (off.array() - off(nodes).mean()).square().mean();
    for (const int node : nodes)
        seen += std::pow(off[node] - off(nodes).mean(), 2) / static_cast<double>(nodes.size());
    CHECK(seen < 0.5 * all);
}

TEST_CASE("refined, a scan's own waves answer as it does in stiffness and area together") {
    const DesignSetup setup =
        like(fractal_profile(ten_scans::grid, 0.8, 1e-3, 5), 512, ten_scans::grid.length);
    SearchOptions options;
    options.alternatives = 1;
    // The first stages of the variant `like`.
    options.pipeline = "own 1 | score | refine lm 30 sharpen=8 | score verified | refine lm 30 sharpen=4";
    const Answer answer = search(setup, options).best;
    CHECK(answer.lowest() > 0.85);
    CHECK(answer.within_limits);
}

TEST_CASE("a design like a scan goes on from what it has until its evaluations are spent") {
    const DesignSetup setup = like(ten_scans::walk(9), 256, ten_scans::grid.length);
    SearchOptions options;
    options.pipeline = "like";
    options.alternatives = 1;
    options.evaluations = 130;
    const SearchResult once = search(setup, options);
    REQUIRE(once.best.lowest() < default_required_similarity);
    options.evaluations = once.counters.asked + 300;
    const SearchResult longer = search(setup, options);
    CHECK(longer.counters.asked > once.counters.asked);
    CHECK(longer.counters.asked <= options.evaluations);
    CHECK(longer.best.lowest() > once.best.lowest());
}

TEST_CASE("of ten scans at least six are met to 0.9 at their worst in stiffness and area together",
          "[long]") {
    int met = 0;
    for (const ten_scans::Scan& scan : ten_scans::all()) {
        const DesignSetup setup = like(scan.profile, 2048, ten_scans::grid.length);
        SearchOptions options;
        options.pipeline = "like";
        options.evaluations = 200; // about 50 s on two cores
        const SearchResult found = search(setup, options);
        WARN(scan.name << ": " << found.best.lowest());
        met += found.best.lowest() >= 0.9;
    }
    CHECK(met >= 6);
}
