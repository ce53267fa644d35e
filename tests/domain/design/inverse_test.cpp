#include "domain/design/inverse.hpp"
#include "domain/design/starts.hpp"
#include "domain/problem/response.hpp"
#include "tests/catch.hpp"
#include "tests/domain/random_genome.hpp"

using namespace rough;

namespace {

using testing::paper_length;
constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<int> outwards(Index nodes, double centre) {
    std::vector<int> order(static_cast<std::size_t>(nodes));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return std::abs(a - centre) < std::abs(b - centre); });
    return order;
}

Profile paper_line(Index nodes, bool periodic = false) {
    return {Eigen::VectorXd(nodes), paper_length / static_cast<double>(periodic ? nodes : nodes - 1)};
}

} // namespace

TEST_CASE("any order of nodes and any advance have a surface", "[areas]") {
    std::mt19937_64 random(21);
    for (const bool is_map : {false, true})
        for (const Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip})
            for (int scene = 0; scene < (!is_map ? 10 : kernel == Kernel::strip ? 0 : 4); ++scene) {
                const Index nodes = is_map ? 42 : 24 + 3 * scene;
                const Body body{kernel, 1.7, paper_length, 0.002};
                Profile surface = paper_line(nodes, kernel == Kernel::periodic);
                if (is_map) surface.spacing = 0.1, surface.rows = 6, surface.row_spacing = 0.13;
                std::vector<int> order = outwards(nodes, 0);
                std::shuffle(order.begin(), order.end(), random);
                std::vector<double> steps(static_cast<std::size_t>(nodes));
                for (double& step : steps) step = std::uniform_real_distribution<double>(0.1e-5, 1e-5)(random);
                Eigen::VectorXd stiffness;
                const InverseProfile inverse = inverse_profile(
                    surface, body, order,
                    [&](const Eigen::VectorXd& K) {
                        stiffness = K;
                        return steps;
                    },
                    infinity, infinity);
                CHECK(inverse.profile.is_2d() == is_map);
                std::vector<double> displacements;
                for (std::size_t k = 0; k + 1 < inverse.entry.size(); ++k)
                    displacements.push_back(0.5 * (inverse.entry[k] + inverse.entry[k + 1]));
                if (kernel == Kernel::periodic) displacements.pop_back(); // the last node closes full contact
                const ContactCurve curve =
                    solve_contact(inverse.profile, body, displacements, {.states = true, .stop = {}});
                for (std::size_t k = 0; k < displacements.size(); ++k) {
                    const auto end = order.begin() + static_cast<long>(k) + 1;
                    REQUIRE(std::is_permutation(order.begin(), end, curve.states[k].nodes.begin(),
                                                curve.states[k].nodes.end()));
                    CHECK(curve.steps[k].tangent_stiffness == Approx(stiffness[static_cast<Index>(k)]).epsilon(1e-9));
                }
            }
}

TEST_CASE("the inverse of a rising stiffness curve has that curve, for every kernel") {
    Target target{.x = Eigen::VectorXd::LinSpaced(20, 4e-6, 1.56e-4)};
    for (const Kernel kernel : {Kernel::free, Kernel::strip, Kernel::periodic}) {
        const bool periodic = kernel == Kernel::periodic;
        const Index nodes = 256;
        const Body body{kernel, 1, paper_length, 0.0016};
        const Profile surface = paper_line(nodes, periodic);
        double least = 0, most = 0;
        const auto order = outwards(nodes, 110.3);
        inverse_profile(
            surface, body, order,
            [&](const Eigen::VectorXd& K) {
                least = K[4], most = K[nodes / 2];
                return std::vector<double>(static_cast<std::size_t>(K.size()), 1e-6);
            },
            infinity, infinity);
        target.y = least + (most - least) * (target.x.array() / target.x[19]).sqrt();
        InverseProfile inverse = inverse_profile(surface, body, order, advance_for(target, nodes), 1.6e-4, infinity);
        CHECK(inverse.last_pressure == Approx(1.6e-4));
        const Response response =
            respond(inverse.profile, body, {.steps = 80, .to_displacement = inverse.last_displacement});
        CHECK(response.pressure[79] == Approx(1.6e-4).epsilon(1e-6));
        // 80 secants of a curve that is stepped from node to node
        CHECK(similarity(target, secant_stiffness(response)) > 0.97);

        const double reach = periodic ? 0.9 : 1;
        inverse = periodic ? with_mean_at_full_approach(inverse, reach) : with_range_at_last(inverse);
        const Response full = respond(inverse.profile, body, {.steps = 80, .reach = reach});
        CHECK(reach * full.range == Approx(inverse.last_displacement).epsilon(1e-9));
        CHECK(full.pressure[79] == Approx(1.6e-4).epsilon(1e-6));
    }
}

TEST_CASE("starts on a periodic body are near their target, with Eq. 11 and without") {
    Target rising{.x = Eigen::VectorXd::LinSpaced(5, 0.002, 0.016)},
        concave{.x = Eigen::VectorXd::LinSpaced(20, 4e-6, 1.56e-4)};
    rising.y = 950 * rising.x; // in proportion to the pressure, as in Persson's theory
    concave.y = 0.35 + 0.95 * (concave.x.array() / 1.6e-4).pow(0.7);
    const Target point{Quantity::stiffness, "", concave.x.tail(1), concave.y.tail(1)};
    for (const auto& [target, max_pressure] :
         {std::pair(rising, 0.0), {concave, 0.0}, {concave, 1.6e-4}, {point, 0.0}}) {
        DesignSetup setup{.model = completed({.body = {Kernel::periodic}}), .targets = {target}};
        if (max_pressure > 0) setup.max_pressure = max_pressure;
        int near = 0;
        for (std::uint64_t key = 0; key < 8; ++key)
            near += similarity(setup, shaped_start(setup, ga::Stream(key))) > 0.8;
        INFO(max_pressure << " MPa, to " << target.y.tail(1)[0] << " MPa/mm: " << near);
        CHECK(near >= 3);
    }
}

TEST_CASE("the inverse meets interface stiffness, load and contact fraction") {
    const Index nodes = 256;
    const Body body;
    for (const Quantity quantity : {Quantity::area_at_pressure, Quantity::area_at_displacement,
                                    Quantity::load_at_displacement, Quantity::interface_stiffness}) {
        Target target{.quantity = quantity, .x = Eigen::VectorXd::LinSpaced(20, 1e-5, 2e-4)};
        const Eigen::ArrayXd t = target.x.array() / 2e-4;
        target.y = quantity == Quantity::load_at_displacement  ? Eigen::VectorXd(8e-5 * t + 4e-5 * t.square())
                   : quantity == Quantity::interface_stiffness ? Eigen::VectorXd(0.5 + 40 * t)
                                                               : Eigen::VectorXd(0.05 + 0.5 * t);
        const InverseProfile inverse =
            inverse_profile(paper_line(nodes), body, outwards(nodes, 120), advance_for(target, nodes),
                            target.against_pressure() ? 2e-4 : infinity, target.against_pressure() ? infinity : 2e-4);
        const Response response =
            respond(inverse.profile, body, {.steps = 80, .to_displacement = inverse.last_displacement});
        INFO("quantity " << int(quantity)); // interface stiffness needs contact of 96 %
        CHECK(similarity(target, curve_of(quantity, response)) > 0.95);
    }
}

TEST_CASE("waves fitted to a surface of these waves reproduce it", "[areas]") {
    std::mt19937_64 random(22);
    const auto check = [](const Grid& grid, const Genome& genome, const auto& fitted) {
        const Profile surface = sample(genome, grid), again = sample(fitted(surface), grid);
        const Eigen::VectorXd difference = again.heights - surface.heights;
        CHECK(difference.maxCoeff() - difference.minCoeff() <
              1e-4 * (surface.heights.maxCoeff() - surface.heights.minCoeff()));
    };
    for (int scene = 0; scene < 5; ++scene) {
        const Genome genome = testing::random_genome(random, 2, 1, paper_length, 0.03);
        check({512, paper_length}, genome, [&](const Profile& profile) {
            const Genome found = shaped_as(profile, genome.series, 0.03, 1e-14);
            CHECK(shortest_wave(found) >= 0.03 * (1 - 1e-9));
            return found;
        });
    }
    for (const bool periodic : {false, true}) {
        const Grid grid{14, paper_length, periodic, 0, 12, 0.8};
        const Genome genome = testing::random_genome(random, 1, 4, paper_length, 0.3);
        check(grid, genome, [&](const Profile& map) { return shaped_as(map, genome.series[0], 4, grid, 0.3, 1e-12); });
    }
}
