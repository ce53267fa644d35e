#include "domain/target/like.hpp"

#include "domain/target/recorded.hpp"

namespace rough {

Goal even_goal(Quantity quantity, const std::string& name, Index points, double last,
               const std::function<double(double)>& y) {
    Goal goal;
    goal.quantity = quantity;
    goal.name = name;
    goal.x = Eigen::VectorXd::LinSpaced(points, last / static_cast<double>(points), last);
    goal.y = goal.x.unaryExpr([&](double x) { return y(x); });
    return goal;
}

Goal goal_like(const Profile& profile, const Model& model, const std::string& name, Quantity quantity,
               Index points, double last) {
    const Curve curve = curve_of(quantity, respond(profile, model));
    // A load found by a solver ends within its tolerance of the one asked for.
    const bool reaches = last > 0 && last <= curve.to * (1 + 1e-9);
    Goal goal =
        even_goal(quantity, name, points, reaches ? last : curve.to, [&](double x) { return curve.at(x); });
    goal.recorded = recorded_model(model);
    return goal;
}

} // namespace rough
