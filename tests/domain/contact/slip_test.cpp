#include "domain/contact/kernel.hpp"
#include "domain/errors.hpp"
#include "domain/response/curve.hpp"
#include "tests/domain/contact/oracle.hpp"
#include "tests/domain/contact/scenes.hpp"

#include <Eigen/Dense>

#include <numbers>

using namespace rough;

namespace {

using std::numbers::pi;
using DenseMatrix = Eigen::MatrixXd;

constexpr double friction = 0.3;

/// 0.8 mm long, 8 um high.
Profile wavy(Index nodes, bool periodic) {
    return sampled({nodes, 0.8, periodic}, [](double x) {
        const double t = 2 * pi * x / 0.8;
        return 2e-3 * std::cos(t + 0.3) + 1e-3 * std::cos(3 * t + 1) + 5e-4 * std::cos(7 * t);
    });
}

Body on_rigid(double thickness, double modulus, double nu) {
    Body body{Kernel::periodic, effective_modulus(modulus, nu)};
    body.layering = {{{thickness, modulus, nu}}, true, nu};
    return body;
}

Body strip(double width, double modulus, double nu) {
    Body body{Kernel::strip, effective_modulus(modulus, nu), std::nullopt, width};
    body.layering.poissons_ratio = nu;
    return body;
}

/// Tangential influence numbers, mm/MPa, by printed formulas. A layer on a rigid base: u/p over 2/(E* q) is
/// [(3 - 4 nu) sinh 2s + 2 s]/[...] with the denominator under pressure. A strip: 1/r + nu/(1 - nu) x^2/r^3
/// (Cerruti) integrated over patches, by Gauss's rule along x.
DenseMatrix tangential_matrix(const Profile& profile, const Body& body) {
    const Index n = profile.nodes();
    const double dx = profile.spacing;
    Eigen::VectorXd h = Eigen::VectorXd::Zero(n);
    if (body.kernel == Kernel::periodic) {
        const Layer& layer = body.layering.layers[0];
        const double nu = layer.poissons_ratio, length = dx * static_cast<double>(n);
        for (Index k = 0; k < n; ++k) {
            const double q = 2 * pi * static_cast<double>(std::min(k, n - k)) / length, s = q * layer.thickness,
                         full = (3 - 4 * nu) * std::cosh(2 * s) + 2 * s * s + 5 - 12 * nu + 8 * nu * nu,
                         wave = k == 0 ? layer.thickness * 2 * (1 + nu) / layer.modulus
                                       : 2 * (1 - nu * nu) / (layer.modulus * q) *
                                             ((3 - 4 * nu) * std::sinh(2 * s) + 2 * s) / full;
            for (Index j = 0; j < n; ++j)
                h[j] += wave / static_cast<double>(n) *
                        std::cos(2 * pi * static_cast<double>(j * k % n) / static_cast<double>(n));
        }
    } else {
        const double b = *body.strip_width / 2, nu = body.layering.poissons_ratio;
        constexpr int parts = 4000; // half an element has these, graded towards the node
        for (Index j = 0; j < n; ++j)
            for (int m = 0; m < parts; ++m) {
                const double v = (m + 0.5) / parts, t = 0.5 * v * v, weight = v / parts; // t from 0 to 1/2
                for (const double x : {(static_cast<double>(j) + t) * dx, (static_cast<double>(j) - t) * dx})
                    h[j] += weight * dx / (pi * body.effective_modulus) *
                            (2 * std::asinh(b / std::abs(x)) + nu / (1 - nu) * 2 * b / std::hypot(x, b));
            }
    }
    return DenseMatrix::NullaryExpr(n, n, [&](Index i, Index j) { return h[std::abs(i - j)]; });
}

/// The tractions |q| <= limit at a tangential displacement, by relaxation of node after node.
Eigen::VectorXd relaxed(const DenseMatrix& matrix, const Eigen::VectorXd& limit, double displacement) {
    Eigen::VectorXd q = Eigen::VectorXd::Zero(limit.size());
    for (double change = 1; change > 1e-14 * limit.maxCoeff();) {
        change = 0;
        for (Index i = 0; i < q.size(); ++i) {
            const double free = q[i] + (displacement - matrix.row(i).dot(q)) / matrix(i, i),
                         next = std::clamp(free, -limit[i], limit[i]);
            change = std::max(change, std::abs(next - q[i]));
            q[i] = next;
        }
    }
    return q;
}

const Body cases[] = {on_rigid(0.05, 10, 0.3), on_rigid(0.03, 2, 0.5), strip(0.02, 0.75, 0.5), strip(0.3, 1, 0.2)};

} // namespace

TEST_CASE("partial slip of strips and layers is that of dense tangential influence numbers") {
    for (const Body& body : cases) {
        const Profile profile = wavy(60, body.kernel == Kernel::periodic);
        const Response normal = respond(profile, body, {.steps = 4, .reach = 0.4});
        const PartialSlip slip = partial_slip(profile, body, normal, friction);
        const ContactState state = solve_contact(profile, body, {normal.displacement[3]}, {.states = true}).states[0];
        const DenseMatrix matrix = tangential_matrix(profile, body)(state.nodes, state.nodes);
        const Eigen::VectorXd limit = friction * state.pressure;
        const double cell = normal.pressure[3] / state.pressure.sum();
        CAPTURE(body.strip_width.value_or(0), body.layering.poissons_ratio);
        CHECK(slip.displacement[4] == Approx((matrix * limit).maxCoeff()).epsilon(1e-7));
        CHECK(slip.traction[4] == Approx(friction * normal.pressure[3]).epsilon(1e-9));
        CHECK(slip.stiffness[0] ==
              Approx(cell * matrix.llt().solve(Eigen::VectorXd::Ones(limit.size())).sum()).epsilon(1e-6));
        for (Index k = 0; k < 4; ++k)
            CHECK(slip.traction[k] == Approx(cell * relaxed(matrix, limit, slip.displacement[k]).sum()).epsilon(1e-7));
        CHECK((slip.stick_fraction[0] == 1 && slip.stick_fraction[4] == 0 && slip.stiffness[4] == 0));
    }
}

TEST_CASE("no contact set on a layer is stiffer along the line than G/t") {
    const Body body = on_rigid(0.05, 10, 0.3);
    const Profile profile = wavy(128, true);
    const Response normal = respond(profile, body, {.steps = 3, .reach = 0.9});
    const PartialSlip slip = partial_slip(profile, body, normal, friction);
    CHECK(slip.stiffness[0] < 10 / 2.6 / 0.05);
    CHECK(slip.stiffness[0] > 0.3 * 10 / 2.6 / 0.05);
}

TEST_CASE("slip on thick layers and wide strips is that of the half-plane") {
    const Profile profile = wavy(96, true);
    const Body plane{Kernel::periodic, effective_modulus(10, 0.3)};
    Body layered = plane; // as thick as 4 lengths, and of the half-space's material
    layered.layering = {{{3.2, 10, 0.3}}, false, 0.3};
    const Response normal = respond(profile, plane, {.steps = 6, .reach = 0.5}),
                   other = respond(profile, layered, {.steps = 6, .reach = 0.5});
    const PartialSlip known = partial_slip(profile, plane, normal, friction),
                      found = partial_slip(profile, layered, other, friction);
    for (Index k = 0; k <= 6; ++k) {
        CHECK(found.displacement[k] == Approx(known.displacement[k]).epsilon(1e-6));
        CHECK(found.traction[k] == Approx(known.traction[k]).epsilon(1e-6));
        CHECK(found.stick_fraction[k] == Approx(known.stick_fraction[k]));
    }
    // A strip's column differs from that of the half-plane by a constant if it is much wider than the line.
    UnitBody wide{.kernel = Kernel::strip, .strip_width = 1e6, .traction = Traction::tangential},
        free{.kernel = Kernel::free, .datum = 100};
    wide.layering.poissons_ratio = 0.3;
    const Eigen::VectorXd strip_column = influence_column(wide, {64}), column = influence_column(free, {64});
    CHECK(((strip_column.array() - strip_column[0]) - (column.array() - column[0])).abs().maxCoeff() < 1e-6);
}

TEST_CASE("tangential compliance of layers has its closed forms and limits") {
    const double nu = 0.3, own = effective_modulus(7, nu);
    const Layering rigid{{{1, 7, nu}}, true};
    const auto ratio = [&](double s) {
        return relative_compliance(rigid, own, s, Traction::tangential) / relative_compliance(rigid, own, s);
    };
    CHECK(ratio(1e-3) == Approx(2 * (1 - nu) / (1 - 2 * nu)).epsilon(1e-4));
    CHECK(ratio(30) == Approx(1).epsilon(1e-10));
    CHECK(mean_compliance(rigid, 1, Traction::tangential) == Approx(2.6 / 7));
    CHECK(relative_compliance({{{0.2, 7, nu}, {0.4, 7, nu}}, false, nu}, own, 2, Traction::tangential) ==
          Approx(1).epsilon(1e-10));
}

TEST_CASE("partial slip of a map with layers is refused") {
    Profile map{Eigen::VectorXd::LinSpaced(64, 0, 1e-3), 0.1, 8, 0.1};
    const Body body = on_rigid(0.05, 10, 0.3);
    CHECK_THROWS_WITH(partial_slip(map, body, respond(map, body, {.steps = 2, .reach = 0.3}), friction),
                      Catch::Contains("a map with layers"));
}
