#include "tests/domain/contact/oracle.hpp"

#include "domain/contact/kernel.hpp"
#include "domain/errors.hpp"

#include <Eigen/Cholesky>

#include <cmath>
#include <numbers>

namespace rough {
namespace {

using Real = long double;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

constexpr Real pi = std::numbers::pi_v<Real>;

Real flamant(Real r, Real a, Real d) {
    auto F = [d](Real t) { return t == 0 ? 0 : t * std::log(std::abs(t / d)); };
    return -2 / pi * (F(r + a) - F(r - a) - 2 * a);
}

Real love(Real r, Real a, Real b) {
    auto R = [b](Real x) { return std::hypot(b, x); };
    // ln((b + R)/(R - b)) and ln(x + R) with the differences R - b = x^2/(R + b) and R - |x| = b^2/(R + |x|)
    auto side = [&](Real x) { return x == 0 ? 0 : x * 2 * std::log((b + R(x)) / std::abs(x)); };
    auto along = [&](Real x) { return x >= 0 ? std::log(x + R(x)) : 2 * std::log(b) - std::log(R(x) - x); };
    return (side(r + a) - side(r - a) + 2 * b * (along(r + a) - along(r - a))) / pi;
}

/// u/p times E* of a wave of the wavenumber q.
Real compliance(const Body& body, Real q) {
    if (body.layering.layers.empty()) return 2 / q;
    const Layer& layer = body.layering.layers[0];
    const Real nu = layer.poissons_ratio, t = layer.thickness, E = body.effective_modulus;
    if (q == 0) return E * t * (1 + nu) * (1 - 2 * nu) / (layer.modulus * (1 - nu));
    return 2 * E * (1 - nu * nu) / (layer.modulus * q) * layer_on_rigid_base(nu, q * t);
}

Real cosine_sum(const Body& body, Index i, Index j, Extent shape, Real length, Real width) {
    const bool singular = body.layering.layers.empty();
    Real sum = 0;
    for (Index m = 0; m < shape.rows; ++m)
        for (Index k = m == 0 && singular ? 1 : 0; k < shape.columns; ++k) {
            const Real q = 2 * pi *
                           std::hypot(static_cast<Real>(std::min(k, shape.columns - k)) / length,
                                      static_cast<Real>(std::min(m, shape.rows - m)) / width);
            sum += compliance(body, q) *
                   std::cos(2 * pi * static_cast<Real>((i * k) % shape.columns) / static_cast<Real>(shape.columns)) *
                   std::cos(2 * pi * static_cast<Real>((j * m) % shape.rows) / static_cast<Real>(shape.rows));
        }
    return sum / static_cast<Real>(shape.nodes());
}

/// Love (1929) as printed, over a cell of half-sides a and b.
Real love_cell(Real x, Real y, Real a, Real b) {
    const auto s = [](Real X, Real Y) {
        return (X == 0 ? 0 : X * std::asinh(Y / std::abs(X))) + (Y == 0 ? 0 : Y * std::asinh(X / std::abs(Y)));
    };
    return (s(x + a, y + b) - s(x - a, y + b) - s(x + a, y - b) + s(x - a, y - b)) / pi;
}

/// H's entry of two nodes.
struct Influences {
    Vector column;
    Index columns;
    Real operator()(Index i, Index k) const {
        return column[std::abs(i / columns - k / columns) * columns + std::abs(i % columns - k % columns)];
    }
};

/// First column of H for E* = 1, mm/MPa.
Vector influence(const Profile& profile, const Body& given) {
    const Body body = completed(given, profile_length(profile, given.kernel));
    const Extent shape = profile.shape();
    const Real dx = profile.spacing, dy = profile.is_2d() ? profile.row_spacing : 1;
    Vector h(shape.nodes());
    for (Index k = 0; k < shape.nodes(); ++k) {
        const Index i = k % shape.columns, j = k / shape.columns;
        const Real x = static_cast<Real>(i) * dx, y = static_cast<Real>(j) * dy;
        h[k] = body.kernel == Kernel::periodic ? cosine_sum(body, i, j, shape, static_cast<Real>(shape.columns) * dx,
                                                            static_cast<Real>(shape.rows) * dy)
               : profile.is_2d()               ? love_cell(x, y, dx / 2, dy / 2)
               : body.kernel == Kernel::free   ? flamant(x, dx / 2, *body.datum)
                                               : love(x, dx / 2, static_cast<Real>(*body.strip_width) / 2);
    }
    return h;
}

struct Pressed {
    std::vector<Index> nodes;
    Vector pressure;
    Real stiffness = 0;
    Index held = 0;
};

/// H_AA p = rhs and sum H_AA^-1 1
Pressed solve_on(const std::vector<Index>& nodes, const Influences& h, const Vector& goal) {
    const Index m = static_cast<Index>(nodes.size());
    Matrix block(m, m);
    Vector rhs(m);
    for (Index i = 0; i < m; ++i) {
        rhs[i] = goal[nodes[static_cast<std::size_t>(i)]];
        for (Index j = 0; j < m; ++j)
            block(i, j) = h(nodes[static_cast<std::size_t>(i)], nodes[static_cast<std::size_t>(j)]);
    }
    const Eigen::LLT<Matrix> factor(block);
    return {nodes, factor.solve(rhs), factor.solve(Vector::Ones(m)).sum()};
}

Pressed press(const Influences& h, const Vector& goal, Real displacement, bool singular) {
    const Index n = goal.size();
    std::vector<char> in(static_cast<std::size_t>(n), 1);
    if (singular) { // that of all nodes together, of which the lowest cannot be needed
        Index lowest;
        goal.minCoeff(&lowest);
        in[static_cast<std::size_t>(lowest)] = 0;
    }
    for (int round = 0; round < 500; ++round) {
        std::vector<Index> nodes;
        for (Index i = 0; i < n; ++i)
            if (in[static_cast<std::size_t>(i)]) nodes.push_back(i);
        Pressed pressed = solve_on(nodes, h, goal);
        bool converged = true;
        for (std::size_t k = 0; k < nodes.size(); ++k)
            if (!(pressed.pressure[static_cast<Index>(k)] > 0)) {
                in[static_cast<std::size_t>(nodes[k])] = 0;
                converged = false;
            }
        if (!converged) continue;
        for (Index i = 0; i < n; ++i) {
            if (in[static_cast<std::size_t>(i)]) continue;
            Real u = 0;
            for (std::size_t k = 0; k < nodes.size(); ++k)
                u += h(i, nodes[k]) * pressed.pressure[static_cast<Index>(k)];
            if (goal[i] - u > 1e-15L * displacement) {
                in[static_cast<std::size_t>(i)] = 1;
                converged = false;
            }
        }
        if (converged) return pressed;
    }
    throw NotConverged("the oracle's contact set does not converge");
}

Pressed press_capped(const Influences& h, const Vector& goal, Real cap) {
    constexpr Real relaxation = 1.5L;
    const Index n = goal.size();
    Vector p = Vector::Zero(n);
    Real moved = 1;
    for (long sweep = 0; moved > 1e-16L * p.maxCoeff(); ++sweep) {
        if (sweep > 200000) throw NotConverged("the oracle's capped pressures do not converge");
        moved = 0;
        for (Index i = 0; i < n; ++i) {
            Real gap = -goal[i];
            for (Index j = 0; j < n; ++j) gap += h(i, j) * p[j];
            const Real next = std::clamp(p[i] - relaxation * gap / h.column[0], Real(0), cap);
            moved = std::max(moved, std::abs(next - p[i]));
            p[i] = next;
        }
    }
    Pressed pressed;
    std::vector<Index> elastic;
    for (Index i = 0; i < n; ++i) {
        if (p[i] > 0) pressed.nodes.push_back(i);
        if (p[i] > 0 && p[i] < cap) elastic.push_back(i);
    }
    pressed.pressure = p;
    pressed.held = static_cast<Index>(pressed.nodes.size() - elastic.size());
    pressed.stiffness = elastic.empty() ? 0 : solve_on(elastic, h, goal).stiffness;
    return pressed;
}

} // namespace

long double layer_on_rigid_base(long double nu, long double s) {
    return ((3 - 4 * nu) * std::sinh(2 * s) - 2 * s) /
           ((3 - 4 * nu) * std::cosh(2 * s) + 2 * s * s + 5 - 12 * nu + 8 * nu * nu);
}

Oracle consult_oracle(const Profile& profile, const Body& body, const std::vector<double>& displacements) {
    const Influences h{influence(profile, body), profile.shape().columns};
    const Vector heights = profile.heights.cast<Real>();
    const Real share =
        profile.is_2d() ? 1 / static_cast<Real>(elements(profile, body.kernel))
                        : static_cast<Real>(profile.spacing) / static_cast<Real>(profile_length(profile, body.kernel));
    const Real modulus = body.effective_modulus;
    Oracle oracle;
    for (const double displacement : displacements) {
        const Vector goal = (heights.array() - heights.maxCoeff() + static_cast<Real>(displacement)).matrix();
        const Pressed pressed = body.yields() ? press_capped(h, goal, static_cast<Real>(body.hardness) / modulus)
                                              : press(h, goal, displacement, body.relative_to_mean());
        oracle.pressure.push_back(static_cast<double>(modulus * share * pressed.pressure.sum()));
        oracle.tangent_stiffness.push_back(static_cast<double>(modulus * share * pressed.stiffness));
        oracle.contact_nodes.push_back(static_cast<Index>(pressed.nodes.size()));
        oracle.held_nodes.push_back(pressed.held);
        if (body.yields()) {
            oracle.node_pressure.emplace_back();
            for (const Real p : pressed.pressure)
                oracle.node_pressure.back().push_back(static_cast<double>(modulus * p));
        }
    }
    return oracle;
}

} // namespace rough
