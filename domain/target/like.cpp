#include "domain/target/like.hpp"

#include "domain/errors.hpp"

namespace rough {

namespace {

/// A ratio K_i/K that only rounding next to full contact reaches.
constexpr double nearly_rigid = 1e9;

} // namespace

Target even_target(Quantity quantity, const std::string& name, Index points, double last,
                   const std::function<double(double)>& y) {
    Target target;
    target.quantity = quantity;
    target.name = name;
    target.x = Eigen::VectorXd::LinSpaced(points, last / static_cast<double>(points), last);
    target.y = target.x.unaryExpr([&](double x) { return y(x); });
    return target;
}

std::vector<Target> targets_like(const Profile& profile, const Model& model, const std::string& name,
                                 const std::vector<Quantity>& quantities, Index points, double last,
                                 Resolution resolution) {
    const Response response = respond(profile, model);
    const std::vector<Response> finer = finer_responses(profile, model, response, resolution);
    std::vector<Target> targets;
    for (const Quantity quantity : quantities) {
        const Curve curve = curve_of(quantity, response);
        // A solver finds a load within its tolerance of the requested one.
        const bool reaches = last > 0 && last <= curve.to * (1 + 1e-9);
        Target target = even_target(quantity, name, points, reaches ? last : curve.to,
                                    [&](double x) { return curve.at(x); });
        // The line through the first two secants may fall below 0 before the first one; points there are
        // omitted.
        Index omitted = 0;
        while (omitted + 1 < points && target.y[omitted] <= 0 && target.x[omitted] < curve.x[0])
            ++omitted;
        target.x = target.x.tail(points - omitted).eval();
        target.y = target.y.tail(points - omitted).eval();
        target.recorded = recorded_model(model);
        if (quantity == Quantity::interface_stiffness &&
            target.y.maxCoeff() > nearly_rigid * response.tangent_stiffness.maxCoeff())
            throw InputError(name + ": is in full contact up to " + field_text(target.last()) +
                                 " MPa, which makes the interface stiffness infinite; give a last pressure "
                                 "below full contact",
                             "to");
        if (!finer.empty())
            target.lower = target.upper = target.y;
        for (const Response& other : finer) {
            const Curve of = curve_of(quantity, other);
            const Eigen::VectorXd y = target.x.unaryExpr([&](double x) { return of.at(std::min(x, of.to)); });
            target.lower = target.lower.cwiseMin(y);
            target.upper = target.upper.cwiseMax(y);
        }
        targets.push_back(std::move(target));
    }
    return targets;
}

Target target_like(const Profile& profile, const Model& model, const std::string& name, Quantity quantity,
                   Index points, double last, Resolution resolution) {
    return targets_like(profile, model, name, {quantity}, points, last, resolution).front();
}

} // namespace rough
