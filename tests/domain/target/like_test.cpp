#include "domain/errors.hpp"
#include "domain/problem/setup.hpp"
#include "tests/catch.hpp"

using namespace rough;

namespace {

Profile waves(Index nodes = 128) {
    Profile profile{Eigen::VectorXd(nodes), 0.01};
    for (Index i = 0; i < profile.nodes(); ++i)
        profile.heights[i] = std::cos(0.1 * double(i)) + 0.2 * std::cos(0.37 * double(i));
    return profile;
}

Model model_of(const Profile& profile) {
    return completed({.grid = {profile.nodes(), profile.spacing * double(profile.nodes() - 1)}});
}

} // namespace

TEST_CASE("a target like a profile is the profile's curve at even points") {
    const Profile profile = waves();
    const Model model = model_of(profile);
    const Curve curve = secant_stiffness(respond(profile, model));
    const Target target = target_like(profile, model, "waves", Quantity::stiffness, {5});
    CHECK(similarity(target, curve) == 1);
    CHECK(target.points() == 5);
    CHECK(target.x[0] == Approx(curve.to / 5));
    CHECK(target.last() == curve.to);
    CHECK(target_like(profile, model, "waves", Quantity::stiffness, {5, 0.25 * curve.to}).last() == 0.25 * curve.to);
    CHECK(target_like(profile, model, "waves", Quantity::stiffness, {5, 2 * curve.to}).last() == curve.to);
    const Target band = target_like(profile, model, "waves", Quantity::stiffness, {5}, Resolution::on);
    const Eigen::VectorXd x = PointPlacement{.count = 4, .first = 1e-3, .logarithmic = true}.up_to(1);
    CHECK(x.isApprox(Eigen::Vector4d(1e-3, 1e-2, 0.1, 1), 1e-14));
    CHECK_THROWS_WITH((PointPlacement{.first = 2}.up_to(1)), Catch::Contains("not between 0 and the last"));
    CHECK((band.upper - band.lower).cwiseQuotient(band.y).maxCoeff() < 0.02);
}

TEST_CASE("a profile meets its response as a target, in few load steps as well") {
    for (int seed = 0; seed < 40; ++seed) {
        Profile profile = waves(); // long waves: stiffness jumps when the second hill touches
        for (Index i = 0; i < profile.nodes(); ++i) {
            const double x = static_cast<double>(i) / 20;
            profile.heights[i] =
                std::cos(x + seed) + 0.7 * std::cos(1.4 * x + 2.7 * seed) + 0.5 * std::cos(2 * x + 0.9 * seed);
        }
        Model model = model_of(profile);
        model.loading.steps = 2 + seed % 3;
        for (const Quantity quantity : {Quantity::stiffness, Quantity::interface_stiffness}) {
            CAPTURE(seed, name_of(quantity));
            const Target target = target_like(profile, model, "waves", quantity);
            CHECK_NOTHROW(validate(target));
            CHECK(similarity(target, curve_of(quantity, respond(profile, model))) == 1);
        }
    }
}

TEST_CASE("a design like a profile has more nodes if its contact fractions need them") {
    const auto nodes_of = [&](Index nodes, std::vector<Quantity> quantities, Index points) {
        const Profile profile = waves(nodes);
        const DesignSetup setup = design_like(profile, model_of(profile), "p", quantities, points, {});
        CHECK(setup.targets.size() == quantities.size());
        return std::pair(setup.model.grid.nodes, setup.targets.back().y[0]);
    };
    CHECK(nodes_of(2500, {Quantity::stiffness}, 10).first == 512);
    CHECK(nodes_of(5000, {Quantity::area_at_pressure}, 10).first == 4096);
    for (const Index points : {3, 40}) { // 32 nodes in contact at the first point
        const auto [nodes, first] = nodes_of(600, {Quantity::stiffness, Quantity::area_at_pressure}, points);
        CHECK(nodes == static_cast<Index>(std::clamp(32 / first, 600., 4096.)));
    }
}

TEST_CASE("only a target of interface stiffness carries over to other datums and lengths") {
    const Profile profile = waves();
    Model model = model_of(profile);
    const Target target = target_like(profile, model, "waves.csv", Quantity::interface_stiffness);
    CHECK(carried_over(target, model).empty());
    model.body.datum = 5;
    model.grid.length = 2;
    CHECK_NOTHROW(expect_recorded(target, model));
    CHECK(in_words(carried_over(target, model)) == "length_mm 1.27 (here 2), datum_mm 1.27 (here 5)");
    model.body.effective_modulus = 2;
    CHECK(in_words(recorded_differences(target, model)) == "effective_modulus_MPa 1 (here 2)");
    const Target whole = target_like(profile, model_of(profile), "waves.csv", Quantity::stiffness);
    CHECK(carried_over(whole, model).empty());
    CHECK(recorded_differences(whole, model).size() == 3);
}

TEST_CASE("a target of interface stiffness up to full contact is refused") {
    Profile bowl{1e-6 * Eigen::VectorXd::LinSpaced(64, -1, 1).cwiseAbs2(), 1.0 / 63};
    Model model = model_of(bowl);
    model.grid.length = 1;
    model.loading.to_displacement = 1e-3;
    CHECK_THROWS_WITH(target_like(bowl, model, "bowl", Quantity::interface_stiffness),
                      Catch::Contains("bowl") && Catch::Contains("full contact"));
    CHECK_NOTHROW(target_like(bowl, model, "bowl", Quantity::stiffness));
    model.loading.to_displacement = 1e-7;
    CHECK_NOTHROW(target_like(bowl, model, "bowl", Quantity::interface_stiffness));
}
