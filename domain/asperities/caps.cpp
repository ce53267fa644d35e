#include "domain/asperities/caps.hpp"

#include "domain/contact/interface.hpp"
#include "domain/errors.hpp"

#include <Eigen/Cholesky>

#include <numbers>
#include <optional>

namespace rough {
namespace {

using std::numbers::pi;

constexpr int max_rounds = 100;
constexpr double converged = 1e-14; ///< largest change of an indentation and of the load, relative

/// The linearised contact of the caps that touch: dF = K (dh - G dF), K_i = dF_i/ddelta_i, on their set A.
struct Tangent {
    std::vector<Index> touching; ///< A
    Eigen::VectorXd root;        ///< square roots of K on A
    std::optional<Eigen::LLT<Eigen::MatrixXd>> factor;

    Tangent(const Eigen::VectorXd& stiffness, const Eigen::MatrixXd* influence) {
        for (Index i = 0; i < stiffness.size(); ++i)
            if (stiffness[i] > 0) touching.push_back(i);
        root = stiffness(touching).cwiseSqrt();
        if (!influence) return;
        Eigen::MatrixXd matrix = root.asDiagonal() * (*influence)(touching, touching) * root.asDiagonal();
        matrix.diagonal().array() += 1;
        factor.emplace(matrix);
        if (factor->info() != Eigen::Success)
            throw NotConverged("asperities: the spots are too near to each other to act as point loads; "
                               "increase the pitch");
    }
    /// dF on A for changes of the heights on A: (1/K + G)^-1 v.
    Eigen::VectorXd forces(const Eigen::VectorXd& v) const {
        const Eigen::VectorXd scaled = root.cwiseProduct(v);
        return root.cwiseProduct(factor ? Eigen::VectorXd(factor->solve(scaled)) : scaled);
    }
    /// dF on A if the plane moves by 1 towards the base.
    Eigen::VectorXd unit_forces() const { return forces(Eigen::VectorXd::Ones(root.size())); }
};

/// dF_i/ddelta_i = 2 E* sqrt(R_i delta_i), N/mm.
Eigen::VectorXd stiffnesses(const Caps& caps, const Eigen::VectorXd& indentation, double modulus) {
    return 2 * modulus * (caps.radii.array() * indentation.array().max(0)).sqrt();
}

/// F_i = (4/3) E* sqrt(R_i) delta_i^(3/2), N.
Eigen::VectorXd forces(const Caps& caps, const Eigen::VectorXd& indentation, double modulus) {
    return stiffnesses(caps, indentation, modulus).cwiseProduct(indentation) * (2.0 / 3);
}

} // namespace

Grid grid_of(const CapArray& array) {
    return {.nodes = std::min<Index>(128, 16 * array.columns),
            .length = array.pitch * static_cast<double>(array.columns),
            .periodic = true,
            .rows = std::min<Index>(128, 16 * array.rows),
            .width = array.pitch * static_cast<double>(array.rows)};
}

CapContact::CapContact(const CapArray& array, double effective_modulus, CapModel model) : modulus_(effective_modulus) {
    if (model == CapModel::independent) return;
    Eigen::MatrixXd influence = Eigen::MatrixXd::Zero(array.caps(), array.caps());
    for (Index i = 0; i < array.caps(); ++i)
        for (Index j = 0; j < i; ++j)
            influence(i, j) = influence(j, i) =
                1 / (pi * modulus_ * std::hypot(array.x(i) - array.x(j), array.y(i) - array.y(j)));
    influence_ = std::make_shared<const Eigen::MatrixXd>(std::move(influence));
}

CapState CapContact::at_load(const Caps& caps, double load, const CapState* start) const {
    if (start) return solve(caps, load, start->plane, start);
    if (influence_) { // one cap's plane would be far too deep for many caps
        const CapState alone = CapContact(caps.array, modulus_, CapModel::independent).at_load(caps, load);
        return solve(caps, load, alone.plane, &alone);
    }
    const double deepest = std::pow(0.75 * load / (modulus_ * std::sqrt(caps.radii.minCoeff())), 2.0 / 3);
    return solve(caps, load, caps.heights.maxCoeff() - deepest, nullptr);
}

CapState CapContact::at_plane(const Caps& caps, double plane, const CapState* start) const {
    return solve(caps, 0, plane, start);
}

/// Newton's method on the indentations, and with a load also on the plane. The residual of each cap is
/// delta_i + plane + sum_j G_ij F_j - h_i. A step that does not lower the largest residual is halved.
CapState CapContact::solve(const Caps& caps, double load, double plane, const CapState* start) const {
    struct State {
        double plane;
        Eigen::VectorXd depth, force, residual;
        double error; ///< largest relative residual
    };
    const Eigen::MatrixXd* influence = influence_.get();
    const double scale = std::max(caps.heights.maxCoeff() - plane, 1e-300);
    const auto state_at = [&](const Eigen::VectorXd& depth, double at_plane) {
        State state{at_plane, depth, forces(caps, depth, modulus_), {}, 0};
        state.residual = depth.array() + at_plane - caps.heights.array();
        if (influence) state.residual.noalias() += *influence * state.force;
        state.error = std::max(state.residual.cwiseAbs().maxCoeff() / scale,
                               load > 0 ? std::abs(state.force.sum() / load - 1) : 0.0);
        return state;
    };
    State now = start && influence ? state_at(start->indentation.array() + start->plane - plane, plane)
                                   : state_at(caps.heights.array() - plane, plane);
    for (int round = 0;; ++round) {
        const Tangent tangent(stiffnesses(caps, now.depth, modulus_), influence);
        const Eigen::VectorXd unit = tangent.unit_forces();
        const double stiffness = unit.sum();
        const auto result = [&] {
            const Eigen::VectorXd area = pi * caps.radii.array() * now.depth.array().max(0);
            return CapState{now.plane, now.depth, now.force, area, stiffness};
        };
        if (now.error <= converged || round == max_rounds) return result();
        Eigen::VectorXd change = tangent.forces(-now.residual(tangent.touching));
        double rise = 0; // change of the plane
        if (load > 0 && stiffness > 0) {
            rise = (change.sum() - (load - now.force.sum())) / stiffness;
            change -= rise * unit;
        }
        Eigen::VectorXd step = -now.residual.array() - rise;
        if (influence) step.noalias() -= (*influence)(Eigen::all, tangent.touching) * change;
        State next = now;
        for (double share = 1; !(next.error < now.error) && share > 4e-4; share /= 2)
            next = state_at(now.depth + share * step, now.plane + share * rise);
        if (next.error < now.error)
            now = std::move(next);
        else if (now.error <= 1e-11) // as near as rounding allows
            return result();
        else
            throw NotConverged("asperities: Newton's method stops at a relative residual of " + line_of(now.error) +
                               "; increase the pitch");
    }
}

CapSlopes CapContact::slopes(const Caps& caps, const CapState& state) const {
    const Eigen::VectorXd& depth = state.indentation;
    const Eigen::VectorXd k = stiffnesses(caps, depth, modulus_);
    const Tangent tangent(k, influence_.get());
    const auto& at = tangent.touching;
    const Eigen::ArrayXd K = k(at), R = caps.radii(at), d = depth(at), F = state.force(at);
    const Eigen::ArrayXd by_radius = F / (2 * R) / K; // (dF_i/dR_i)/K_i at a fixed indentation
    const auto slope = [&](const Eigen::ArrayXd& by_forces, const Eigen::ArrayXd& direct) {
        // A quantity q with dq = by_forces' dF + direct' dR, and dF = (1/K + G)^-1 (dh + by_radius dR).
        const Eigen::VectorXd adjoint = tangent.forces(by_forces.matrix());
        CapSlope all{Eigen::VectorXd::Zero(depth.size()), Eigen::VectorXd::Zero(depth.size())};
        all.by_heights(at) = adjoint;
        all.by_radii(at) = adjoint.array() * by_radius + direct;
        return all;
    };
    const Eigen::ArrayXd none = Eigen::ArrayXd::Zero(K.size());
    const Eigen::ArrayXd unit = tangent.unit_forces();
    // ddelta = dF/K - by_radius dR. The stiffness 1' (1/K + G)^-1 1 changes by sum unit^2 dK/K^2, and
    // dK/K = (ddelta/delta + dR/R)/2.
    const Eigen::ArrayXd share = unit.square() / (2 * K);
    return {slope(none + 1, none), slope(pi * R / K, pi * d - pi * R * by_radius),
            slope(share / (d * K), share * (1 / R - by_radius / d))};
}

double hertz_area(double force, double radius, double effective_modulus) {
    return pi * std::pow(0.75 * force * radius / effective_modulus, 2.0 / 3);
}

Profile map_of(const Caps& caps, double nodes, bool spheres, double depth) {
    const CapArray& array = caps.array;
    const auto half = static_cast<Index>(std::sqrt(nodes / static_cast<double>(array.caps())) / 2 - 0.5);
    const Index each = 2 * std::max<Index>(half, 1) + 1; // per pitch, so that a node is at each summit
    const double spacing = array.pitch / static_cast<double>(each), base = caps.heights.minCoeff() - depth;
    Profile map{Eigen::VectorXd(array.caps() * each * each), spacing, array.rows * each, spacing};
    const Index columns = array.columns * each;
    for (Index j = 0; j < map.rows; ++j)
        for (Index i = 0; i < columns; ++i) {
            const Index cap = j / each * array.columns + i / each;
            const double x = (static_cast<double>(i) + 0.5) * spacing - array.x(cap),
                         y = (static_cast<double>(j) + 0.5) * spacing - array.y(cap), square = x * x + y * y,
                         radius = caps.radii[cap];
            const double below = !spheres                   ? square / (2 * radius)
                                 : square < radius * radius ? square / (radius + std::sqrt(radius * radius - square))
                                                            : HUGE_VAL;
            map.heights[j * columns + i] = std::max(caps.heights[cap] - below, base);
        }
    return map;
}

std::vector<MeshedCaps> pressed_on_mesh(const Caps& caps, double effective_modulus, const std::vector<double>& at,
                                        bool loads, double nodes, const ContactOptions& given) {
    const Profile map = map_of(caps, nodes, false, HUGE_VAL);
    const Extent shape = map.shape();
    const double cell = map.spacing * map.spacing;
    const Index each = shape.columns / caps.array.columns;
    const auto cap_at = [&](Index node) {
        return node / shape.columns / each * caps.array.columns + node % shape.columns / each;
    };
    const double nominal = caps.array.nominal_area();
    const Body body{.kernel = Kernel::free, .effective_modulus = effective_modulus};
    ContactOptions options = given;
    options.states = true;
    std::vector<double> pressures = at;
    for (double& pressure : pressures) pressure /= nominal;
    const ContactCurve curve =
        loads ? solve_contact_at_pressures(map, body, pressures, options) : solve_contact(map, body, at, options);
    std::vector<MeshedCaps> all;
    for (std::size_t s = 0; s < at.size(); ++s) {
        const auto& [contact, pressure, tangent] = curve.states[s];
        MeshedCaps one;
        one.load = curve.steps[s].pressure * nominal;
        one.force = one.area = one.area_low = one.area_high = Eigen::VectorXd::Zero(caps.array.caps());
        one.approach = curve.steps[s].displacement;
        one.stiffness = curve.steps[s].tangent_stiffness * nominal;
        one.kkt_residual = curve.steps[s].kkt_residual;
        for (std::size_t n = 0; n < contact.size(); ++n)
            one.force[cap_at(contact[n])] += pressure[static_cast<Index>(n)] * cell;
        Eigen::ArrayXi touches = Eigen::ArrayXi::Zero(map.nodes());
        touches(contact) = 1;
        for (Index node = 0; node < map.nodes(); ++node) {
            int around = 0;
            each_neighbour(node, shape, false, [&](Index other) { around += touches[other]; });
            one.area_low[cap_at(node)] += touches[node] && around == 4 ? cell : 0;
            one.area_high[cap_at(node)] += touches[node] || around > 0 ? cell : 0;
        }
        for (Index cap = 0; cap < one.force.size(); ++cap)
            one.area[cap] = hertz_area(one.force[cap], caps.radii[cap], effective_modulus);
        all.push_back(std::move(one));
    }
    return all;
}

} // namespace rough
