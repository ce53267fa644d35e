#include "ga/problem/individual.hpp"

#include <mutex>

namespace ga {

Name::Name(const std::string& text) {
    static std::mutex guard;
    static std::set<std::string> names;
    const std::lock_guard lock(guard);
    text_ = &*names.insert(text).first;
}

Reason reason_caught() {
    try {
        throw;
    } catch (const Stopped&) {
        throw;
    } catch (const std::exception& error) {
        return reason(error.what());
    } catch (...) {
        return reason("an exception of another type than std::exception");
    }
}

Fitness Fitness::failed(Name policy, Reason why) {
    Fitness fitness(policy, -std::numeric_limits<double>::infinity());
    fitness.violation_ = std::numeric_limits<double>::infinity();
    fitness.detail_ = std::make_shared<const Detail>(Detail{{}, std::move(why), {}});
    return fitness;
}

Fitness Fitness::constrained(std::vector<double> violations, std::optional<double> sum) const {
    Fitness fitness = *this;
    if (std::ranges::any_of(violations, [](double each) { return each > 0; })) {
        for (double& each : violations) each = std::max(each, 0.0);
        fitness.detail_ = std::make_shared<const Detail>(
            Detail{several() ? detail_->values : Point(), nullptr, std::move(violations)});
    }
    fitness = fitness.relaxed({});
    fitness.violation_ = sum.value_or(fitness.violation_);
    return fitness;
}

Fitness Fitness::relaxed(const std::vector<double>& levels) const {
    Fitness fitness = *this;
    fitness.violation_ = 0;
    for (std::size_t k = 0; k < violations().size(); ++k)
        fitness.violation_ += std::max(0.0, violations()[k] - (k < levels.size() ? levels[k] : 0));
    return fitness;
}

void Fitness::refuse() const {
    throw UsageError(known() ? "fitness under '" + policy_.text() + "' has several values"
                             : "an individual's fitness was read before it was scored; put score before it");
}

} // namespace ga
