#include "domain/contact/kernel.hpp"
#include "domain/contact/names.hpp"
#include "domain/contact/solve.hpp"
#include "domain/errors.hpp"
#include "domain/response/model.hpp"

#include <catch2/catch.hpp>

using namespace rough;

namespace {

/// Two waves on 2 mm.
Profile two_mm() {
    Profile profile{Eigen::VectorXd(201), 0.01};
    for (Index i = 0; i < profile.nodes(); ++i)
        profile.heights[i] =
            std::cos(0.05 * static_cast<double>(i)) + 0.3 * std::sin(0.21 * static_cast<double>(i));
    return profile;
}

} // namespace

TEST_CASE("a body left open is completed for the profile's own length, to the bit", "[contact]") {
    const Profile profile = two_mm();
    for (const Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip}) {
        Body open{kernel}, stated{kernel};
        stated.datum = kernel == Kernel::free ? 0.01 * 200 : 0;
        stated.strip_width = kernel == Kernel::strip ? 0.01 * 200 / 511 : 0;
        const Response left = respond(profile, open);
        const Response right = respond(profile, stated, {20, kernel == Kernel::periodic ? 0.95 : 1});
        CHECK(left.pressure == right.pressure);
        CHECK(left.tangent_stiffness == right.tangent_stiffness);
        Model model;
        model.body.kernel = kernel;
        model.grid = {201, kernel == Kernel::periodic ? 0.01 * 201 : 0.01 * 200};
        CHECK(respond(profile, model).pressure == left.pressure);
        CHECK(completed(model).grid.wraps == (kernel == Kernel::periodic));
    }
}

TEST_CASE("a response to a pressure keeps the length's own datum while it looks for it", "[contact]") {
    Profile fine{Eigen::VectorXd(1025), 0.004}; // found by way of a fourth of the nodes, which are shorter
    for (Index i = 0; i < fine.nodes(); ++i)
        fine.heights[i] = std::cos(0.013 * static_cast<double>(i));
    Body stated;
    stated.datum = 0.004 * 1024;
    CHECK(displacement_at_pressure(fine, {}, 0.01) == displacement_at_pressure(fine, stated, 0.01));
}

TEST_CASE("what cannot be a body is refused by the name of its value", "[contact]") {
    const auto refusal = [](Body body) {
        try {
            respond(two_mm(), body);
        } catch (const InputError& error) {
            return error.about + "|" + error.what();
        }
        return std::string();
    };
    Body near, flat, soft;
    near.datum = 0.5;
    flat.kernel = Kernel::strip;
    flat.strip_width = -1;
    soft.effective_modulus = 0;
    CHECK(refusal(near).starts_with(
        "datum|datum: 0.5 mm given, expected more than 0.5025 mm, (L + spacing)/4"));
    CHECK(refusal(flat).starts_with("strip width|strip width: -1 mm given"));
    CHECK(refusal(soft).starts_with("modulus|modulus: 0 MPa"));
}

TEST_CASE("a datum is refused up to a quarter of the length and a spacing, and taken beyond", "[contact]") {
    const Profile profile = two_mm();
    const double limit = datum_limit(profile);
    CHECK(limit == Approx(2.01 / 4));
    CHECK_THROWS_AS(solve_contact(profile, {Kernel::free, 1, limit * (1 - 1e-12), 0}, {0.01}), InputError);
    CHECK(solve_contact(profile, {Kernel::free, 1, limit * (1 + 1e-6), 0}, {0.01}).steps[0].pressure > 0);
}

TEST_CASE("kernels and solvers are known by name both ways", "[contact]") {
    for (const std::string& name : kernel_names())
        CHECK(name_of(kernel_named(name)) == name);
    for (const std::string& name : solver_names())
        CHECK(name_of(solver_named(name)) == name);
    CHECK(solver_named("polonsky-keer") == Solver::polonsky_keer);
    CHECK(kernel_named("strip") == Kernel::strip);
    CHECK_THROWS_WITH(kernel_named("fre"), "kernel: 'fre' given, expected free, periodic or strip");
}
