#include "domain/accuracy/respond_within.hpp"
#include "domain/contact/datum.hpp"
#include "domain/contact/solve.hpp"
#include "domain/design/scan_waves.hpp"
#include "domain/design/shape_to_waves.hpp"
#include "domain/design/statistical.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/genome_json.hpp"
#include "domain/problem/response.hpp"
#include "domain/profile/roughness.hpp"
#include "domain/response/response.hpp"
#include "domain/target/like.hpp"
#include "domain/theory/random_surface.hpp"
#include "domain/theory/theory.hpp"
#include "tests/folder.hpp"

#include <catch2/catch.hpp>

#include <functional>

using namespace rough;

namespace {

Profile line_of(std::initializer_list<double> heights, double spacing = 0.1) {
    return {Eigen::Map<const Eigen::VectorXd>(heights.begin(), static_cast<Index>(heights.size())), spacing};
}

} // namespace

TEST_CASE("what a caller in code gives wrongly is refused with its value and what was expected") {
    const Profile good = line_of({0, 1, 0.5, 0.2}), map{Eigen::VectorXd::Constant(144, 2), 0.1, 12, 0.1};
    const Body body, periodic{Kernel::periodic};
    const tests::Folder folder;
    const SelfAffine rough{0.8, 0.5, 0.1, 0.05};
    const auto changed = [&](auto change) {
        SelfAffine all = rough;
        change(all);
        return all;
    };
    const auto press = [](const Profile& profile, const Body& on, std::vector<double> displacements) {
        return [=] { solve_contact(profile, on, displacements); };
    };
    const double huge = std::numeric_limits<double>::max(), nan = std::nan("");
    const std::vector<std::pair<std::function<void()>, std::string>> wrong{
        {press(line_of({1}), body, {0.1}), "a profile of 1 node(s) was given, at least 2 are expected"},
        {press(line_of({0, 1}, 0), body, {0.1}),
         "node spacing 0 mm was given, a positive finite length is expected"},
        {press(line_of({-huge, huge}), body, {0.1}), " mm, a range that fits double precision is expected"},
        {press(line_of({0, nan}), body, {0.1}), " mm at node 1, a finite height is expected"},
        {press(good, body, {0.2, 0.1}), "displacement 0.1 mm was given after 0.2"},
        {press(good, periodic, {0.9}), "displacement 0.9 mm was given, at most that of full contact, 0.575"},
        {press(good, Body{Kernel::free, huge}, {0.5}), "whose response fits double precision are expected"},
        {[&] {
             solve_contact_at_pressures(good, body, {2e-3, 1e-3});
         },
         "mean pressure 0.001 MPa was given after 0.002"},
        {[&] { solve_contact_at_pressures(good, body, {nan}); }, "nan MPa was given after 0"},
        {[&] { with_datum(solve_contact(good, periodic, {0.1}), good, periodic, 1); },
         "a datum distance was given, none is expected: only the free half-plane has one"},
        {[&] {
             roughness(line_of({0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1}), 0.6);
         },
         "7 nodes in whole sections, expected at least 10"},
        {[&] {
             roughness(line_of({0, 1e-90, 0, 1e-90, 0, 0, 1e-90, 0, 1e-90, 0, 1e-90, 0}));
         },
         "roughness: its parameters do not fit double precision"},
        {[&] {
             step_displacements(line_of({0, nan}), body, {.steps = 2}, {});
         },
         "profile: a height is not finite"},
        {[&] { scaled(respond(good, body, {.steps = 2}), huge); },
         ", expected a factor whose pressures and displacements fit double precision"},
        {[&] {
             DesignSetup setup;
             setup.max_pressure = huge;
             eq_11(setup, scaled(respond(good, body, {.steps = 2}), 1e-6));
         },
         " MPa, expected two whose ratio fits double precision"},
        {[&] {
             DesignSetup setup;
             setup.targets = {target_like(good, {}, "good", Quantity::stiffness, 2)};
             setup.max_pressure = 0;
             validate(setup);
         },
         "max-pressure: 0 MPa given, expected more than 0"},
        {[&] { read_genome(folder.write("list.json", "{\"series\": [3]}")); }, "3 given, expected an object"},
        {[&] { read_genome_file(folder.write("length.json", "{\"length_mm\": -2}")); }, "length_mm is -2"},
        {[&] {
             Model model;
             model.body.hardness = 1;
             respond_within(good, model, 0.01);
         },
         "accuracy: given with a hardness, expected one of them"},
        {[&] { shaped_as(good, {Series{.lambda = 0.1, .chromosomes = {}}}, 0.2); },
         "series: its longest wave is 0.1"},
        {[&] { areal_parameters(map); }, "areal parameters: the map is constant, expected a rough one"},
        {[&] { random_surface(changed([](SelfAffine& s) { s.hurst = 1; })); },
         "hurst: 1 given, expected a number between 0 and 1"},
        {[&] { random_surface(changed([](SelfAffine& s) { s.rms_slope = 0; })); },
         "rms slope: 0 given, expected a number above 0"},
        {[&] { random_surface(changed([](SelfAffine& s) { s.longest = 0.1; })); },
         "cut-offs: 0.1 and 0.1 mm given, expected the longer one first"},
        {[&] {
             realised(
                 changed([](SelfAffine& s) { s.longest = 0.107, s.shortest = 0.101, s.is_area = false; }),
                 {64, 1, true}, 1);
         },
         "self-affine surface: no wave of 0.107 to 0.101"},
        {[&] {
             greenwood_williamson({1, 0, 1}, 1, Eigen::VectorXd::Ones(1));
         },
         "theory: moments 1, 0, 1, expected three above 0"},
        {[&] {
             StatisticalTask task;
             task.target.quantity = Quantity::stiffness;
             task.nodes = 39;
             statistical_design(task, "sample 1 | score", 1);
         },
         "nodes: 39 given, expected at least 40"},
        {[&] {
             DesignSetup setup;
             setup.like = map;
             scan_waves(setup, 3);
         },
         "own: a map given, expected a profile"},
    };
    for (const auto& [call, words] : wrong) {
        INFO(words);
        CHECK_THROWS_AS(call(), InputError);
        CHECK_THROWS_WITH(call(), Catch::Contains(words));
    }
}
