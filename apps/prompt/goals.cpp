#include "apps/prompt/goals.hpp"

#include "apps/report/units.hpp"
#include "domain/contact/kernel.hpp"
#include "domain/database/setup.hpp"
#include "domain/errors.hpp"
#include "domain/target/target_table.hpp"
#include "domain/text/words.hpp"

#include <algorithm>
#include <cmath>

namespace app {

namespace {

struct Recorded {
    const char* key;
    const char* flag;
};
constexpr Recorded by_flags[] = {{"kernel", "kernel"},
                                 {"length_mm", "length"},
                                 {"effective_modulus_MPa", "modulus"},
                                 {"datum_mm", "datum"},
                                 {"strip_width_mm", "strip-width"}};

bool same(const std::string& key, const std::string& left, const std::string& right,
          const std::string& file) {
    if (key == "kernel")
        return left == right;
    const double a = rough::number_from(left, file + ": " + key), b = rough::number_from(right, key);
    return std::abs(a - b) <= 1e-9 * std::abs(b);
}

/// A number without the digits that only its last bit needs.
std::string as_read(const std::string& key, const std::string& value) {
    return key == "kernel" ? value : brief(rough::number_from(value, key), 15);
}

/// Names all that differs, and the flags with which nothing would.
void expect_same_model(const rough::Goal& goal, const rough::Model& model) {
    const auto own = recorded_model(model);
    const auto recorded = [&](const std::string& key) {
        const auto found = goal.recorded.find(key);
        return found == goal.recorded.end() ? "" : found->second;
    };
    std::string differ, flags;
    for (const auto& [key, flag] : by_flags) {
        const auto found = own.find(key);
        const std::string value = recorded(key);
        if (value.empty() || (found != own.end() && same(key, value, found->second, goal.name)))
            continue;
        differ += (differ.empty() ? "" : ", ") + std::string(key) + " " + value +
                  (found == own.end() ? "" : " (here " + as_read(key, found->second) + ")");
        const bool follows = std::string(key) == "datum_mm" && value == recorded("length_mm");
        if (!follows) // the datum is the length unless it is given
            flags += " --" + std::string(flag) + " " + value;
    }
    if (!differ.empty())
        throw rough::InputError(
            goal.name + ": recorded with " + differ +
            ", expected the same, as the target depends on it:" + (flags.empty() ? " no --datum" : flags));
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

std::vector<std::string> without_effect(const Settings& settings, const std::vector<std::string>& targets) {
    std::vector<std::string> notes;
    const auto note = [&](const char* flag, const std::string& why) {
        if (settings.given(flag))
            notes.push_back("note: --" + std::string(flag) + " is without effect: " + why);
    };
    const std::string& kernel = settings.text("kernel");
    if (kernel != rough::name_of(rough::Kernel::strip))
        note("strip-width", "the kernel is " + kernel);
    if (kernel != rough::name_of(rough::Kernel::free))
        note("datum", "the kernel is " + kernel);
    const auto conducts = [](const std::string& file) {
        return rough::read_target_table(file).place_of("conductance") >= 0;
    };
    if (std::none_of(targets.begin(), targets.end(), conducts))
        note("resistivity", "no target is a conductance");
    return notes;
}

} // namespace app
