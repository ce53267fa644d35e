#include "domain/design/loadings.hpp"

#include <algorithm>

namespace rough {

namespace {

/// The responses to all ways of loading, each asked of `respond_to`, in final amplitude.
template <class Respond>
DesignResponse loaded(const DesignSetup& setup, const Model& model, Respond respond_to) {
    const Loadings loadings = loadings_of(setup, model.loading);
    DesignResponse result{1, {}, loadings.of_goal};
    for (const Loading& loading : loadings.each) {
        Response response = respond_to(loading);
        result.scale = eq_11(setup, response);
        result.responses.push_back(setup.max_pressure ? scaled(std::move(response), result.scale)
                                                      : std::move(response));
    }
    return result;
}

} // namespace

Loadings loadings_of(const DesignSetup& setup, const Loading& loading) {
    Loadings result;
    if (setup.max_pressure)
        return {{loading}, std::vector<std::size_t>(setup.goals.size(), 0)};
    double pressure = 0, displacement = 0;
    for (const Goal& goal : setup.goals)
        (goal.against_pressure() ? pressure : displacement) =
            std::max(goal.against_pressure() ? pressure : displacement, goal.last());
    for (const auto& [to_pressure, to_displacement] :
         {std::pair(pressure, 0.0), std::pair(0.0, displacement)})
        if (to_pressure + to_displacement > 0) {
            Loading one = loading;
            one.to_pressure = to_pressure;
            one.to_displacement = to_displacement;
            result.each.push_back(one);
        }
    for (const Goal& goal : setup.goals)
        result.of_goal.push_back(goal.against_pressure() ? 0 : result.each.size() - 1);
    return result;
}

Genome at_scale_one(Genome genome, const DesignSetup& setup) {
    if (setup.max_pressure)
        genome.scale = 1;
    return genome;
}

double eq_11(const DesignSetup& setup, const Response& response) {
    return setup.max_pressure ? *setup.max_pressure / response.pressure[response.steps() - 1] : 1;
}

std::vector<Eigen::VectorXd> misfits_of(const DesignSetup& setup, const DesignResponse& response) {
    std::vector<Eigen::VectorXd> misfits;
    for (std::size_t g = 0; g < setup.goals.size(); ++g)
        misfits.push_back(misfit(setup.goals[g],
                                 curve_of(setup.goals[g].quantity, response.responses[response.of_goal[g]])));
    return misfits;
}

DesignResponse respond(const DesignSetup& setup, const Profile& profile, const Model& model) {
    return loaded(setup, model, [&](const Loading& loading) {
        Model one = model;
        one.loading = loading;
        return respond(profile, one);
    });
}

DesignResponse respond(const DesignSetup& setup, const Genome& genome, const Model& model) {
    const Genome shape = at_scale_one(genome, setup);
    if (model.accuracy == 0)
        return respond(setup, sample(shape, completed(model).grid), model);
    return loaded(setup, model, [&](const Loading& loading) {
        Model one = model;
        one.loading = loading;
        return respond(shape, one);
    });
}

std::vector<Model> loaded_models(const DesignSetup& setup) {
    std::vector<Model> models;
    for (const Loading& loading : loadings_of(setup, setup.model.loading).each) {
        models.push_back(setup.model);
        models.back().loading = loading;
    }
    return models;
}

DesignSetup exactly(DesignSetup setup) {
    setup.model = exactly(std::move(setup.model));
    return setup;
}

std::vector<double> similarities(const DesignSetup& setup, const DesignResponse& response) {
    std::vector<double> each;
    for (const Eigen::VectorXd& misfit : misfits_of(setup, response))
        each.push_back(1 - misfit.cwiseAbs().maxCoeff());
    return each;
}

double similarity(const DesignSetup& setup, const DesignResponse& response) {
    const std::vector<double> each = similarities(setup, response);
    return *std::min_element(each.begin(), each.end());
}

double similarity(const DesignSetup& setup, const Genome& genome, Index refine) {
    return similarity(setup, respond(setup, genome, refined(setup.model, refine)));
}

} // namespace rough
