#include "domain/design/error_budget.hpp"

#include "domain/problem/setup.hpp"

namespace rough {

std::vector<ErrorSource> error_budget(const DesignSetup& given, const Answer& answer) {
    const DesignSetup setup = completed(given);
    const Model own = exactly(setup.model);
    const Target& target = setup.targets.front();
    const auto values = [&](const Model& model) {
        const DesignResponse response = respond(setup, answer.genome, model);
        const Curve& curve = response.curves.front();
        return Eigen::VectorXd(target.x.unaryExpr([&](double x) { return curve.at(x); }));
    };
    const Eigen::VectorXd base = values(own);
    std::vector<ErrorSource> budget;
    const auto add = [&](const std::string& kind, const std::string& source, const Model& model) {
        budget.push_back({kind, source, (values(model).array() / base.array() - 1).abs().maxCoeff()});
    };
    Model other = own;
    if (own.body.kernel == Kernel::free && !own.grid.is_2d()) {
        other.body.datum *= 4;
        add("model", "the half-plane's datum at 4 times the distance", other);
        other = own;
        other.body.kernel = Kernel::periodic;
        other.loading.reach = std::min(other.loading.reach, completed(Loading(), Kernel::periodic).reach);
        add("model", "a periodic half-plane in place of the free one", completed(other));
    }
    add("numerical", "the grid: 4 times the elements", refined(own, 4));
    other = own;
    other.loading.steps *= 4;
    add("numerical", "the load steps: 4 times as many", other);
    if (setup.model.accuracy > 0)
        add("numerical", "the accuracy that the search was allowed", setup.model);
    budget.push_back(
        {"target", "what is left of the target's mismatch on the model's own grid", 1 - answer.similarity});
    budget.push_back({"target", "the same on the finer grid", 1 - answer.similarity_refined});
    return budget;
}

} // namespace rough
