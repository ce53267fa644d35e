#include "domain/accuracy/respond_within.hpp"
#include "domain/design/starts.hpp"
#include "domain/design/statistical.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/genome.hpp"
#include "domain/mwm/test_surfaces.hpp"
#include "domain/problem/problem.hpp"
#include "domain/profile/preparation.hpp"
#include "domain/profile/roughness.hpp"
#include "domain/profile/solid.hpp"
#include "domain/response/curve.hpp"
#include "domain/target/target.hpp"
#include "domain/theory/theory.hpp"

#include <catch2/catch.hpp>

#include <functional>

using namespace rough;

namespace {

Profile line_of(std::initializer_list<double> heights, double spacing = 0.1) {
    return {Eigen::Map<const Eigen::VectorXd>(heights.begin(), static_cast<Index>(heights.size())), spacing};
}

const Profile good = line_of({0, 1, 0.5, 0.2}), short_line = line_of({0, 1, 0, 1, 0, 1, 0, 1, 0}),
              constant{Eigen::VectorXd::Constant(50, 2), 0.1},
              map{Eigen::VectorXd::Constant(144, 2), 0.1, 12, 0.1};
const Loading one_step{1, 1}, to_full_contact{20, 1}, two_steps{.steps = 2};
const std::vector<double> falling{2e-3, 1e-3};
const SpectralMoments no_roughness{1, 0, 1}, few_summits{1, 1, 1.4};

std::function<void()> pressing(const Profile& profile, const Body& body,
                               std::vector<double> displacements = {0.1},
                               const ContactOptions& options = {}) {
    return [=] { solve_contact(profile, body, displacements, options); };
}

/// Makes a problem of a changed set-up for the paper's target.
std::function<void()> design(const std::function<void(DesignSetup&)>& change) {
    return [=] {
        DesignSetup setup;
        setup.targets = {read_target(RUGOSA_TEST_DATA "/target_paper.csv")};
        change(setup);
        const DesignProblem problem(setup);
    };
}

std::function<void()> self_affine(const std::function<void(SelfAffine&)>& change) {
    return [=] {
        SelfAffine all{0.8, 0.5, 0.1, 0.05};
        change(all);
        random_surface(all);
    };
}

} // namespace

TEST_CASE("a function refuses a wrong argument by its name and value") {
    const double huge = std::numeric_limits<double>::max(), nan = std::nan("");
    const Body body, periodic{Kernel::periodic}, soft{Kernel::free, 0}, near{Kernel::free, 1, 0.01};
    Body hard;
    hard.hardness = 0.5;
    ContactOptions nested, rash;
    nested.solver = Solver::nested;
    rash.tolerance = 0.011;
    const std::vector<std::pair<std::function<void()>, std::string>> wrong{
        {pressing(line_of({1}), body), "1 node(s)"},
        {pressing(line_of({0, 1}, 0), body), "spacing: 0 mm"},
        {pressing(line_of({-huge, huge}), body), "beyond double precision"},
        {pressing(line_of({0, nan}), body), "node 1"},
        {pressing(good, body, {0.2, 0.1}), "0.1 mm after 0.2"},
        {pressing(good, periodic, {0.9}), "0.575 mm: beyond full contact"},
        {pressing(good, soft), "modulus: 0 MPa"},
        {pressing(good, near), "datum: 0.01 mm"},
        {pressing(good, {Kernel::strip, 1, 1, -1}), "strip width: -1 mm"},
        {pressing(good, hard, {0.1}, nested), "hardness"},
        {pressing(good, body, {0.1}, rash), "tolerance"},
        {pressing(map, {Kernel::strip}), "strip"},
        {[=] { solve_contact_at_pressures(good, body, falling); }, "0.001 MPa after 0.002"},
        {[=] { with_datum(solve_contact(good, periodic, {0.1}), good, periodic, 1); }, "datum"},
        {[] { respond(constant); }, "all heights are equal"},
        {[] { load_displacements(1, one_step, Kernel::free); }, "steps: 1"},
        {[] { load_displacements(1, to_full_contact, Kernel::periodic); }, "reach: 1 is out of range"},
        {[=] { partial_slip(respond(good, body, two_steps), 0); }, "friction coefficient 0"},
        {[] {
             Model model;
             model.body.hardness = 1;
             model.accuracy = 0.01;
             respond_within(good, model);
         },
         "accuracy: its bounds do not hold with a hardness"},
        {[] { roughness(short_line); }, "9 nodes"},
        {[] { roughness(constant); }, "constant"},
        {[] { areal_parameters(map); }, "constant"},
        {[] { low_passed(good, 0); }, "cut-off"},
        {[] {
             fractal_profile({512, 0.8, false}, 1, 1, 0);
         },
         "hurst: 1 is out of range"},
        {[] { binary_stl(good, {.width = -1}); }, "width"},
        {design([](DesignSetup& s) { s.targets.clear(); }), "none given"},
        {design([](DesignSetup& s) { s.targets[0].weight = 2; }), "weight"},
        {design([](DesignSetup& s) { s.max_pressure = 1e-5; }), "max-pressure"},
        {design([](DesignSetup& s) { s.model.grid.nodes = 15; }), "nodes"},
        {design([](DesignSetup& s) { s.limits.shortest_wave = 8.1; }), "shortest wave"},
        {design([](DesignSetup& s) { s.model.grid = {32, 0.8, false, 0, 32, 0.8}, s.model.accuracy = 1e-3; }),
         "accuracy"},
        {design([](DesignSetup& s) { s.like = map, scan_waves(s, 3); }),
         "own: the measured surface is a map"},
        {self_affine([](SelfAffine& s) { s.hurst = 1; }), "hurst: 1"},
        {self_affine([](SelfAffine& s) { s.rms_slope = 0; }), "rms slope: 0"},
        {self_affine([](SelfAffine& s) { s.longest = 0.1; }), "cut-offs: 0.1 and 0.1 mm"},
        {[] { bush_gibson_thomas(few_summits, 1, Eigen::VectorXd::Ones(1)); }, "1.5"},
        {[] { greenwood_williamson(no_roughness, 1, Eigen::VectorXd::Ones(1)); }, "moments 1, 0, 1"},
    };
    for (const auto& [call, words] : wrong) {
        INFO(words);
        CHECK_THROWS_AS(call(), InputError);
        CHECK_THROWS_WITH(call(), Catch::Contains(words));
    }
}
