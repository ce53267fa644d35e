#include "domain/problem/judgement.hpp"

#include <algorithm>
#include <tuple>

namespace rough {

namespace {

/// The last of every `part` load steps: the response in so many times fewer. Steps are even, so these are the
/// same displacements to the bit.
Response every(Index part, Response response) {
    const Index steps = response.steps() / part;
    for (auto* column : {&response.displacement, &response.pressure, &response.contact_fraction,
                         &response.tangent_stiffness, &response.kkt_residual})
        *column = Eigen::VectorXd((*column)(Eigen::seqN(part - 1, steps, part)));
    return response;
}

} // namespace

DesignSetup in_finer_steps(DesignSetup setup, int times) {
    setup.model.loading.steps *= times;
    if (!setup.like)
        return setup;
    const Response own = respond(*setup.like, exactly(setup.model));
    for (Target& target : setup.targets) {
        const Curve curve = curve_of(target.quantity, own);
        for (Index k = 0; k < target.points(); ++k)
            target.y[k] = curve.at(std::min(target.x[k], curve.to));
    }
    return setup;
}

double Judgement::worst() const { return std::min({similarity, refined, stepped, both}); }

Judgement Judge::of(const Genome& genome) const {
    // On the finer side the similarity in all steps, then in every fourth.
    const auto on_grid = [&](Index refine) {
        std::vector<Response> fine = pressed(finer_, genome, refined(finer_.model, refine)), own;
        for (const Response& response : fine)
            own.push_back(every(judged_refinement, response));
        return std::pair(similarity(finer_, scored(finer_, std::move(fine))),
                         similarity(setup_, scored(setup_, std::move(own))));
    };
    Judgement result;
    std::tie(result.stepped, result.similarity) = on_grid(1);
    std::tie(result.both, result.refined) = on_grid(judged_refinement);
    return result;
}

} // namespace rough
