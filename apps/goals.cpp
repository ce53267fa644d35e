#include "apps/goals.hpp"

#include "domain/database/setup.hpp"
#include "domain/errors.hpp"
#include "domain/text.hpp"

#include <cmath>

namespace app {

namespace {

void expect_same_model(const rough::Goal& goal, const rough::Model& model) {
    const auto own = recorded_model(model);
    for (const auto& [key, value] : goal.recorded) {
        const auto found = own.find(key);
        if (found == own.end())
            continue;
        const bool number = key != "kernel";
        const bool same = number ? std::abs(rough::number_from(value, goal.name + ": " + key) -
                                            rough::number_from(found->second, key)) <=
                                       1e-9 * std::abs(rough::number_from(found->second, key))
                                 : value == found->second;
        if (!same)
            throw rough::InputError(goal.name + ": recorded with " + key + " " + value + ", the model has " +
                                    found->second + ", expected the same: the target depends on it");
    }
}

} // namespace

rough::Goal goal_from(const Settings& settings, const std::string& file, const rough::Model& model) {
    // C = 2 K/(E* (rho1 + rho2))
    const double conductance_to_stiffness =
        settings.has("resistivity") ? 0.5 * model.body.effective_modulus * settings.positive("resistivity")
                                    : 0;
    rough::Goal goal = rough::read_goal(file, conductance_to_stiffness);
    expect_same_model(goal, model);
    return goal;
}

rough::Goal even_goal(rough::Quantity quantity, const std::string& name, rough::Index points, double last,
                      const std::function<double(double)>& y) {
    rough::Goal goal;
    goal.quantity = quantity;
    goal.name = name;
    goal.x = Eigen::VectorXd::LinSpaced(points, last / static_cast<double>(points), last);
    goal.y = goal.x.unaryExpr([&](double x) { return y(x); });
    return goal;
}

std::map<std::string, std::string> recorded_model(const rough::Model& model) {
    const rough::Fields fields = rough::fields(model);
    std::map<std::string, std::string> recorded(fields.begin(), fields.end());
    for (const char* of_the_solution : {"nodes", "steps", "reach"})
        recorded.erase(of_the_solution);
    return recorded;
}

} // namespace app
