#include "domain/target/like.hpp"

#include "domain/target/recorded.hpp"

namespace rough {

Target even_target(Quantity quantity, const std::string& name, Index points, double last,
                   const std::function<double(double)>& y) {
    Target target;
    target.quantity = quantity;
    target.name = name;
    target.x = Eigen::VectorXd::LinSpaced(points, last / static_cast<double>(points), last);
    target.y = target.x.unaryExpr([&](double x) { return y(x); });
    return target;
}

Target target_like(const Profile& profile, const Model& model, const std::string& name, Quantity quantity,
                   Index points, double last) {
    const Curve curve = curve_of(quantity, respond(profile, model));
    // A load found by a solver ends within its tolerance of the one asked for.
    const bool reaches = last > 0 && last <= curve.to * (1 + 1e-9);
    Target target =
        even_target(quantity, name, points, reaches ? last : curve.to, [&](double x) { return curve.at(x); });
    target.recorded = recorded_model(model);
    return target;
}

} // namespace rough
